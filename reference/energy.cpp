// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy.h"

#include <cmath>

#include "reference/energy/shaded_strip.h"
#include "reference/laws/with_law.h"
#include "reference/numbers/intervals.h"

namespace forceshade::reference {
namespace {

// A line where two strips meet and their directions differ, inside the domain: no loop goes round its end.
struct Line {
  Enclosure x, rise;
};

std::vector<Line> lines_of(const Half& half) {
  std::vector<Line> lines;
  for (std::size_t i = 1; i < half.strips.size(); ++i) {
    const Strip &left = half.strips[i - 1], &right = half.strips[i];
    const Enclosure& x = left.right;
    if ((left.is_shaded && right.is_shaded) || !surely_less(x, half.strips.back().right)) continue;
    lines.push_back({x, share_upwards(half.g, right, x) - share_upwards(half.g, left, x)});
  }
  return lines;
}

bool is_conservative(const Half& half) {
  const bool is_shaded = !half.strips.empty() && half.strips.front().is_shaded;
  return !is_shaded && lines_of(half).empty();
}

}  // namespace

Interval circulation_density(const Law& law, const PathPoint& at) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  const Half half = half_of(law);
  const Enclosure x = std::fabs(at.x), zero = 0;
  for (const Strip& strip : half.strips) {
    if (surely_less(strip.right, x)) continue;
    const Enclosure depth = strip.height(x) - Enclosure(at.z);
    if (!strip.is_shaded || surely_at_most(depth, 0)) break;
    const Enclosure density = circulation(half.g, strip, x, depth);
    return interval(at.x < 0 ? -density : density);
  }
  return interval(zero);
}

std::vector<LineTerm> line_terms(const Law& law) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  std::vector<LineTerm> terms;
  for (const Line& line : lines_of(half_of(law))) terms.push_back({interval(line.x), interval(line.rise)});
  return terms;
}

std::optional<std::string> potential(const Law& law) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  const char* const words = with_law(law.id(), [](auto definition) { return definition.kPotential; });
  return words != nullptr && is_conservative(half_of(law)) ? std::optional<std::string>(words) : std::nullopt;
}

LoopBound loop_bound(const Law& law, float depth) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  const Half half = half_of(law);
  const Enclosure D = depth, zero = 0, spring = half.g.K * D * D / 2;
  Enclosure positive = 0, negative = 0;
  for (const Line& line : lines_of(half)) {
    positive += spring * larger(0, line.rise);
    negative += spring * larger(0, -line.rise);
  }
  for (const Strip& strip : half.strips) {
    if (!strip.is_shaded) continue;
    const ShadedStrip shaded(half.g, strip, D);
    positive += shaded.positive();
    negative += shaded.negative();
  }
  return {interval(positive), interval(negative), interval(positive + negative)};
}

std::optional<ParameterError> depth_error(const Law& law, float depth) {
  const float least = has_bump_geometry(law.id()) ? law.parameters().radius / 1e4F : 1e-3F, most = 1e4F;
  if (depth >= least && depth <= most) return std::nullopt;
  return ParameterError{"depth", "mm", depth, least, most};
}

}  // namespace forceshade::reference
