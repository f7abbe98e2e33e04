// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "reference/energy.h"
#include "reference/energy/strips.h"
#include "reference/laws/slow_geometry.h"
#include "reference/numbers/intervals.h"

namespace forceshade::reference {
namespace {

struct Place {
  Enclosure x, z;
};

Enclosure positive(const Enclosure& v) {
  return larger(0, v);
}

Enclosure square(const Enclosure& v) {
  return positive(v * v);
}

// ½K·depth² where the depth is positive.
Enclosure spring(const Enclosure& K, const Enclosure& depth) {
  return K * square(positive(depth)) / 2;
}

// From a to b, an antiderivative of K·δ(x)·(x + m·r)/R, which is F·(1, m) where the hand is δ = p + s·x deep, z changes by m
// with x, and r = √(R² - x²).
Enclosure shaded_work(const BumpGeometry<Enclosure>& g, const Enclosure& p, const Enclosure& s, const Enclosure& m,
                      const Enclosure& a, const Enclosure& b) {
  const auto antiderivative = [&](const Enclosure& x) {
    const Enclosure r = height_over_axis(g, x);
    return p * x * x / 2 + s * x * x * x / 3 + m * (p * area_over_axis(g, x) - s * r * r * r / 3);
  };
  return g.K / g.R * (antiderivative(b) - antiderivative(a));
}

// Straight from a to b, not vertical, both at x >= 0: the part of it in one strip.
Enclosure work_in_strip(const BumpGeometry<Enclosure>& g, const Strip& strip, const Place& a, const Place& b) {
  const auto is_beside = [&](const Enclosure& line, auto&& order) { return order(a.x, line) && order(b.x, line); };
  if (is_beside(strip.left, surely_at_most) ||
      is_beside(strip.right, [](const Enclosure& x, const Enclosure& line) { return surely_at_most(line, x); }))
    return 0;
  const auto within = [](const Enclosure& x, const Enclosure& low, const Enclosure& high) {
    return smaller(larger(x, low), high);
  };
  const Enclosure m = (b.z - a.z) / (b.x - a.x), s = strip.slope - m, p = strip.height(0) - a.z + m * a.x;
  const Enclosure from = within(a.x, strip.left, strip.right), to = within(b.x, strip.left, strip.right);
  const Enclosure depth_from = p + s * from, depth_to = p + s * to;
  if (!strip.is_shaded) return share_upwards(g, strip, from) * (spring(g.K, depth_from) - spring(g.K, depth_to));

  const bool is_in_at_from = surely_at_most(0, depth_from), is_in_at_to = surely_at_most(0, depth_to);
  if (is_in_at_from && is_in_at_to) return shaded_work(g, p, s, m, from, to);
  if (surely_at_most(depth_from, 0) && surely_at_most(depth_to, 0)) return 0;
  if (lower(s) <= 0 && upper(s) >= 0) {
    // Along the surface, as far as the enclosures show: no deeper than the width of the enclosures.
    const Multiprecision most = upper(g.K * positive(larger(depth_from, depth_to)) * (abs(to - from) + abs(m * (to - from))));
    return {-most, most};
  }
  const Enclosure surface = within(-p / s, smaller(from, to), larger(from, to));
  return shaded_work(g, p, s, m, is_in_at_from ? from : surface, is_in_at_to ? to : surface);
}

// A law at one precision.
class Field {
 public:
  explicit Field(const Law& law) : law_(law), half_(half_of(law)) {}

  Enclosure work(const PathPoint& a, const PathPoint& b) const {
    const Place from{a.x, a.z}, to{b.x, b.z};
    if (half_.strips.empty()) return potential(from) - potential(to);
    if (a.x == b.x) return vertical_work(std::fabs(a.x), from.z, to.z);
    if ((a.x < 0) == (b.x < 0) || a.x == 0 || b.x == 0) return work_on_one_side(from, to);
    const Place ridge{0, from.z + (to.z - from.z) * from.x / (from.x - to.x)};
    return work_on_one_side(from, ridge) + work_on_one_side(ridge, to);
  }

 private:
  // The potential of the cylinder, and of it and the wall.
  Enclosure potential(const Place& at) const {
    const Enclosure rho = sqrt(square(at.x) + square(at.z + half_.g.d)), cylinder = spring(half_.g.K, half_.g.R - rho);
    return law_.id() == LawId::cylinder ? cylinder : cylinder + spring(half_.g.K, -at.z);
  }

  Enclosure work_on_one_side(const Place& a, const Place& b) const {
    Enclosure sum = 0;
    for (const Strip& strip : half_.strips) sum += work_in_strip(half_.g, strip, {abs(a.x), a.z}, {abs(b.x), b.z});
    return sum;
  }

  Enclosure vertical_work(float x, const Enclosure& from, const Enclosure& to) const {
    const Enclosure at = x;
    const Strip& strip = strip_at(x);
    const Enclosure height = strip.height(at);
    return share_upwards(half_.g, strip, at) * (spring(half_.g.K, height - from) - spring(half_.g.K, height - to));
  }

  const Strip& strip_at(float x) const {
    const Enclosure at = x;
    for (const Strip& strip : half_.strips) {
      if (surely_at_most(at, strip.right)) return strip;
      if (surely_less(strip.right, at)) continue;
      // w/2 is a binary32, so it is the flat top's edge that x cannot be distinguished from.
      if (Exact(2.0 * static_cast<double>(x)) <= exact_geometry(law_.parameters()).w_prime) return strip;
    }
    return half_.strips.back();
  }

  const Law& law_;
  Half half_;
};

}  // namespace

Interval work(const Law& law, const std::vector<PathPoint>& path) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  const Field field(law);
  Enclosure sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += field.work(path[i - 1], path[i]);
  return interval(sum);
}

}  // namespace forceshade::reference
