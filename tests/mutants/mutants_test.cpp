// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "mutant.h"
#include "properties/field_properties.h"
#include "properties/positions.h"
#include "tests/laws/cases.h"

namespace forceshade::tests {

std::vector<Mutant>& mutants() {
  static std::vector<Mutant> all;
  return all;
}

namespace {

// The thesis's bump, bumps that make ties, double roots and rational faces, and bumps of every size: near the surface of a
// flat top all of one bump's positions share a handful of gaps, so some mistakes show on few bumps only.
std::vector<Parameters> parameters() {
  std::vector<Parameters> sets{{15.24F, 25.4F, 0.5F},
                               {1.25F, 1.5F, 0.7F},
                               {12.7F, 25.4F, 1},
                               {3.125F, 6, 1},
                               {3.125F, 6, 1.0078125F},
                               {3.125F, 6, 1.375F},
                               {5.2F, 10.4F, 1},
                               {2197.0F / 1024, 2035.0F / 512, 1},
                               {0x1.2bddap+12F, 0x1.0a96cp+12F, 1}};
  std::mt19937_64 random(99);
  std::uniform_real_distribution<float> uniform(0, 1);
  while (sets.size() < 60) {
    const float R = std::exp2(10 * uniform(random) - 3), w = R * (0.05F + 1.9F * uniform(random));
    sets.push_back({R, w, std::exp2(6 * uniform(random) - 4)});
  }
  return sets;
}
constexpr int kPoints = 60000;

// Ties of bump-2p where the normal is (3/5, 4/5), in F_x alone for K = 129/128, in F_z alone for K = 11/8: chance does not
// find them.
std::vector<Eigen::Vector3f> ties() {
  std::vector<Eigen::Vector3f> found;
  for (float odd = 1; odd < 16; odd += 2)
    for (const float unit : {0x1p-16F, 0x1p-21F}) found.emplace_back(0.0F, 0.0F, 2.25F - 5 * (1 + odd * unit));
  return found;
}

properties::ForceAt renderer_of(const Mutant& mutant, const Parameters& p) {
  return [law = mutant.build(p)](const Eigen::Vector3f& position) {
    const MutantAnswer answer = law(position);
    return properties::Rendered{answer.force, answer.status};
  };
}

// The number of points until equivalence caught the mutant; none if it got away.
std::optional<int> points_to_catch(const Mutant& mutant) {
  std::vector<properties::RenderedLaw> subjects;
  std::vector<properties::PositionSource> sources;
  for (const Parameters& p : parameters()) {
    subjects.push_back({std::get<reference::Law>(reference::Law::build(mutant.law, p)), renderer_of(mutant, p)});
    sources.emplace_back(subjects.back().law, 99);
  }
  for (const properties::RenderedLaw& subject : subjects)
    for (const Eigen::Vector3f& tie : ties())
      if (properties::equivalence(subject, tie)) return 1;
  for (int i = 0; i < kPoints; ++i)
    for (std::size_t s = 0; s < subjects.size(); ++s)
      if (properties::equivalence(subjects[s], sources[s].next().position)) return i + 1;
  return std::nullopt;
}

// The first of the law's hard cases that the mutant gets wrong.
std::optional<HardCase> case_that_catches(const Mutant& mutant) {
  for (const HardCase& one : hard_cases(mutant.law))
    if (properties::difference(one.position, renderer_of(mutant, one.parameters)(one.position), {one.force, Status::contact}))
      return one;
  return std::nullopt;
}

// A bound that is too small shows on inputs too rare for a random stream.
bool is_of_a_bound(const Mutant& mutant) {
  const auto changes = [&](const char* what) { return mutant.change.find(what) != std::string::npos; };
  return changes("kErrorBound") || changes("error_bound") || changes("kRelativeError") || changes("kWideLimbs") ||
         changes("0x1p-");
}

TEST(mutants, with_a_smaller_bound_are_caught_by_a_hard_case) {
  int bounds = 0;
  for (const Mutant& mutant : mutants()) {
    if (!is_of_a_bound(mutant)) continue;
    ++bounds;
    const std::optional<HardCase> one = case_that_catches(mutant);
    EXPECT_TRUE(one) << name_of(mutant.law) << ": " << mutant.change;
    std::printf("  %-15s %8s  %s\n", name_of(mutant.law).data(), one ? "case" : "SURVIVED", mutant.change.c_str());
    if (one) std::printf("    by %s, %s\n", one->place.c_str(), one->why.c_str());
  }
  EXPECT_GE(bounds, 7) << "one of each law that has a bound";
}

TEST(mutants, are_all_caught) {
  EXPECT_GE(mutants().size(), 45U) << "five of each law";
  for (const Mutant& mutant : mutants()) {
    if (is_of_a_bound(mutant)) continue;
    const std::optional<int> points = points_to_catch(mutant);
    std::printf("  %-15s %8s  %s\n", name_of(mutant.law).data(), points ? std::to_string(*points).c_str() : "SURVIVED",
                mutant.change.c_str());
    EXPECT_TRUE(points) << name_of(mutant.law) << ": " << mutant.change;
  }
}

}  // namespace
}  // namespace forceshade::tests
