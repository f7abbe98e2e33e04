// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Integrals along a HeightLine, by pieces small enough to be sure of. Callers hold exact_arithmetic.

#include <algorithm>
#include <limits>
#include <string>

#include "forceshade/checks.h"
#include "reference/enclosure.h"
#include "reference/heights/line.h"

namespace forceshade::reference {

// The part of a column, from the surface to the depth D, that a counter-clockwise loop is to enclose.
enum class Enclosed { nothing, all, top, bottom };

// A stretch of a piece and what it is worth.
struct Stretch {
  const HeightLine::Piece* piece;
  Ball64 from, to;             // t
  Ball64 generated{}, cost{};  // the integral over it; of a circulation its positive part and the size of its negative part
  Enclosed enclosed = Enclosed::nothing;
  long double change = from.mid();  // the best place to cut it, if that is inside

  long double width() const { return to.high() - from.low(); }
  long double doubt() const { return generated.rad() + cost.rad(); }

  // A cut lies off the ends: what is left to be certain of next to a cut gains nothing by another.
  long double cut() const {
    const long double low = from.mid(), high = to.mid(), margin = (high - low) / 64;
    return change > low + margin && change < high - margin ? change : low + (high - low) / 2;
  }
  bool can_be_cut() const { return cut() > from.high() && cut() < to.low(); }
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
    friend Function operator*(const Ball64& a, const Function& b) { return {a * b.at_middle, a * b.over}; }
  };

  Local(const HeightLine& line, const Stretch& stretch)
      : middle_(stretch.from.mid() + (stretch.to.mid() - stretch.from.mid()) / 2),
        reach_(std::max(stretch.to.high() - middle_, middle_ - stretch.from.low())),
        from_(stretch.from - Ball64(middle_, 0)),
        to_(stretch.to - Ball64(middle_, 0)),
        at_middle_(line.ground(*stretch.piece, SectionSeries::variable(Ball64(middle_, 0), 1.0))),
        over_(line.ground(*stretch.piece, SectionSeries::variable(Ball64(middle_, reach_), 1.0))) {}

  // f(ground, t) gives a Series<kOrder>.
  template <class F>
  Function function(const F& f) const {
    return {f(at_middle_, SectionSeries::variable(Ball64(middle_, 0), 1.0)),
            f(over_, SectionSeries::variable(Ball64(middle_, reach_), 1.0))};
  }

  // Not wider than the width times all values, however bad the series is.
  Ball64 integral(const Function& f) const {
    Ball64 sum, low = from_, high = to_;
    for (std::size_t k = 0; k <= kOrder; ++k) {
      sum = sum + (k < kOrder ? f.at_middle[k] : f.over[k]) * (high - low) / Ball64(static_cast<double>(k + 1));
      low = low * from_;
      high = high * to_;
    }
    const Ball64 whole = f.over[0] * (to_ - from_);
    if (!(sum.rad() <= whole.rad())) sum = whole;
    if (!is_finite(sum)) throw Undecided{};
    return sum;
  }

  // Finite and in order, or Undecided is thrown: what is compared with it is decided.
  Range range(const Function& f) const {
    const Ball64 s(0, reach_);
    Ball64 sum = f.over[kOrder];
    for (std::size_t k = kOrder; k-- > 0;) sum = f.at_middle[k] + s * sum;
    if (!is_finite(sum)) sum = f.over[0];
    const Range range{std::max(sum.low(), f.over[0].low()), std::min(sum.high(), f.over[0].high())};
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low <= range.high)) throw Undecided{};
    return range;
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
  Ball64 from_, to_;
  SectionSample<SectionSeries> at_middle_, over_;
};

// f(). Throws NotEnclosed for what a formula leaves open where nothing can be cut.
template <class F>
auto decided(const F& f) {
  try {
    return f();
  } catch (const Undecided&) {
    throw NotEnclosed("64-bit arithmetic leaves the height map's steepness at a kink open; expected a gentler one there");
  }
}

// All of the line in order of t, the least certain stretches cut in two until what is generated and what it costs are certain
// to `relative` of the larger, or to `floor`. From kMany stretches on, and 64 more a piece, kFair of the larger is enough; from
// kMost on the answer is right but less certain. judge(stretch) sets what is not its place; where it throws Undecided the
// stretch is cut. Throws NotEnclosed where one remains that is not finite.
constexpr std::size_t kMany = 16384, kMost = 16 * kMany;
constexpr long double kFair = 1e-5L;
template <class Judge>
std::vector<Stretch> refine(const HeightLine& line, const Judge& judge, long double relative, long double floor,
                            const Monitor& monitor) {
  const std::size_t many = kMany + 64 * line.pieces().size(), most = kMost + 64 * line.pieces().size();
  constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
  double done = 0;
  const auto judged = [&](const HeightLine::Piece* piece, const Ball64& from, const Ball64& to) {
    monitor.at(done);
    Stretch s{piece, from, to};
    try {
      judge(s);
      if (is_finite(s.generated) && is_finite(s.cost)) return s;
    } catch (const Undecided&) {
    }
    return Stretch{piece, from, to, {0, kInfinity}};
  };
  std::vector<Stretch> all;
  for (const HeightLine::Piece& piece : line.pieces()) all.push_back(judged(&piece, piece.from, piece.to));
  long double first = 0;
  for (;;) {
    long double generated = 0, cost = 0, doubt = 0, worst = 0;
    for (const Stretch& s : all) {
      generated += s.generated.mid();
      cost += s.cost.mid();
      doubt += s.doubt();
      if (s.can_be_cut()) worst = std::max(worst, s.doubt());
    }
    const long double larger = std::max(std::fabs(generated), std::fabs(cost)), allowed = std::max(relative * larger, floor);
    if (doubt <= allowed) return all;
    const long double enough = allowed / (2 * static_cast<long double>(all.size()));
    const bool is_enough = all.size() >= most || (all.size() >= many && doubt <= kFair * larger);
    if (is_enough || worst <= enough) {
      if (doubt < kInfinity) return all;
      throw NotEnclosed("the height map is so steep or so fine along the path that " + std::to_string(all.size()) +
                        " stretches in 64-bit arithmetic leave its energy open; expected a shorter path or a gentler map");
    }
    if (first == 0 && doubt < kInfinity) first = doubt;
    const double by_number = static_cast<double>(all.size()) / static_cast<double>(most + most / 64);
    const double by_doubt = first > 0 ? static_cast<double>(std::log(first / doubt) / std::log(first / allowed)) : 0;
    done = std::clamp(std::max(by_number, by_doubt), done, 1.0);
    // The worst first: what there is of stretches goes where it gains most.
    std::vector<Stretch> finer;
    for (const Stretch& s : all) {
      if (s.doubt() <= enough || s.doubt() < worst / 16 || !s.can_be_cut()) {
        finer.push_back(s);
      } else {
        const Ball64 cut(s.cut(), 0);
        finer.push_back(judged(s.piece, s.from, cut));
        finer.push_back(judged(s.piece, cut, s.to));
      }
    }
    all.swap(finer);
  }
}

}  // namespace forceshade::reference
