// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Answers of a third-party renderer, held against the exact definition of its subject.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/properties.h"
#include "properties/conformance/distance.h"
#include "properties/split_mix.h"

namespace forceshade::conformance {

// Some of many values, each with the same chance to be among them.

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

// The number of positions of a path.
inline constexpr std::uint64_t kPathLength = 4096;

// A position, and what the renderer gave for it.
struct Case {
  Eigen::Vector3f position{0, 0, 0};  // mm
  bool is_reset = false;              // a new path begins here, from no contact
  Eigen::Vector3f force{0, 0, 0};     // N
  std::string aim = {};               // the aim of the position; empty where that is not known
  std::string place = {};             // the place of the case, for people: "mine.csv:12"
  std::uint32_t periods = 1;          // since the case before, which matters where there is damping
};

// A case with what the definition says of it.
struct Judged {
  Case its;
  reference::Rounded exact;
  Distance distance;
  std::array<std::string, 3> digits = {};  // of the exact force, kShownDigits of them; empty where the definition has none
};
inline constexpr unsigned kShownDigits = 30;

struct Count {
  std::uint64_t cases = 0, wrong = 0, beyond = 0;  // wrong: not correctly rounded; beyond: the tolerance
};

// The parts of a case that a picture needs.
struct Place {
  Eigen::Vector3f position{0, 0, 0};  // mm
  std::uint64_t ulps = 0;             // as in Distance
};

struct Judgement {
  Count all;
  std::map<std::string, Count> by_aim;
  // By the length of the binary number of units in the last place: 0, 1, 2 to 3, 4 to 7, and so on; the last one: no number.
  static constexpr std::size_t kUlpBins = 35;
  std::array<std::uint64_t, kUlpBins> by_ulps{};
  // By the power of ten that the distance in N is below: 10^-45 or less, 10^-44, up to 10^5, beyond it or no number.
  static constexpr int kLeastPower = -45, kMostPower = 5;
  std::array<std::uint64_t, kMostPower - kLeastPower + 2> by_newtons{};
  std::uint64_t undecided = 0;   // the definition does not decide there
  std::uint64_t unfinished = 0;  // the definition's god-object used up the moves or looks of the tick
  // The one with the largest distance of each unit, as in Unit; of the cases beyond the tolerance the simplest, whose
  // position is the shortest to write.
  std::array<std::optional<Judged>, 3> worst;
  std::optional<Judged> simplest;
  Sample<Place> right, wrong;  // of the cases that are correctly rounded, and of those that are not

  bool held() const { return all.cases > 0 && all.beyond == 0; }

  // Goes on with that of the cases behind these.
  void append(const Judgement& later);
};

class Judge {
 public:
  // before: how many cases others judge that come before these. damping: behind the subject, in the ranges of
  // reference::Damping::build.
  Judge(std::shared_ptr<const properties::Subject> subject, const Tolerance& tolerance, std::uint64_t before = 0,
        const std::optional<damping::Parameters>& damping = {})
      : tolerance_(tolerance), subject_(std::move(subject)), number_(before) {
    if (damping) damping_ = std::get<reference::Damping>(reference::Damping::build(*damping));
  }

  // The next case. Those of a path follow one another; the first one begins a path. Gives it back where it is beyond the
  // tolerance, without digits.
  std::optional<Judged> add(const Case& next);

  // The definition's answer to the last case; nothing where it was not judged.
  const std::optional<reference::Rounded>& exact() const { return exact_; }

  const Judgement& judgement() const { return judgement_; }

 private:
  void count(const Case& its, const Distance& distance, bool is_within);
  // The definition's answer to the case; throws std::domain_error.
  reference::Rounded exact_of(const Case& next);
  // Digits of it; none of a damped force, which is defined by the rounded one.
  std::optional<std::array<std::string, 3>> decimal(unsigned digits) const;
  // If it is the worst or the simplest until now.
  void keep(const Judged& judged, bool is_within);
  // Puts it there, with the digits of its exact force.
  void keep(Judged judged, std::optional<Judged>& where) const;

  Tolerance tolerance_;
  std::shared_ptr<const properties::Subject> subject_;
  std::unique_ptr<properties::ReferenceSession> session_;
  std::optional<reference::Damping> damping_;
  std::optional<reference::Rounded> exact_;
  std::uint64_t number_;  // of the last case
  Judgement judgement_;
};

}  // namespace forceshade::conformance
