// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Some of many values, each with the same chance to be among them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "properties/split_mix.h"

namespace forceshade::conformance {

// Each value has a number of its own. Those are kept whose numbers come first in an order that SplitMix64 gives, so that the
// sample does not depend on the order in which they were added, and is the same in every run.
template <class T>
class Sample {
 public:
  static constexpr std::size_t kMost = 2048;

  void add(std::uint64_t number, const T& value) {
    ++seen_;
    keep(properties::split_mix(0, number), value);
  }

  // Adds what another one has seen; no number is in both.
  void append(const Sample& other) {
    seen_ += other.seen_;
    for (const Kept& one : other.kept_) keep(one.key, one.value);
  }

  std::uint64_t seen() const { return seen_; }

  std::vector<T> values() const {
    std::vector<Kept> sorted = kept_;
    std::ranges::sort(sorted, {}, &Kept::key);
    std::vector<T> values;
    values.reserve(sorted.size());
    for (const Kept& one : sorted) values.push_back(one.value);
    return values;
  }

 private:
  struct Kept {
    std::uint64_t key;
    T value;
  };

  void keep(std::uint64_t key, const T& value) {
    if (kept_.size() == kMost) {
      if (key >= kept_.front().key) return;
      std::ranges::pop_heap(kept_, {}, &Kept::key);
      kept_.pop_back();
    }
    kept_.push_back({key, value});
    std::ranges::push_heap(kept_, {}, &Kept::key);
  }

  std::vector<Kept> kept_;  // a heap, the last in the order at its front
  std::uint64_t seen_ = 0;
};

}  // namespace forceshade::conformance
