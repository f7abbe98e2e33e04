// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy/height_circulation.h"

namespace forceshade::reference {
namespace {

// The positive part of a function that is linear in the depth, integrated over it: it grows with either end's value.
long double positive_part(long double at_surface, long double at_depth, long double depth) {
  if (at_surface <= 0 && at_depth <= 0) return 0;
  if (at_surface >= 0 && at_depth >= 0) return depth * (at_surface + at_depth) / 2;
  const long double positive = std::max(at_surface, at_depth);
  return depth * positive * positive / (2 * std::fabs(at_surface - at_depth));
}

// The range of a function's values, given those of one that has its sign everywhere.
Range with_sign(const Range& values, const Range& sign) {
  return {sign.low >= 0 ? std::max(0.0L, values.low) : values.low, sign.high <= 0 ? std::min(0.0L, values.high) : values.high};
}

Ball64 positive(const Ball64& value) {
  return ball(std::max(0.0L, value.low()), std::max(0.0L, value.high()));
}

// Covers the few roundings above.
constexpr long double kSlack = 0x1p-60L;

}  // namespace

Circulation::Circulation(const HeightMapField& law, const Slice& slice, float depth)
    : line_(law, segment_of(slice)), depth_(static_cast<double>(depth)) {}

std::array<Ball64, 2> Circulation::density(const HeightLine::Piece& piece, const Ball64& t) const {
  const auto at = line_.ground(piece, SectionSeries::variable(t, 1.0));
  const Ball64 surface = (at.excess * at.upright)[0];
  return {surface, surface + depth_ * at.upright[1]};
}

Ball64 Circulation::rise(std::size_t piece) const {
  const HeightLine::Piece &left = line_.pieces()[piece - 1], &right = line_.pieces()[piece];
  return line_.ground(right, right.from).upright - line_.ground(left, right.from).upright;
}

void Circulation::judge(Stretch& stretch) const {
  using SectionSample = SectionSample<SectionSeries>;
  using Function = Local::Function;
  const Local local(line_, stretch);
  const Ball64 two(2.0), half = depth_ / two;
  const auto surface = local.function([&](const SectionSample& g, const auto&) { return (g.excess * g.upright).shorter(); });
  const auto slope = local.function([&](const SectionSample& g, const auto&) { return g.upright.derivative(); });
  const auto bottom = surface + depth_ * slope;
  // These have the same signs and are n and n³ times as large: without a root, so that they are certain on longer stretches.
  const auto excess = local.function([&](const SectionSample& g, const auto&) { return g.excess.shorter(); });
  const auto below = local.function(
      [&](const SectionSample& g, const auto&) { return (g.excess * g.squared).shorter() + -half * g.squared.derivative(); });
  const Range shallow = with_sign(local.range(surface), local.range(excess)),
              deep = with_sign(local.range(bottom), local.range(below));
  const Ball64 turned = line_.ground(*stretch.piece, stretch.to).upright - line_.ground(*stretch.piece, stretch.from).upright;
  const Ball64 by_slope = local.integral(slope);  // exactly 0 where 1/n is constant
  const Ball64 total = depth_ * local.integral(surface) + half * depth_ * (by_slope.rad() < turned.rad() ? by_slope : turned);
  if (shallow.high <= 0 && deep.high <= 0) {
    stretch.cost = -total;
    return;
  }
  if (shallow.low >= 0 && deep.low >= 0) {
    stretch.enclosed = Enclosed::all;
    stretch.generated = total;
    return;
  }
  stretch.enclosed = total.low() > 0 ? Enclosed::all : Enclosed::nothing;
  stretch.change = local.change(shallow.low < 0 && shallow.high > 0 ? excess : below);
  const long double D = depth_.mid(), width = stretch.width() * (1 + kSlack);
  const long double generated = positive_part(shallow.high, deep.high, D) * width,
                    cost = positive_part(-shallow.low, -deep.low, D) * width;
  stretch.generated = ball(std::max(0.0L, total.low()), std::max(0.0L, std::min(generated, total.high() + cost)));
  const bool is_top = shallow.low > 0 && deep.high < 0;
  if (is_top || (shallow.high < 0 && deep.low > 0)) {
    // A triangle over the depths that generate energy.
    try {
      const Function& f = is_top ? surface : bottom;
      const Ball64 triangle = local.integral(f * f / (is_top ? -two * slope : two * slope));
      stretch.enclosed = is_top ? Enclosed::top : Enclosed::bottom;
      if (triangle.rad() < stretch.generated.rad()) stretch.generated = triangle;
    } catch (const Undecided&) {
    }
  }
  stretch.cost = stretch.generated - total;
}

Generated Circulation::lines() const {
  Generated sum;
  const Ball64 half = depth_ * depth_ / Ball64(2.0);
  for (std::size_t i = 1; i < line_.pieces().size(); ++i) {
    const Ball64 one = half * rise(i);
    sum.counter_clockwise = sum.counter_clockwise + positive(one);
    sum.clockwise = sum.clockwise + positive(-one);
  }
  return sum;
}

Generated Circulation::generated(const std::vector<Stretch>& stretches) const {
  Generated sum = lines();
  for (const Stretch& stretch : stretches) {
    sum.counter_clockwise = sum.counter_clockwise + stretch.generated;
    sum.clockwise = sum.clockwise + stretch.cost;
  }
  return sum;
}

std::vector<Stretch> Circulation::stretches(long double relative, const Monitor& monitor) const {
  const Generated on_lines = lines();
  const long double D = depth_.mid(), floor = std::max(D * D * 0x1p-44L, relative * std::max(on_lines.counter_clockwise.mid(),
                                                                                             on_lines.clockwise.mid()));
  return refine(
      line_, [this](Stretch& s) { judge(s); }, relative, floor, monitor);
}

}  // namespace forceshade::reference
