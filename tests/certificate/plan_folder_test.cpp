// SPDX-License-Identifier: BSD-3-Clause
// The folder of a plan: a unit is taken by one, its result is written once, and what differs or is damaged is reported.

#include "certificate/plan_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdio.h>  // NOLINT(modernize-deprecated-headers): rename
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <functional>
#include <utility>

#include "certificate/plan.h"
#include "certificate/worker.h"
#include "forceshade/certificate.h"
#include "tests/certificate/made_certificate.h"
#include "tests/support/words.h"

namespace {

// Happens once, before the next file gets another name.
std::function<void()> before_rename;

}  // namespace

// Stands before that of the C library in this program.
extern "C" int rename(const char* from, const char* to) noexcept {
  if (const auto happens = std::exchange(before_rename, nullptr)) happens();
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

namespace forceshade::properties {
namespace {

namespace fs = std::filesystem;

class plan_folder : public testing::Test {
 protected:
  plan_folder() : path_(fs::temp_directory_path() / ("plan_folder_test-" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    PlanFolder::create(path_, "{}");
  }
  ~plan_folder() override { fs::remove_all(path_); }

  // Makes a claim look as if its holder had given no sign of life for so long.
  void age(std::uint64_t unit, std::time_t seconds) const {
    const timespec then{std::time(nullptr) - seconds, 0};
    const timespec times[]{then, then};
    ASSERT_EQ(::utimensat(AT_FDCWD, (path_ / "claims" / std::to_string(unit)).c_str(), times, 0), 0);
  }

  fs::path path_;
};

TEST_F(plan_folder, gives_a_unit_to_one_worker_until_it_is_given_back) {
  const PlanFolder folder(path_, 3);
  Claims one(folder, 300, "one"), other(folder, 300, "other");
  EXPECT_TRUE(one.take(2));
  EXPECT_FALSE(one.take(2)) << "another thread of the same process";
  EXPECT_FALSE(other.take(2));
  EXPECT_FALSE(other.take_over(2)) << "the lease has not run out";
  ASSERT_EQ(folder.claims().size(), 1U);
  EXPECT_EQ(folder.claims()[0].first, 2U);
  one.give_back(2);
  EXPECT_TRUE(other.take(2));
}

TEST_F(plan_folder, gives_a_unit_to_another_when_the_lease_has_run_out) {
  const PlanFolder folder(path_, 3);
  Claims lost(folder, 300, "lost"), other(folder, 300, "other");
  ASSERT_TRUE(lost.take(1));
  age(1, 299);
  EXPECT_FALSE(other.take_over(1));
  age(1, 302);
  EXPECT_TRUE(other.take_over(1));
  lost.give_back(1);  // the claim is no longer its own, and stays
  Claims third(folder, 300, "third");
  EXPECT_FALSE(third.take(1));
}

// Two find that the lease of a third has run out, and the slower one takes away the claim of the quicker one.
TEST_F(plan_folder, gives_a_new_claim_back_that_was_taken_away_for_an_old_one) {
  const PlanFolder folder(path_, 3);
  Claims lost(folder, 300, "lost"), quick(folder, 300, "quick"), slow(folder, 300, "slow");
  ASSERT_TRUE(lost.take(1));
  age(1, 302);
  before_rename = [&] { EXPECT_TRUE(quick.take_over(1)); };
  EXPECT_FALSE(slow.take_over(1));
  EXPECT_FALSE(before_rename);
  EXPECT_FALSE(slow.take(1)) << "it is the quick one's";
  ASSERT_EQ(folder.claims().size(), 1U) << "nothing else is left";
  quick.give_back(1);
  EXPECT_TRUE(slow.take(1));
}

TEST_F(plan_folder, touches_what_it_has_taken_while_it_lives) {
  const PlanFolder folder(path_, 3);
  Claims one(folder, 0.2, "one");
  ASSERT_TRUE(one.take(0));
  age(0, 1000);
  while (folder.claims()[0].second > 500) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_F(plan_folder, gives_everything_back_at_the_end) {
  const PlanFolder folder(path_, 3);
  {
    Claims one(folder, 300, "one");
    ASSERT_TRUE(one.take(0));
    EXPECT_EQ(folder.claims().size(), 1U);  // what it makes to know the time goes, too
  }
  EXPECT_TRUE(fs::is_empty(path_ / "claims"));
}

TEST_F(plan_folder, writes_a_result_once_and_keeps_one_that_differs_beside_it) {
  const PlanFolder folder(path_, 2000);
  EXPECT_FALSE(folder.is_done(1500));
  EXPECT_TRUE(folder.keep(1500, "first"));
  EXPECT_TRUE(folder.keep(1500, "first")) << "the same bytes again";
  EXPECT_TRUE(folder.alarms().empty());
  EXPECT_FALSE(folder.keep(1500, "second"));
  EXPECT_FALSE(folder.keep(1500, "second"));
  EXPECT_EQ(folder.kept(1500), "first");
  ASSERT_EQ(folder.alarms().size(), 1U);
  EXPECT_NE(folder.alarms()[0].string().find("results/1/1500.differs-"), std::string::npos);
  EXPECT_TRUE(folder.is_done(1500));
  EXPECT_TRUE(folder.done(1)[500]);
  EXPECT_FALSE(folder.done(1)[499]);
  EXPECT_EQ(std::distance(fs::directory_iterator(path_ / "results" / "1"), {}), 2) << "no draft is left";
}

TEST_F(plan_folder, refuses_a_result_that_is_damaged) {
  const PlanFolder folder(path_, 3);
  ASSERT_TRUE(folder.keep(0, "a result"));
  for (const std::uintmax_t size : {0U, 4U, 20U}) {
    fs::resize_file(folder.result_file(0), size);
    EXPECT_THROW(folder.kept(0), Error) << size;
  }
  std::ofstream(folder.result_file(0)) << "b result\nsha256 0\n";
  EXPECT_THROW(folder.kept(0), Error);
}

TEST_F(plan_folder, is_made_once) {
  EXPECT_THROW(PlanFolder::create(path_, "{}"), Error);
}

TEST_F(plan_folder, is_worked_through_by_threads_and_workers_once) {
  const PlanFolder folder(path_, 1050);
  std::atomic<int> calls = 0;
  const std::atomic<bool> stop = false;
  const auto result = [&](std::uint64_t unit) {
    ++calls;
    return "unit " + std::to_string(unit);
  };
  Claims first(folder, 300, "first"), second(folder, 300, "second");
  Worked by_first, by_second;
  std::thread other([&] {
    by_second = work_through(
        folder, second, {2}, result, [](const Worked&) {}, stop);
  });
  by_first = work_through(
      folder, first, {2}, result, [](const Worked&) {}, stop);
  other.join();
  EXPECT_TRUE(by_first.is_complete && by_second.is_complete);
  EXPECT_EQ(by_first.units + by_second.units, 1050U);
  EXPECT_EQ(calls, 1050);
  for (std::uint64_t unit = 0; unit < 1050; ++unit) ASSERT_EQ(folder.kept(unit), "unit " + std::to_string(unit));
}

// While it is worked on, another worker whose lease ran out keeps a result of the same unit.
TEST_F(plan_folder, counts_a_result_that_differs_from_the_one_that_came_meanwhile) {
  const PlanFolder folder(path_, 4);
  const std::atomic<bool> stop = false;
  Claims claims(folder, 300, "one");
  std::uint64_t last_alarms = 0;
  const Worked worked = work_through(
      folder, claims, {1},
      [&](std::uint64_t unit) -> std::string {
        EXPECT_TRUE(unit == 0 || unit == 3 || folder.keep(unit, unit == 1 ? "mine" : "another's"));
        return "mine";
      },
      [&](const Worked& so_far) { last_alarms = so_far.alarms; }, stop);
  EXPECT_TRUE(worked.is_complete);
  EXPECT_EQ(worked.units, 4U);
  EXPECT_EQ(worked.alarms, 1U);
  EXPECT_EQ(last_alarms, 1U);
  EXPECT_EQ(folder.kept(2), "another's");
  ASSERT_EQ(folder.alarms().size(), 1U);
  EXPECT_TRUE(folder.alarms()[0].filename().string().starts_with("2.differs-"));
}

TEST_F(plan_folder, gives_back_what_is_taken_where_a_unit_throws) {
  const PlanFolder folder(path_, 3);
  const std::atomic<bool> stop = false;
  {
    Claims claims(folder, 300, "one");
    EXPECT_THROW(work_through(
                     folder, claims, {2}, [](std::uint64_t) -> std::string { throw std::runtime_error("full"); },
                     [](const Worked&) {}, stop),
                 std::runtime_error);
  }
  EXPECT_TRUE(fs::is_empty(path_ / "claims"));
}

TEST(units, cover_every_part_of_every_item_once) {
  const Units units({{ItemKind::points, 0, 10}, {ItemKind::energies, 0, 1}, {ItemKind::sweep, 0, 512}}, 4);
  ASSERT_EQ(units.count(), 3U + 1 + 128);
  EXPECT_EQ(units.at(2), (Unit{0, 8, 10}));
  EXPECT_EQ(units.at(3), (Unit{1, 0, 1}));
  EXPECT_EQ(units.at(4), (Unit{2, 0, 4}));
  EXPECT_EQ(units.at(131), (Unit{2, 508, 512}));
}

TEST(units, give_a_text_that_is_read_back_and_belongs_to_them) {
  const Units units({{ItemKind::points, 0, 2}, {ItemKind::properties, 0, 1}, {ItemKind::energies, 0, 1}}, 1);
  const std::string plan(64, 'a');
  Found found;
  found.tally.points = 4096;
  found.tally.sets = {4096, 4096, 0};
  found.tally.mismatch(1, "at \"x\"");
  found.tally.call({1, 2, -3, 0x1p-30});
  const std::string text = text_of_unit(plan, 1, units, found);
  EXPECT_EQ(text_of_unit(plan, 1, units, unit_from_text(text, plan, 1, units, "f")), text);
  EXPECT_THROW(unit_from_text(text, std::string(64, 'b'), 1, units, "f"), Error);
  EXPECT_THROW(unit_from_text(text, plan, 0, units, "f"), Error);
  EXPECT_THROW(unit_from_text(text.substr(1), plan, 1, units, "f"), Error);
  found.properties = {{"passivity", 200, false, "a\nloop"}};
  const std::string properties = text_of_unit(plan, 2, units, found);
  EXPECT_EQ(text_of_unit(plan, 2, units, unit_from_text(properties, plan, 2, units, "f")), properties);
  found.energies = {{{0.5, {0.25, 0.250001}, 0.25, 0.2499}}, "why"};
  const std::string energies = text_of_unit(plan, 3, units, found);
  EXPECT_EQ(text_of_unit(plan, 3, units, unit_from_text(energies, plan, 3, units, "f")), energies);
}

TEST(plan, is_read_back_and_names_what_is_wrong) {
  Plan points;
  points.subject = {{"law", "wall"}};
  points.identities = {"law wall"};
  points.points = 5;
  points.cases = 3;
  const std::string text = to_json(points);
  EXPECT_EQ(to_json(plan_from_json(text, "f")), text);
  Plan sweeps;
  sweeps.sweeps = {{LawId::wall, LawId::bump_3p}, {15.24F, 25.4F, 0.5F}, {15.24F, 20.32F}, true, false, true};
  EXPECT_EQ(to_json(plan_from_json(to_json(sweeps), "f")), to_json(sweeps));
  tests::expect_words(tests::thrown_by<Error>([&] { plan_from_json("{\"schema\": 2}", "here/plan.json"); }),
                      {"here/plan.json: expected a plan"});
  points.lease = 0;
  tests::expect_words(tests::thrown_by<Error>([&] { plan_from_json(to_json(points), "here/plan.json"); }),
                      {"lease_s is 0; expected 1 or more"});
}

TEST(plan, refuses_another_build_or_instruction_set) {
  const Plan plan;
  Build build = plan.build;
  EXPECT_EQ(refusal_of_build(plan, build), "");
  build.instruction_set = "none";
  EXPECT_NE(refusal_of_build(plan, build).find("another instruction set: expected"), std::string::npos);
  for (std::string Build::*member :
       {&Build::library_digest, &Build::compiler, &Build::flags, &Build::revision, &Build::version}) {
    build = plan.build;
    build.*member += "x";
    EXPECT_NE(refusal_of_build(plan, build).find("the plan is for another"), std::string::npos);
  }
}

TEST(evidence, has_nothing_that_a_run_knows_of_itself) {
  Certificate one = tests::made_certificate_with_sweeps(), other = one;
  other.date = "2027-01-01T00:00:00Z";
  other.processor = "another";
  other.seconds = 77;
  other.sweeps.seconds = 78;
  EXPECT_NE(to_json(one), to_json(other));
  EXPECT_EQ(evidence_of(one), evidence_of(other));
  EXPECT_NE(evidence_of(one).find("\"complete\": true"), std::string::npos);
  EXPECT_NE(evidence_of(one, "units 3 of 7").find("\"complete\": false"), std::string::npos);
  EXPECT_NE(evidence_of(one, "units 3 of 7").find("units 3 of 7"), std::string::npos);
}

}  // namespace
}  // namespace forceshade::properties
