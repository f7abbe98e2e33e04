// SPDX-License-Identifier: BSD-3-Clause
// Lists the sweeps, and adds up their results.

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "forceshade/certify.h"
#include "properties/binary32.h"
#include "properties/built_or_throw.h"
#include "properties/law_claims.h"

namespace forceshade::properties {
namespace {

LawClaims claims_of(LawId law, const Parameters& parameters) {
  return LawClaims(built_or_throw(reference::Law::build(law, parameters)));
}

bool is_flat(const LawClaims& claims) {
  return claims.surface(0) == 0;
}

// Sixteen powers of two from 2^lowest on, and in each of their binades one number of 24 bits.
std::vector<float> across_binades(int lowest, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> values;
  for (int i = 0; i < 16; ++i) {
    values.push_back(std::ldexp(1.0F, lowest + i));
    values.push_back(
        std::bit_cast<float>(std::bit_cast<std::uint32_t>(values.back()) | (static_cast<std::uint32_t>(random()) & 0x7FFFFF)));
  }
  return values;
}

// 64 values of z: shallow to deep below the plane, from the plane to the top, from the plane to twice the axis's depth.
std::vector<float> chosen_z(const LawClaims& claims) {
  std::vector<float> values;
  for (const float depth : across_binades(-12, 1)) values.push_back(-depth);
  const long double top = is_flat(claims) ? claims.h : claims.surface(0);
  for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(top * (i + 0.5L) / 16));
  for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(-2 * claims.d * (i + 0.5L) / 16));
  return values;
}

// 64 values of x, none negative: near the middle and across the binades, over the width, and at every edge.
std::vector<float> chosen_x(const LawClaims& claims) {
  std::vector<float> values = across_binades(-13, 2);
  for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(claims.w / 2 * (i + 0.5L) / 16));
  for (const long double edge : {claims.w / 2, claims.w_prime / 2, claims.R})
    for (const int step : {-2, -1, 0, 1, 2}) values.push_back(neighbour(static_cast<float>(edge), step));
  values.push_back(0);
  return values;
}

}  // namespace

Sweeps planned(const SweepPlan& plan) {
  Sweeps sweeps;
  const auto add = [&](LawId law, const Parameters& p, SweepKind kind, float at) {
    sweeps.results.push_back({{law, p, kind, at}, 0, 0});
  };
  for (const LawId law : plan.laws) {
    for (const float radius : plan.radii) {
      Parameters p;  // the wall's radius and width stay unsaid
      p.stiffness = plan.parameters.stiffness;
      if (has_bump_geometry(law)) p = {radius, plan.parameters.width, p.stiffness};
      const LawClaims claims = claims_of(law, p);
      // Bumps that do not look at the radius, and the wall, are swept once.
      const bool depends_on_radius = has_bump_geometry(law) && law != LawId::bump_1p;
      if (!depends_on_radius && radius != plan.radii.front()) continue;
      if (plan.directions && depends_on_radius) add(law, p, SweepKind::direction, -1);
      if (plan.heights && is_flat(claims) && radius == plan.radii.front()) add(law, p, SweepKind::column, 0);
      if (plan.heights && !is_flat(claims)) add(law, p, SweepKind::height, 0);
    }
    if (!plan.lines || !has_bump_geometry(law)) continue;
    const LawClaims claims = claims_of(law, plan.parameters);
    for (const float z : chosen_z(claims)) add(law, plan.parameters, SweepKind::line, z);
    for (const float x : chosen_x(claims)) add(law, plan.parameters, SweepKind::column, x);
  }
  sweeps.end = sweeps.units();
  return sweeps;
}

std::vector<SweepTotal> totals(const Sweeps& sweeps) {
  std::vector<SweepTotal> rows;
  for (const SweepResult& result : sweeps.results) {
    const Sweep& sweep = result.sweep;
    auto row = std::ranges::find_if(rows, [&](const SweepTotal& r) { return r.law == sweep.law && r.kind == sweep.kind; });
    if (row == rows.end()) row = rows.insert(row, {sweep.law, sweep.kind, {}});
    if (has_bump_geometry(sweep.law) && std::ranges::count(row->radii, sweep.parameters.radius) == 0)
      row->radii.push_back(sweep.parameters.radius);
    ++row->sweeps;
    row->inputs += result.inputs;
    row->mismatches += result.mismatches;
  }
  return rows;
}

}  // namespace forceshade::properties
