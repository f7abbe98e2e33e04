// SPDX-License-Identifier: BSD-3-Clause
// conform compare: two runs of one renderer side by side.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "properties/conformance/judgement_text.h"
#include "properties/conformance/simulators/conform_simulator.h"
#include "report/conformance/comparison.h"
#include "tests/support/has.h"
#include "tests/support/words.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
using tests::has;

// A run of some cases at which the wall answered with its stiffness times so much.
Conformance run_of(float factor) {
  const Description wall{"wall", DescribedLaw{LawId::wall, {.stiffness = 0.5F}}};
  const std::shared_ptr<const properties::Subject> subject = properties::subject_of(wall);
  Judge judge(subject, {});
  for (const float z : {-1.0F, -2.0F, -3.0F}) judge.add({{0, 0, z}, z == -1, {0, 0, -0.5F * z * factor}, "surface"});
  Conformance found;
  found.identity = subject->identity();
  found.hello.name = "mine";
  found.hello.version = "1";
  found.judgement = judge.judgement();
  found.invariants = {{"at rest", 20}, {"no force in the air", 30}, {"flat", 0, {}, "it has no meshes"}};
  return found;
}

Json report_of(const Conformance& found) {
  return json_of(found, {{.points = 3}, "0.1.0", "forceshade conform"});
}

Comparison compared(const Json& before, const Json& after) {
  return compare(before.dump(), "a.json", after.dump(), "b.json");
}

Comparison compared(const Conformance& before, const Conformance& after) {
  return compared(report_of(before), report_of(after));
}

// "worse: what: before became after" of each change.
std::vector<std::string> lines_of(const Comparison& found) {
  std::vector<std::string> lines;
  for (const Change& change : found.changes)
    lines.push_back(std::vector<std::string>{"worse", "better", "changed"}[static_cast<std::size_t>(change.direction)] + ": " +
                    change.what + ": " + change.before + " became " + change.after);
  return lines;
}

using Lines = std::vector<std::string>;

TEST(comparison, finds_nothing_between_two_equal_runs) {
  for (const float factor : {1.0F, 1.001F}) {
    const Comparison found = compared(run_of(factor), run_of(factor));
    EXPECT_FALSE(found.is_worse());
    EXPECT_TRUE(found.changes.empty());
    EXPECT_TRUE(has(words_of(found), "not worse: 0 got worse, 0 got better\n"));
  }
}

TEST(comparison, says_what_got_worse_and_what_got_better) {
  const Comparison worse = compared(run_of(1), run_of(2));
  EXPECT_TRUE(worse.is_worse());
  EXPECT_EQ(lines_of(worse),
            (Lines{"worse: answers beyond the tolerance: 0 became 3",
                   "worse: answers beyond the tolerance, aimed at surface: 0 became 3",
                   "worse: answers that are not correctly rounded: 0 became 3",
                   "worse: answers that are not correctly rounded, aimed at surface: 0 became 3",
                   "worse: the largest error in N: 0 became 1.5", "worse: the largest error in ulp: 0 became 8388608"}));
  const Comparison better = compared(run_of(2), run_of(1));
  EXPECT_FALSE(better.is_worse());
  EXPECT_EQ(better.changes.size(), 6U);
  EXPECT_TRUE(has(words_of(better), "better: the largest error in N: 1.5 became 0\n"));
}

TEST(comparison, takes_an_answer_without_a_number_for_the_largest_error) {
  const Comparison found = compared(run_of(2), run_of(HUGE_VALF));
  EXPECT_EQ(lines_of(found), (Lines{"worse: the largest error in N: 1.5 became no finite force",
                                    "worse: the largest error in ulp: 8388608 became no finite force"}));
}

TEST(comparison, looks_at_each_invariant) {
  Conformance failed = run_of(1), fewer = run_of(1), more = run_of(1);
  failed.invariants[0].violation = "tick 3";
  fewer.invariants.pop_back();
  fewer.invariants.pop_back();
  more.invariants[2] = {"flat", 5};
  EXPECT_EQ(lines_of(compared(run_of(1), failed)), Lines{"worse: at rest: held became FAILED"});
  EXPECT_TRUE(has(words_of(compared(run_of(1), failed)), "  tick 3\n"));
  EXPECT_EQ(lines_of(compared(failed, run_of(1))), Lines{"better: at rest: FAILED became held"});
  EXPECT_EQ(lines_of(compared(run_of(1), fewer)), Lines{"worse: no force in the air: held became not tried"});
  EXPECT_EQ(lines_of(compared(run_of(1), more)), Lines{"better: flat: not tried became held"});
  more.invariants[2].violation = "a ghost";
  EXPECT_EQ(lines_of(compared(run_of(1), more)), Lines{"worse: flat: not tried became FAILED"});
}

// Few answers have few errors.
TEST(comparison, takes_fewer_answers_for_worse_and_compares_none_of_their_errors) {
  Conformance ended = run_of(1);
  ended.judgement = {};
  ended.failure = "it was killed";
  EXPECT_EQ(lines_of(compared(run_of(2), ended)),
            (Lines{"worse: the run: judged became ended early: it was killed", "worse: answers that were judged: 3 became 0"}));
  EXPECT_FALSE(compared(ended, run_of(2)).is_worse());
}

TEST(comparison, decides_nothing_by_times_versions_and_what_is_declared) {
  Conformance before = run_of(1), after = run_of(1);
  before.timing = Timing{4000, 1e-5, 2e-5, 3e-5};
  after.timing = Timing{4000, 1e-4, 2e-4, 3e-4};
  after.hello.version = "2";
  after.hello.declared["memory"] = "path";
  const Comparison found = compared(before, after);
  EXPECT_FALSE(found.is_worse());
  ASSERT_EQ(found.changes.size(), 2U);
  EXPECT_TRUE(has(words_of(found), "before: mine 1 (a.json)\nafter:  mine 2 (b.json)\n"));
  EXPECT_TRUE(has(words_of(found),
                  "changed: the time of an answer: half within 10 µs, 99.9 % within 20 µs, the slowest 30 µs became "));
  const Json json = json_of(found);
  EXPECT_EQ(json.at("worse"), false);
  EXPECT_EQ(json.at("changes").size(), 2U);
}

// A simulator that used so much of what one invariant allows.
Json simulator_with(double share) {
  Invariant invariant{"at rest", 20};
  if (share > 1) invariant.violated("0.3 N");
  invariant.share_of_allowed = share;
  simulators::SimulatorConformance found;
  found.simulator.name = "mine";
  found.invariants = {invariant};
  return simulators::json_of(found, "0.1.0", "forceshade conform");
}

TEST(comparison, decides_by_how_large_a_violation_is_and_not_by_how_much_is_used_of_what_is_allowed) {
  const auto lines = [](double before, double after) {
    return lines_of(compared(simulator_with(before), simulator_with(after)));
  };
  const std::string what = ": the largest deviation over the allowed one, at rest: ";
  EXPECT_EQ(lines(0.9, 1.1), Lines{"worse: at rest: held became FAILED"});
  EXPECT_EQ(lines(1.1, 0.9), Lines{"better: at rest: FAILED became held"});
  EXPECT_EQ(lines(2, 3), Lines{"worse" + what + "2 became 3"});
  EXPECT_EQ(lines(3, 2), Lines{"better" + what + "3 became 2"});
  EXPECT_EQ(lines(3, HUGE_VAL), Lines{"worse" + what + "3 became no finite number"});
  EXPECT_EQ(lines(0.1, 0.9), Lines{"changed" + what + "0.1 became 0.9"});
  EXPECT_EQ(lines(0, 0.02), Lines{"changed" + what + "0 became 0.02"});
  for (const auto& [before, after] : {std::pair(2.0, 2.01), {HUGE_VAL, HUGE_VAL}, {0.5, 0.9}, {1e-9, 0.009}, {0.0, 0.0}})
    EXPECT_EQ(lines(before, after), Lines{}) << before << ' ' << after;
}

std::string fault_of(const std::string& before, const std::string& after) {
  return tests::thrown_by<Error>([&] { compare(before, "a.json", after, "b.json"); });
}

TEST(comparison, refuses_a_simulator_beside_a_renderer) {
  EXPECT_EQ(fault_of(simulator_with(0).dump(), report_of(run_of(1)).dump()),
            "b.json: expected a run as that of a.json, whose schema is forceshade conformance of a simulator 1, got forceshade "
            "conformance 1");
}

TEST(comparison, refuses_runs_of_another_subject_seed_or_tolerance) {
  const Json run = report_of(run_of(1));
  const auto refusal = [&](const std::function<void(Json&)>& change) {
    Json other = run;
    change(other);
    return fault_of(run.dump(), other.dump());
  };
  EXPECT_EQ(refusal([](Json& json) { json["seed"] = 2; }), "b.json: expected a run as that of a.json, whose seed is 1, got 2");
  EXPECT_EQ(refusal([](Json& json) { json["points"] = 4; }),
            "b.json: expected a run as that of a.json, whose points is 3, got 4");
  for (const char* key : {"kind", "name", "digest", "tolerance"})
    EXPECT_TRUE(has(refusal([&](Json& json) { json["exact"][key] = "other"; }), std::string("whose ") + key + " is ")) << key;
  EXPECT_TRUE(
      has(refusal([](Json& json) { json["exact"]["parameters"]["stiffness_N_per_mm"] = 0.25; }), "whose parameters is "));
}

TEST(comparison, says_what_is_wrong_with_a_hostile_file) {
  const Json run = report_of(run_of(2));
  const auto refusal = [&](const std::function<void(Json&)>& change) {
    Json other = run;
    change(other);
    return fault_of(other.dump(), run.dump());
  };
  const std::string expected = "a.json: expected what 'forceshade conform --json' writes: ";
  EXPECT_EQ(fault_of("", run.dump()), expected + "expected JSON, got an empty text");
  EXPECT_EQ(fault_of("[]", run.dump()), expected + "it is an array; expected an object");
  EXPECT_TRUE(has(fault_of(std::string(1000, '['), run.dump()), "levels"));
  EXPECT_TRUE(has(fault_of("{\"schema\":1,\"schema\":1}", run.dump()), "stands twice"));
  EXPECT_TRUE(has(fault_of("\xff\xfe", run.dump()), "expected JSON"));
  EXPECT_TRUE(has(fault_of(run.dump() + "x", run.dump()), "expected JSON, got \"x\""));
  EXPECT_TRUE(has(fault_of("{\"schema\":\"forceshade vectors 1\"}", run.dump()),
                  "schema is \"forceshade vectors 1\"; expected \"forceshade conformance 1\""));
  EXPECT_EQ(refusal([](Json& json) { json["exact"]["all"]["wrong"] = 4; }),
            expected + "exact.all.wrong is 4; expected no more than there are cases");
  EXPECT_EQ(refusal([](Json& json) { json["exact"]["by_aim"]["surface"] = 4; }),
            expected + "exact.by_aim.surface is 4; expected an object");
  EXPECT_EQ(refusal([](Json& json) { json["invariants"][1]["name"] = "at rest"; }),
            expected + "the invariant \"at rest\" stands twice in it");
  EXPECT_TRUE(has(refusal([](Json& json) { json["renderer"]["name"] = "\x1b[2J"; }), "text without control characters"));
  // Each key is needed, and no other sort of value will do.
  for (const char* key : {"schema", "forceshade", "seed", "points", "applicable", "renderer", "exact", "invariants"}) {
    EXPECT_EQ(refusal([&](Json& json) { json.erase(key); }), expected + key + " is missing");
    EXPECT_TRUE(has(refusal([&](Json& json) { json[key] = nullptr; }), std::string(key) + " is null; expected ")) << key;
  }
  for (const char* key : {"kind", "name", "digest", "tolerance", "all"})
    EXPECT_EQ(refusal([&](Json& json) { json["exact"].erase(key); }), expected + "exact." + key + " is missing");
}

}  // namespace
}  // namespace forceshade::conformance
