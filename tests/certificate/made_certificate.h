// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A certificate as certify makes one, of a check that was long enough for driving; made without checking anything.

#include <string>
#include <vector>

#include "forceshade/certificate.h"
#include "rendering/breakdown.h"

namespace forceshade::tests {

template <std::size_t kCount>
properties::Comparison::Counts shared_out(std::uint64_t points, const std::array<std::string_view, kCount>& names) {
  properties::Comparison::Counts counts;
  for (const std::string_view name : names) counts[std::string(name)] = points / kCount;
  counts[std::string(names.front())] += points % kCount;
  return counts;
}

inline properties::Comparison made_comparison(std::uint64_t points) {
  properties::Comparison found;
  found.points = points;
  for (const char* set : {"scalar", "avx2"}) found.points_by_instruction_set[set] = points;
  found.points_by_aim = shared_out(points, properties::kAimNames);
  found.points_by_stage = shared_out(points, properties::kStageNames);
  found.points_by_method = shared_out(points, properties::kMethodNames);
  found.points_by_status = shared_out(points, properties::kStatusNames);
  return found;
}

inline properties::Findings made_findings(std::uint64_t points) {
  properties::Findings found{made_comparison(points)};
  found.jumps = {"|x| = w/2"};
  found.closest_call = {1.5F, 0.25F, -0.25F, 3e-7};
  for (const std::string_view name : properties::kPropertyNames)
    found.properties.push_back({std::string(name), properties::cases_of(name, properties::kCases), true, ""});
  found.energy = {{0.5, {0.25, 0.250001}, 0.25, 0.2499}};
  found.spread = {made_comparison(properties::spread_points(points)), 7};
  return found;
}

inline properties::SubjectResult made_subject(Identity identity, std::vector<std::string> parts = {}) {
  const std::uint64_t points = properties::points_of_kind(identity.kind);
  return {made_findings(points), std::move(identity), std::move(parts), true, {7}, {}, {}, properties::RenderedBy::library};
}

inline properties::SubjectResult made_law(LawId law = LawId::bump_2p, const Parameters& parameters = {15.24F, 25.4F, 0.5F}) {
  return made_subject(identity_of(law, parameters));
}

// A map that does not exist: its digest is made up.
inline Identity made_map_identity(height::Mode mode = height::Mode::true_height, float stiffness = 0.5F) {
  Identity identity = identity_of("hill.toml", {}, mode, stiffness);
  identity.digest = std::string(64, 'c');
  return identity;
}

inline properties::SubjectResult made_map(height::Mode mode = height::Mode::true_height, float stiffness = 0.5F) {
  return made_subject(made_map_identity(mode, stiffness), {"gaussian: x_mm 0, y_mm 0, height_mm 3, sigma_mm 5"});
}

inline properties::Build made_build() {
  return {"0.1.0", "c0ffee", "GNU 12.2.0", "-O3 -ffp-contract=off", "avx2", std::string(64, 'a')};
}

// A certificate of two laws and a height map.
inline properties::Certificate made_certificate() {
  return {made_build(), 1.5, {made_law(), made_law(LawId::cylinder), made_map()}, {}, "2026-01-31T23:59:59Z", "a processor"};
}

// The same with sweeps, done to the end.
inline properties::Certificate made_certificate_with_sweeps() {
  properties::Certificate certificate = made_certificate();
  properties::Sweeps& sweeps = certificate.sweeps;
  sweeps.results = {{{LawId::bump_2p, {15.24F, 25.4F, 0.5F}, properties::SweepKind::height, 0}, 1000, 0},
                    {{LawId::wall, {.stiffness = 0.5F}, properties::SweepKind::column, 0.25F}, 2000, 0}};
  sweeps.end = sweeps.next = sweeps.units();
  sweeps.stages = {3900, 90, 10};
  sweeps.seconds = 2.5;
  return certificate;
}

// With a point, a property and a sweep that failed.
inline properties::Certificate made_failed_certificate() {
  properties::Certificate certificate = made_certificate_with_sweeps();
  certificate.subjects[0].mismatches = 2;
  certificate.subjects[0].counterexamples = {"at 1", "at 2"};
  certificate.subjects[1].spread.mismatches = 1;
  certificate.subjects[1].spread.counterexamples = {"with K = 3"};
  certificate.subjects[2].properties[3] = {"passivity", 4, false, "a loop\nof two lines"};
  certificate.sweeps.results[1].mismatches = 1;
  certificate.sweeps.counterexamples = {"at 3"};
  return certificate;
}

}  // namespace forceshade::tests
