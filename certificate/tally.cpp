// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/tally.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace forceshade::properties {
namespace {

template <std::size_t kCount>
Comparison::Counts named(const std::array<std::uint64_t, kCount>& counts, const std::array<std::string_view, kCount>& names) {
  Comparison::Counts result;
  for (std::size_t i = 0; i < kCount; ++i) result[std::string(names[i])] = counts[i];
  return result;
}

}  // namespace

void Tally::mismatch(std::uint64_t chunk, std::string words) {
  ++mismatches;
  if (counterexamples.size() < kCounterexamples) counterexamples.emplace_back(chunk, std::move(words));
}

void Tally::call(const ClosestCall& other) {
  const auto key = [](const ClosestCall& c) { return std::tuple(c.ulps_from_tie, c.x, c.y, c.z); };
  if (key(other) < key(closest_call)) closest_call = other;
}

void Tally::add(const Tally& other) {
  const auto sum = [](auto& into, const auto& from) {
    std::transform(into.begin(), into.end(), from.begin(), into.begin(), std::plus<>());
  };
  sum(aims, other.aims);
  sum(stages, other.stages);
  sum(methods, other.methods);
  sum(statuses, other.statuses);
  sum(sets, other.sets);
  points += other.points;
  mismatches += other.mismatches;
  call(other.closest_call);
  counterexamples.insert(counterexamples.end(), other.counterexamples.begin(), other.counterexamples.end());
  std::stable_sort(counterexamples.begin(), counterexamples.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (counterexamples.size() > kCounterexamples) counterexamples.resize(kCounterexamples);
}

Comparison Tally::comparison() const {
  Comparison found;
  found.points = points;
  found.mismatches = mismatches;
  for (std::size_t set = 0; set < sets.size(); ++set)
    if (sets[set] > 0) found.points_by_instruction_set[std::string(name_of(fast::kInstructionSets[set]))] = sets[set];
  found.points_by_aim = named(aims, kAimNames);
  found.points_by_stage = named(stages, kStageNames);
  found.points_by_method = named(methods, kMethodNames);
  found.points_by_status = named(statuses, kStatusNames);
  for (const auto& [chunk, words] : counterexamples) found.counterexamples.push_back(words);
  return found;
}

}  // namespace forceshade::properties
