// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive sweeps: they reach every input once, and notice one wrong bit; certificates join only if they fit.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>

#include "certificate/build.h"
#include "certificate/sweep_checker.h"
#include "forceshade/certify.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

// The unit that a magnitude is in.
std::uint32_t unit_of(float magnitude) {
  return std::bit_cast<std::uint32_t>(magnitude) >> kUnitBits;
}

Tally check(const Sweep& sweep, const Parameters& parameters_of_reference, float magnitude) {
  return check_unit(sweep, std::get<fast::Law>(fast::Law::build(sweep.law, sweep.parameters)),
                    std::get<reference::Law>(reference::Law::build(sweep.law, parameters_of_reference)), unit_of(magnitude));
}

TEST(sweep, unit_has_every_pattern_with_both_signs) {
  for (const SweepKind kind : {SweepKind::direction, SweepKind::line, SweepKind::column}) {
    const Tally tally = check({LawId::bump_2p_shaded, kBump, kind, -1}, kBump, 3);
    EXPECT_EQ(tally.points, 2U << kUnitBits);
    EXPECT_EQ(tally.mismatches, 0U);
    EXPECT_EQ(tally.stages[0] + tally.stages[1] + tally.stages[2], tally.points);
  }
  EXPECT_EQ(check({LawId::bump_3p, kBump, SweepKind::height, 0}, kBump, 3).points, 2U << kUnitBits);
  EXPECT_EQ(check({LawId::bump_3p, kBump, SweepKind::height, 0}, kBump, 1000).points, 0U) << "there is no surface out there";
}

TEST(sweep, notices_a_bump_that_is_one_unit_in_the_last_place_off) {
  const Parameters stiffer{15.24F, 25.4F, 0.50000006F}, rounder{15.240001F, 25.4F, 0.5F};
  for (const LawId law : {LawId::cylinder, LawId::bump_2p, LawId::bump_3p_shaded}) {
    const Tally tally = check({law, kBump, SweepKind::direction, -1}, stiffer, 3);
    EXPECT_GT(tally.mismatches, tally.points / 4);
    ASSERT_EQ(tally.counterexamples.size(), kCounterexamples);
    EXPECT_NE(tally.counterexamples[0].second.find("expected the force"), std::string::npos) << tally.counterexamples[0].second;
    EXPECT_GT(check({law, kBump, SweepKind::column, 1}, stiffer, 3).mismatches, 0U);
    EXPECT_GT(check({law, kBump, SweepKind::height, 0}, rounder, 3).mismatches, 0U);
  }
}

// A law that is wrong at chosen x of its unit: at the k-th from either end, on both sides, in the k-th of these things.
struct Fault {
  int component;                            // 3: the status
  std::optional<fast::InstructionSet> set;  // of the batch call; none for the single call
};

struct FaultyLaw {
  fast::Law right;
  std::vector<Fault> faults;
  std::uint32_t begin;  // the first bit pattern of the unit

  const Fault* at(float x) const {
    const std::uint32_t from_begin = (std::bit_cast<std::uint32_t>(x) & 0x7FFFFFFFU) - begin;
    const std::uint32_t from_end = (1U << kUnitBits) - 1 - from_begin;
    const std::uint32_t k = std::min(from_begin, from_end);
    return k < faults.size() ? &faults[k] : nullptr;
  }

  fast::Evaluation evaluate(const Eigen::Vector3f& position) const {
    fast::Evaluation answer = right.evaluate(position);
    const Fault* fault = at(position.x());
    if (fault == nullptr || fault->set) return answer;
    if (fault->component == 3)
      answer.status = Status::invalid;
    else
      answer.force[fault->component] = neighbour(answer.force[fault->component], 1);
    return answer;
  }

  void force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
             fast::InstructionSet set) const {
    right.force(x, z, fx, fz, set);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (const Fault* fault = at(x[i]); fault != nullptr && fault->set == set) {
        float& component = fault->component == 0 ? fx[i] : fz[i];
        component = neighbour(component, 1);
      }
  }
};

TEST(sweep, counts_each_wrong_component_of_each_call_at_both_ends_of_a_unit) {
  std::vector<Fault> faults{{3, {}}};
  std::vector<Fault> of_line{{0, {}}, {1, {}}, {2, {}}, {3, {}}};
  for (const fast::InstructionSet set : fast::kInstructionSets)
    if (set != fast::InstructionSet::scalar && fast::is_available(set))
      for (const int component : {0, 2})
        for (auto* all : {&faults, &of_line}) all->push_back({component, set});
  const auto reference = std::get<reference::Law>(reference::Law::build(LawId::bump_2p, kBump));
  const auto check_faulty = [&](const Sweep& sweep, const std::vector<Fault>& wrong) {
    const std::uint32_t unit = unit_of(3);
    const FaultyLaw law{std::get<fast::Law>(fast::Law::build(LawId::bump_2p, kBump)), wrong, unit << kUnitBits};
    return SweepChecker(sweep, law, reference).check(unit);
  };
  for (const SweepKind kind : {SweepKind::line, SweepKind::height}) {
    const Sweep sweep{LawId::bump_2p, kBump, kind, kind == SweepKind::line ? -1.0F : 0.0F};
    // At both ends of the unit, on both sides; of heights also on both sides of the surface.
    const std::uint64_t times = kind == SweepKind::line ? 4 : 8;
    const std::vector<Fault>& wrong = kind == SweepKind::line ? of_line : faults;
    EXPECT_EQ(check_faulty(sweep, wrong).mismatches, times * wrong.size());
  }
}

TEST(sweep, plan_has_what_each_law_needs) {
  const auto count = [](const Sweeps& sweeps, SweepKind kind) {
    return std::count_if(sweeps.results.begin(), sweeps.results.end(),
                         [&](const SweepResult& r) { return r.sweep.kind == kind; });
  };
  const std::vector<float> radii{15.24F, 20.32F};
  const Sweeps bump = planned({{LawId::bump_3p}, kBump, radii});
  EXPECT_EQ(count(bump, SweepKind::direction), 2);
  EXPECT_EQ(count(bump, SweepKind::height), 2);
  EXPECT_EQ(count(bump, SweepKind::line), 64);
  EXPECT_EQ(count(bump, SweepKind::column), 64);
  const Sweeps wall = planned({{LawId::wall}, kBump, radii});
  ASSERT_EQ(wall.results.size(), 1U) << "every z, once";
  EXPECT_EQ(wall.results[0].sweep.kind, SweepKind::column);
  for (const LawName& law : kLaws)
    for (const SweepResult& result : planned({{law.id}, kBump, radii}).results)
      EXPECT_TRUE(std::abs(result.sweep.at) <= 1e4F) << law.name;
  EXPECT_THROW(planned({{LawId::bump_3p}, kBump, {1.0F}}), std::invalid_argument) << "w > 2R";
}

// As if everything had been swept.
Certificate swept() {
  Sweeps sweeps = planned({{LawId::wall, LawId::bump_1p}, kBump, {15.24F}, false, true, false});
  sweeps.next = sweeps.end;
  sweeps.seconds = 3;
  sweeps.results[0].inputs = 6;
  return {current_build(), 3, {}, sweeps, "2026-01-31T23:59:59Z", "one"};
}

TEST(sweep, does_not_certify_a_part_or_a_mismatch) {
  Certificate part = swept(), wrong = part;
  EXPECT_TRUE(part.held());
  part.sweeps.next = --part.sweeps.end;
  EXPECT_FALSE(part.held());
  wrong.sweeps.results[1].mismatches = 1;
  EXPECT_FALSE(wrong.held());
}

}  // namespace
}  // namespace forceshade::properties
