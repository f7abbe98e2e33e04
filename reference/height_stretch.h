// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Integrals along a HeightLine, by pieces small enough to be sure of. Callers hold slow_numbers.

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "forceshade/reference/height_line.h"

namespace forceshade::reference {

// As much of a column, from the surface to the depth D, as a counter-clockwise loop is to enclose.
enum class Enclosed { nothing, all, top, bottom };

// A stretch of a piece and what it is worth.
struct Stretch {
  const HeightLine::Piece* piece;
  Filter from, to;        // t
  Filter paid{}, cost{};  // the integral over it; of a circulation its positive part and the size of its negative part
  Enclosed enclosed = Enclosed::nothing;
  long double change = from.mid();  // where to cut it best, if that is inside

  long double width() const { return to.high() - from.low(); }
  long double doubt() const { return paid.rad() + cost.rad(); }

  // Off the ends: what is left to be certain of next to a cut gains nothing by another.
  long double cut() const {
    const long double low = from.mid(), high = to.mid(), margin = (high - low) / 64;
    return change > low + margin && change < high - margin ? change : low + (high - low) / 2;
  }
};

struct Range {
  long double low, high;
};

// The functions of a stretch: as their Taylor series at its middle, and over all of it.
class Local {
 public:
  static constexpr std::size_t kOrder = 6;  // even, so that the remainder's power has one sign
  struct Function {
    Series<kOrder> at_middle, over;

    friend Function operator+(const Function& a, const Function& b) { return {a.at_middle + b.at_middle, a.over + b.over}; }
    friend Function operator*(const Function& a, const Function& b) { return {a.at_middle * b.at_middle, a.over * b.over}; }
    friend Function operator/(const Function& a, const Function& b) { return {a.at_middle / b.at_middle, a.over / b.over}; }
    friend Function operator*(const Filter& a, const Function& b) { return {a * b.at_middle, a * b.over}; }
  };

  Local(const HeightLine& line, const Stretch& stretch)
      : middle_(stretch.from.mid() + (stretch.to.mid() - stretch.from.mid()) / 2),
        reach_(std::max(stretch.to.high() - middle_, middle_ - stretch.from.low())),
        from_(stretch.from - Filter(middle_, 0)),
        to_(stretch.to - Filter(middle_, 0)),
        at_middle_(line.ground(*stretch.piece, GroundSeries::variable(Filter(middle_, 0), 1.0))),
        over_(line.ground(*stretch.piece, GroundSeries::variable(Filter(middle_, reach_), 1.0))) {}

  // f(ground, t) gives a Series<kOrder>.
  template <class F>
  Function function(const F& f) const {
    return {f(at_middle_, GroundSeries::variable(Filter(middle_, 0), 1.0)),
            f(over_, GroundSeries::variable(Filter(middle_, reach_), 1.0))};
  }

  Filter integral(const Function& f) const {
    Filter sum, low = from_, high = to_;
    for (std::size_t k = 0; k <= kOrder; ++k) {
      sum = sum + (k < kOrder ? f.at_middle[k] : f.over[k]) * (high - low) / Filter(static_cast<double>(k + 1));
      low = low * from_;
      high = high * to_;
    }
    return sum;
  }

  Range range(const Function& f) const {
    const Filter s(0, reach_);
    Filter sum = f.over[kOrder];
    for (std::size_t k = kOrder; k-- > 0;) sum = f.at_middle[k] + s * sum;
    return {std::max(sum.low(), f.over[0].low()), std::min(sum.high(), f.over[0].high())};
  }

  // About where it changes its sign, if it does: five of Newton's steps from the middle.
  long double change(const Function& f) const {
    long double s = 0;
    for (int step = 0; step < 5; ++step) {
      long double value = 0, slope = 0;
      for (std::size_t k = kOrder + 1; k-- > 0;) {
        slope = slope * s + value;
        value = value * s + f.at_middle[k].mid();
      }
      s -= value / slope;
    }
    return middle_ + s;
  }

 private:
  long double middle_, reach_;
  Filter from_, to_;
  Ground<GroundSeries> at_middle_, over_;
};

// The ball around [low, high].
inline Filter ball(long double low, long double high) {
  const long double mid = low + (high - low) / 2;
  return Filter(mid, std::max(high - mid, mid - low)) + Filter(0, std::fabs(high - low) * 0x1p-60L);
}

// All of the line in order of t, the least certain stretches cut in two until what is paid and what it costs are certain to
// `relative` of the larger, or to `floor`. judge(stretch) sets what is not its place; where it throws Undecided the stretch is
// cut.
template <class Judge>
std::vector<Stretch> refine(const HeightLine& line, const Judge& judge, long double relative, long double floor) {
  const std::size_t most = 16384 + 64 * line.pieces().size();  // from there on the answer is right but less certain
  constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
  const auto judged = [&](const HeightLine::Piece* piece, const Filter& from, const Filter& to) {
    Stretch s{piece, from, to};
    try {
      judge(s);
    } catch (const Undecided&) {
      s.paid = {0, kInfinity};
    }
    if (!std::isfinite(s.paid.mid()) || !(s.doubt() < kInfinity)) s.paid = {0, kInfinity};
    return s;
  };
  std::vector<Stretch> all;
  for (const HeightLine::Piece& piece : line.pieces()) all.push_back(judged(&piece, piece.from, piece.to));
  for (;;) {
    long double paid = 0, cost = 0, doubt = 0;
    for (const Stretch& s : all) {
      paid += s.paid.mid();
      cost += s.cost.mid();
      doubt += s.doubt();
    }
    const long double allowed = std::max({relative * std::fabs(paid), relative * std::fabs(cost), floor});
    if (doubt <= allowed || all.size() >= most) return all;
    std::vector<Stretch> finer;
    for (const Stretch& s : all) {
      const bool is_certain = s.doubt() <= allowed / (2 * static_cast<long double>(all.size()));
      const Filter cut(s.cut(), 0);
      if (is_certain || cut.mid() <= s.from.high() || cut.mid() >= s.to.low()) {
        finer.push_back(s);
      } else {
        finer.push_back(judged(s.piece, s.from, cut));
        finer.push_back(judged(s.piece, cut, s.to));
      }
    }
    if (finer.size() == all.size()) {
      if (doubt < kInfinity) return all;
      throw std::domain_error("height map: 64 bits do not decide its steepness along the path");
    }
    all.swap(finer);
  }
}

}  // namespace forceshade::reference
