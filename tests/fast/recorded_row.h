// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two and four recorded numbers side by side, as fast/numbers/row.h has them: what a spline's jet is recorded with.

#include "fast/numbers/row.h"
#include "tests/fast/recorded_number.h"

namespace forceshade::tests {

struct RecordedTwo {
  Recorded first, second;

  const Recorded& operator[](std::size_t i) const { return i == 0 ? first : second; }
  friend RecordedTwo operator*(const RecordedTwo& a, const fast::Pair64& b) {
    return {a.first * Recorded(b[0]), a.second * Recorded(b[1])};
  }
};

struct RecordedFour {
  using Number = Recorded;
  using Two = RecordedTwo;

  std::array<Recorded, 4> lanes;

  explicit RecordedFour(double a) : RecordedFour(Recorded(a)) {}
  explicit RecordedFour(const Recorded& a) : lanes{a, a, a, a} {}
  RecordedFour(const Recorded& a, const Recorded& b, const Recorded& c, const Recorded& d) : lanes{a, b, c, d} {}

  template <class Binary>
  static RecordedFour load(const Binary* from) {
    const auto lane = [&](std::size_t i) { return Recorded(static_cast<double>(from[i])); };
    return {lane(0), lane(1), lane(2), lane(3)};
  }

  friend RecordedFour operator+(const RecordedFour& a, const RecordedFour& b) {
    return by_lane([&](std::size_t i) { return a.lanes[i] + b.lanes[i]; });
  }
  friend RecordedFour operator-(const RecordedFour& a, const RecordedFour& b) {
    return by_lane([&](std::size_t i) { return a.lanes[i] - b.lanes[i]; });
  }
  friend RecordedFour operator*(const RecordedFour& a, const RecordedFour& b) {
    return by_lane([&](std::size_t i) { return a.lanes[i] * b.lanes[i]; });
  }
  friend RecordedFour multiply_add(const RecordedFour& a, const RecordedFour& b, const RecordedFour& c) {
    return by_lane([&](std::size_t i) { return multiply_add(a.lanes[i], b.lanes[i], c.lanes[i]); });
  }
  // In the order of the rows of fast/, which proof_operations_test checks on numbers.
  friend Recorded sum(const RecordedFour& a) { return (a.lanes[0] + a.lanes[2]) + (a.lanes[1] + a.lanes[3]); }
  friend RecordedTwo sums(const RecordedFour& a, const RecordedFour& b) { return {in_pairs(a), in_pairs(b)}; }

 private:
  template <class F>
  static RecordedFour by_lane(const F& of) {
    return {of(0), of(1), of(2), of(3)};
  }
  static Recorded in_pairs(const RecordedFour& a) { return (a.lanes[0] + a.lanes[1]) + (a.lanes[2] + a.lanes[3]); }
};

}  // namespace forceshade::tests
