// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive sweeps: they reach every input once, notice one wrong bit, and their parts join only if they fit.

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

// Two sweeps; only units that cost next to nothing are done below.
Sweeps small_plan() {
  return planned({{LawId::wall, LawId::bump_1p}, kBump, {15.24F}, false, true, false});
}

std::string text_of(Sweeps sweeps) {
  sweeps.seconds = 0;
  return to_json({current_build(), 0, {}, sweeps, "2026-01-31T23:59:59Z"});
}

TEST(sweep, goes_on_where_it_was_stopped_with_any_number_of_threads) {
  Sweeps part = part_of(small_plan(), 1, 256);
  ASSERT_EQ(part.end, 4U);
  const Sweeps at_once = continued(part, 100, 1);
  EXPECT_TRUE(at_once.is_finished());
  EXPECT_EQ(at_once.inputs(), 4 * (2U << kUnitBits));
  const Sweeps half = continued(part, 2, 2);
  EXPECT_FALSE(half.is_finished());
  const Sweeps read_back = from_json(text_of(half), "here.json").sweeps;
  EXPECT_EQ(text_of(continued(read_back, 100, 3)), text_of(at_once));
}

TEST(sweep, adds_the_time_that_it_takes_to_that_before) {
  Sweeps part = part_of(small_plan(), 1, 256);
  part.seconds = 1000;
  EXPECT_GT(continued(part, 1, 1).seconds, 1000);
}

// The findings before a stop stay, and later ones are added.
TEST(sweep, keeps_what_it_found_when_it_goes_on) {
  Sweeps part = part_of(small_plan(), 1, 256);
  part = continued(part, 2, 1);
  const std::uint64_t inputs = part.inputs();
  const auto stages = part.stages;
  part.results[0].mismatches = 3;
  part.counterexamples = {"at 1", "at 2", "at 3"};
  const Sweeps end = continued(from_json(text_of(part), "here.json").sweeps, 2, 1);
  EXPECT_TRUE(end.is_finished());
  EXPECT_EQ(end.results[0].mismatches, 3U);
  EXPECT_EQ(end.counterexamples, part.counterexamples);
  EXPECT_EQ(end.inputs(), 2 * inputs);
  for (std::size_t i = 0; i < stages.size(); ++i) EXPECT_EQ(end.stages[i], 2 * stages[i]);
}

TEST(sweep, parts_tile_the_whole) {
  std::uint64_t end = 0;
  for (std::uint64_t k = 1; k <= 7; ++k) {
    const Sweeps part = part_of(small_plan(), k, 7);
    EXPECT_EQ(part.first, end);
    end = part.end;
  }
  EXPECT_EQ(end, small_plan().units());
}

// As if part k of n had been swept.
CertificateFile finished_part(std::uint64_t k, std::uint64_t n) {
  Sweeps part = part_of(small_plan(), k, n);
  part.next = part.end;
  part.seconds = 1;
  part.results[0].inputs = k;
  return {"part " + std::to_string(k), {current_build(), 1, {}, part, "2026-01-31T23:59:59Z", "one"}};
}

std::string refusal_to_merge(const std::vector<CertificateFile>& files) {
  try {
    merged(files);
  } catch (const CertificateError& error) {
    return error.what();
  }
  return "merged";
}

TEST(merge, joins_parts_in_any_order_and_a_certificate_of_points) {
  const Certificate sum = merged({finished_part(3, 3), finished_part(1, 3), finished_part(2, 3)});
  EXPECT_TRUE(sum.held());
  EXPECT_EQ(sum.sweeps.inputs(), 6U);
  EXPECT_EQ(sum.sweeps.seconds, 3);
  Certificate points{current_build(), 1, {}, {}};
  points.subjects.push_back({});
  points.subjects[0].seeds = {7};
  const Certificate both = merged({finished_part(1, 2), {"points", points}, finished_part(2, 2)});
  EXPECT_EQ(both.seeds(), std::vector<std::uint64_t>{7});
  EXPECT_EQ(both.subjects.size(), 1U);
  EXPECT_TRUE(both.sweeps.is_whole());
  CertificateFile elsewhere = finished_part(2, 2), here = finished_part(1, 2);
  elsewhere.certificate.date = "2026-02-01T00:00:00Z";
  here.certificate.processor = "one";
  elsewhere.certificate.processor = "another";
  const Certificate two = merged({elsewhere, here});
  EXPECT_EQ(two.date, "2026-02-01T00:00:00Z") << "the latest";
  EXPECT_EQ(two.processor, "another; one") << "in the order of the files";
}

TEST(merge, refuses_what_does_not_fit_and_names_it) {
  const auto expect = [](const std::vector<CertificateFile>& files, const char* words) {
    const std::string answer = refusal_to_merge(files);
    EXPECT_NE(answer.find(words), std::string::npos) << answer;
  };
  expect({}, "expected at least one part");
  expect({finished_part(1, 3), finished_part(3, 3)}, "missing part: units 341 to 682, between part 1 and part 3");
  expect({finished_part(2, 2)}, "missing part: units 0 to 512, before part 2");
  expect({finished_part(1, 2)}, "missing part: units 512 to 1024, after part 1");
  expect({finished_part(1, 2), finished_part(1, 2), finished_part(2, 2)}, "overlaps part 1");
  CertificateFile other = finished_part(2, 2);
  other.certificate.build.library_digest = "0";
  expect({finished_part(1, 2), other}, "part 2: expected the build of part 1");
  other = finished_part(2, 2);
  --other.certificate.sweeps.next;
  expect({finished_part(1, 2), other}, "part 2: expected a finished part; units 1023 to 1024 are not done");
  other = finished_part(2, 2);
  other.certificate.sweeps.results[0].sweep.parameters.stiffness = 1;
  expect({finished_part(1, 2), other}, "part 2: expected the sweeps of part 1");
  const CertificateFile points{"points", {current_build(), 1, {{}}, {}}};
  expect({points}, "points: expected another certificate to join it to");
}

TEST(merge, does_not_certify_a_part_or_a_mismatch) {
  EXPECT_FALSE(finished_part(1, 2).certificate.held());
  EXPECT_TRUE(finished_part(1, 1).certificate.held());
  Certificate wrong = finished_part(1, 1).certificate;
  wrong.sweeps.results[1].mismatches = 1;
  EXPECT_FALSE(wrong.held());
}

}  // namespace
}  // namespace forceshade::properties
