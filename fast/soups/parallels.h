// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the few of many directions that can be parallel to another one.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "fast/soups/numbers.h"

namespace forceshade::fast::soups {

// Directions in the order of their cosine to a fixed one; those that are too uncertain are compared with all.
class Parallels {
 public:
  // is_signed: opposite directions are not parallel.
  explicit Parallels(bool is_signed) noexcept : is_signed_(is_signed) {}
  void reserve(std::size_t count) {
    sure_.reserve(count);
    vague_.reserve(count);
  }
  void clear() noexcept {
    sure_.clear();
    vague_.clear();
  }
  void add(const Vector3<Ball>& d, std::uint32_t number) {
    const double key = key_of(d);
    if (std::isnan(key)) return vague_.push_back(number);
    sure_.insert(std::ranges::upper_bound(sure_, key, {}, &Entry::key), {key, number});
  }
  // The first for which is_same(number) holds, or `none`.
  template <class IsSame>
  std::uint32_t find(const Vector3<Ball>& d, std::uint32_t none, const IsSame& is_same) const {
    const double key = key_of(d);
    const bool is_vague = std::isnan(key);
    for (auto at = is_vague ? sure_.begin() : std::ranges::lower_bound(sure_, key - 2 * kError, {}, &Entry::key);
         at != sure_.end() && (is_vague || at->key <= key + 2 * kError); ++at)
      if (is_same(at->number)) return at->number;
    for (const std::uint32_t number : vague_)
      if (is_same(number)) return number;
    return none;
  }

 private:
  struct Entry {
    double key;
    std::uint32_t number;
  };
  // An error of d of 2^-40 of its length turns it by less than 2^-39, and the cosine changes by no more.
  static constexpr double kError = 0x1p-38;

  // Not a number if it is vague.
  double key_of(const Vector3<Ball>& d) const noexcept {
    const double x = d.x.value, y = d.y.value, z = d.z.value;
    const double length = std::sqrt(x * x + y * y + z * z), error = d.x.error + d.y.error + d.z.error;
    if (!(length > 0x1p-400 && length < 0x1p400 && error < 0x1p-40 * length)) return std::numeric_limits<double>::quiet_NaN();
    const double cosine = (0.36 * x + 0.48 * y + 0.8 * z) / length;
    return is_signed_ ? cosine : std::fabs(cosine);
  }

  bool is_signed_;
  std::vector<Entry> sure_;
  std::vector<std::uint32_t> vague_;
};

}  // namespace forceshade::fast::soups
