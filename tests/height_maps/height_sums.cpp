// SPDX-License-Identifier: BSD-3-Clause
// height_sums POINTS [SEED]: hostile sums of height maps, the fast path against the reference in every bit, by every
// instruction set. Exit code 1 if an answer differs, or if the fast path has none.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fast/heights/exact.h"
#include "forceshade/fast.h"
#include "forceshade/identity.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "reference/estimates.h"
#include "tests/height_maps/hostile_maps.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using properties::same_bits;

constexpr int kPointsOfAMap = 40;

bool same_force(const Vector3f& a, const Vector3f& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

struct Counts {
  std::uint64_t points = 0, maps = 0, refused = 0, mismatches = 0, undecided = 0;
  std::array<std::uint64_t, 3> stages{}, methods{}, statuses{};
};

void print_words(const tests::HostileMap& one, const Vector3f& position, const std::string& what) {
  std::printf("%s, stiffness %a\n", name_of(one.mode).data(), static_cast<double>(one.stiffness));
  for (const std::string& words : forceshade::words_of(one.map)) std::printf("  %s\n", words.c_str());
  std::printf("  at %s: %s\n", properties::show(position).c_str(), what.c_str());
}

void check(const tests::HostileMap& one, tests::HostileMaps& maps, Counts& counts) {
  const auto fast_built = fast::HeightMapField::build(one.map, one.mode, one.stiffness);
  if (fast::bits_of_exact_numbers(one.map) > fast::Fraction::kMostBits) {  // refused by the fast path alone
    ++counts.refused;
    counts.mismatches += !std::holds_alternative<ParameterError>(fast_built);
    return;
  }
  const auto reference_built = reference::HeightMapField::build(one.map, one.mode, one.stiffness);
  if (std::holds_alternative<ParameterError>(fast_built) != std::holds_alternative<ParameterError>(reference_built)) {
    ++counts.mismatches;
    print_words(one, {0, 0, 0}, "one side refuses the map, the other does not");
  }
  if (!std::holds_alternative<fast::HeightMapField>(fast_built)) return;
  ++counts.maps;
  const auto& fast = std::get<fast::HeightMapField>(fast_built);
  const auto& reference = std::get<reference::HeightMapField>(reference_built);
  const auto surface = [&](float x, float y) {
    const bool is_valid = std::fabs(x) <= 1e4F && std::fabs(y) <= 1e4F;
    return is_valid ? static_cast<double>(reference.estimate({x, y, 0}).gap.mid()) : 0;
  };
  std::vector<Vector3f> positions, forces;
  for (int i = 0; i < kPointsOfAMap; ++i) {
    const Vector3f position = maps.next_position(one, surface);
    const fast::Evaluation answer = fast.evaluate(position);
    const reference::Rounded exact = reference.round_to_binary32(position);
    positions.push_back(position);
    forces.push_back(answer.force);
    ++counts.points;
    ++counts.stages[static_cast<std::size_t>(answer.stage)];
    ++counts.methods[static_cast<std::size_t>(exact.method)];
    ++counts.statuses[static_cast<std::size_t>(exact.status)];
    const bool is_undecided = answer.status == Status::invalid && exact.status != Status::invalid;
    counts.undecided += is_undecided;
    if (answer.status == exact.status && same_force(answer.force, exact.force)) continue;
    if (++counts.mismatches <= 10)
      print_words(one, position,
                  (is_undecided ? "undecided, not " : properties::show(answer.force) + ", not ") +
                      properties::show(exact.force) + ", statuses " + std::to_string(static_cast<int>(answer.status)) +
                      " and " + std::to_string(static_cast<int>(exact.status)));
  }
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    std::vector<Vector3f> answers(positions.size());
    fast.force(positions, answers, set);
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (!same_force(answers[i], forces[i]) && ++counts.mismatches <= 10)
        print_words(one, positions[i], "the batch call (" + std::string(fast::name_of(set)) + ") differs from the single one");
  }
}

int run(std::uint64_t points, std::uint64_t seed) {
  tests::HostileMaps maps(seed);
  Counts counts;
  while (counts.points < points) check(maps.next_map(), maps, counts);
  std::printf("%llu points on %llu maps (%llu more refused for their size), seed %llu: %llu mismatches, %llu undecided\n",
              static_cast<unsigned long long>(counts.points), static_cast<unsigned long long>(counts.maps),
              static_cast<unsigned long long>(counts.refused), static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(counts.mismatches), static_cast<unsigned long long>(counts.undecided));
  const auto print = [](const char* what, const std::array<const char*, 3>& names,
                        const std::array<std::uint64_t, 3>& numbers) {
    std::printf("  %s:", what);
    for (std::size_t i = 0; i < 3; ++i) std::printf(" %s %llu", names[i], static_cast<unsigned long long>(numbers[i]));
    std::printf("\n");
  };
  print("stage of the fast path", {"binary64", "double-double", "wide"}, counts.stages);
  print("method of the reference", {"filter", "enclosure", "exact"}, counts.methods);
  print("status", {"free", "contact", "invalid"}, counts.statuses);
  for (const auto& numbers : {counts.stages, counts.methods, counts.statuses})
    for (const std::uint64_t number : numbers)
      if (number == 0) std::printf("  one of these was never reached\n"), ++counts.mismatches;
  return counts.mismatches == 0 ? 0 : 1;
}

}  // namespace
}  // namespace forceshade

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "height_sums: expected POINTS [SEED]\n");
    return 2;
  }
  return forceshade::run(std::strtoull(argv[1], nullptr, 10), argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
}
