// SPDX-License-Identifier: BSD-3-Clause
// The witness encloses what generates energy counter-clockwise at x >= 0 and, at x <= 0, the mirror image of what does so
// clockwise there. Its lower side runs from left to right, its upper side back. Where nothing is to be enclosed both run above
// the surface.

#include <algorithm>
#include <cmath>

#include "reference/energy.h"
#include "reference/energy/shaded_strip.h"
#include "reference/numbers/intervals.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

constexpr int kChords = 24;           // along one curved boundary
constexpr double kRoof = 0x1.ffp-1;   // of the depth: leaves a passage where a whole column is left out
using Side = std::vector<PathPoint>;  // from left to right

float down(const Enclosure& v) {
  return mpfr_get_flt(lower(v).backend().data(), MPFR_RNDD);
}

float up(const Enclosure& v) {
  return mpfr_get_flt(upper(v).backend().data(), MPFR_RNDU) + 0.0F;  // never -0
}

Side mirrored(Side side) {
  for (PathPoint& point : side) point.x = 0 - point.x;  // never -0
  std::reverse(side.begin(), side.end());
  return side;
}

Side joined(Side first, const Side& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<PathPoint> polygon_of(const Side& lower, const Side& upper) {
  std::vector<PathPoint> polygon = lower;
  polygon.insert(polygon.end(), upper.rbegin(), upper.rend());
  polygon.push_back(polygon.front());
  const auto is_same = [](const PathPoint& a, const PathPoint& b) { return a.x == b.x && a.z == b.z; };
  polygon.erase(std::unique(polygon.begin(), polygon.end(), is_same), polygon.end());
  return polygon;
}

// Two heights above the surface, and what is below: depths from the surface, rounded so that none is exceeded.
struct Levels {
  Enclosure depth;
  float middle, top;

  Levels(const Half& half, float D) : depth(D) {
    const Enclosure summit = half.strips.front().height(0);
    middle = std::min(kDomainEnd, up(summit + depth / 8));
    top = std::min(kDomainEnd, up(summit + depth / 4));
  }
};

// Down on the strip's right line, or just left of it, and up just right of it.
Side slit(const Levels& levels, const Strip& strip) {
  const float inside = down(strip.right);
  float outside = up(strip.right);
  while (!surely_less(strip.right, outside)) outside = std::nextafter(outside, 2 * kDomainEnd);
  const float bottom = up(strip.end - levels.depth);
  return {{inside, levels.middle}, {inside, bottom}, {outside, bottom}, {outside, levels.middle}};
}

std::vector<PathPoint> around_lines(const Half& half, const Levels& levels) {
  Side lower;
  for (std::size_t i = 1; i < half.strips.size(); ++i) {
    const Strip &left = half.strips[i - 1], &right = half.strips[i];
    if (!surely_less(left.right, kDomainEnd)) continue;
    const bool rises = surely_less(share_upwards(half.g, left, left.right), share_upwards(half.g, right, left.right));
    lower = rises ? joined(lower, slit(levels, left)) : joined(mirrored(slit(levels, left)), lower);
  }
  return polygon_of(lower, {{lower.front().x, levels.top}, {lower.back().x, levels.top}});
}

// The three boundaries under a shaded strip: of what generates energy counter-clockwise, and below and above what does so
// clockwise.
struct Boundaries {
  Side floor, bottom, roof;
  bool generates_clockwise = false;

  void add(const Strip& strip, const ShadedStrip& shaded, const Levels& levels) {
    const bool is_flat = upper(strip.slope) == 0;
    // The surface falls to the right, if it falls: there a depth is not exceeded.
    const auto place = [&](const Enclosure& x) { return is_flat ? down(x) : std::min(up(x), up(strip.right)); };
    const auto point = [&](const Enclosure& x, const Enclosure& depth) {
      return PathPoint{place(x), up(strip.height(x) - depth)};
    };
    for (const Enclosure& x : {strip.left, strip.right}) bottom.push_back(point(x, levels.depth));
    if (surely_less(strip.left, shaded.start()))
      for (const Enclosure& x : {strip.left, shaded.start()}) {
        floor.push_back({place(x), levels.middle});
        roof.push_back({place(x), levels.top});
      }
    // Points of a steep end that fall on one x are one: the way there and back would be the same.
    float reached = -1;
    const auto follow = [&](const Enclosure& from, const Enclosure& to) {
      for (int i = 0; i <= kChords; ++i) {
        const Enclosure x = from + (to - from) * i / kChords;
        if (place(x) <= reached) continue;
        reached = place(x);
        const Enclosure depth = larger(0, smaller(levels.depth, shaded.sign_change(x)));
        floor.push_back(point(x, depth));
        roof.push_back(point(x, depth * kRoof));
      }
    };
    follow(shaded.start(), shaded.first());
    follow(shaded.second(), strip.right);
    generates_clockwise =
        generates_clockwise || surely_less(strip.left, shaded.first()) || surely_less(shaded.second(), strip.right);
  }
};

std::vector<PathPoint> around_shaded(const Half& half, const Levels& levels) {
  Boundaries right;
  for (const Strip& strip : half.strips)
    if (strip.is_shaded) right.add(strip, ShadedStrip(half.g, strip, levels.depth), levels);
  const float rim = up(half.g.w / 2), bottom = -up(levels.depth);
  Side lower = right.floor;
  if (rim < kDomainEnd) lower = joined(lower, {{rim, bottom}, {std::nextafter(rim, kDomainEnd), bottom}});
  Side upper{{0, levels.top}, {lower.back().x, levels.top}};
  if (right.generates_clockwise) {
    lower = joined(mirrored(right.bottom), lower);
    upper = joined(mirrored(right.roof), upper);
  }
  return polygon_of(lower, upper);
}

}  // namespace

std::vector<PathPoint> witness(const Law& law, float depth) {
  if (potential(law)) return {};
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  const Half half = half_of(law);
  const Levels levels(half, depth);
  return half.strips.front().is_shaded ? around_shaded(half, levels) : around_lines(half, levels);
}

}  // namespace forceshade::reference
