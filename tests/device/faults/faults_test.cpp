// SPDX-License-Identifier: BSD-3-Clause
// Every fault of the catalogue is answered as the catalogue says; and the campaign notices when it is not.

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/device/faults/fault.h"

namespace forceshade::faults {

// Google Test's name for a parameter.
void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.what;
}

namespace {

std::string all_of(const std::vector<std::string>& complaints) {
  std::string all;
  for (const std::string& complaint : complaints) all += complaint + "\n";
  return all;
}

class fault : public testing::TestWithParam<Fault> {};

TEST_P(fault, has_its_reaction) {
  const Outcome outcome = tried(GetParam());
  EXPECT_EQ(all_of(complaints(GetParam(), outcome)), "");
  std::printf("  %s; %.3g N before; zero after %s ticks; %zu lost\n", outcome.reaction.substr(0, 300).c_str(), outcome.before,
              outcome.to_zero ? std::to_string(*outcome.to_zero).c_str() : "no", outcome.lost);
}

std::string test_name(const testing::TestParamInfo<Fault>& info) {
  std::string name = name_of(info.param.kind) + "_" + info.param.what;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(faults, fault, testing::ValuesIn(catalogue()), test_name);

// The same loop on a device that says it cannot push, which is therefore not supervised.
TEST(faults, are_noticed_where_the_supervisor_does_nothing) {
  int noticed = 0;
  for (const Fault& fault : catalogue()) {
    if (fault.kind != Kind::device && fault.kind != Kind::timing) continue;
    if (!fault.reaction.starts_with("trip: ") && !fault.reaction.starts_with("limited: ")) continue;
    EXPECT_FALSE(complaints(fault, tried(fault, {.supervised = false})).empty()) << fault.what;
    ++noticed;
  }
  EXPECT_GE(noticed, 20);
}

TEST(faults, are_noticed_where_samples_are_lost) {
  for (const Fault& fault : position_faults()) {
    const std::string complaint = all_of(complaints(fault, tried(fault, {.records_all = false})));
    EXPECT_NE(complaint.find("lost"), std::string::npos) << fault.what << ": " << complaint;
  }
}

// Each of these alone.
TEST(faults, are_noticed_in_every_part_of_an_outcome) {
  const Fault fault{.kind = Kind::device, .what = "a fault", .reaction = "trip ... jump", .to_zero = 1, .lost = 2};
  const Outcome good{"trip: a jump", true, 0.5, 1, 1, 2};
  EXPECT_EQ(all_of(complaints(fault, good)), "");
  const auto bad = [&](auto change) {
    Outcome outcome = good;
    change(outcome);
    return complaints(fault, outcome).size();
  };
  EXPECT_EQ(bad([](Outcome& o) { o.reaction = "goes on"; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.reaction = "jump: trip"; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.took_effect = false; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.before = 0; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.highest = HUGE_VAL; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.to_zero = 2; }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.to_zero.reset(); }), 1U);
  EXPECT_EQ(bad([](Outcome& o) { o.lost = 3; }), 1U);
}

TEST(faults, page_has_every_one) {
  std::ostringstream page;
  page << std::ifstream(FORCESHADE_SOURCE_DIR "/docs/tables/faults.md").rdbuf();
  for (const Fault& fault : catalogue()) EXPECT_NE(page.str().find("| " + fault.what + " |"), std::string::npos) << fault.what;
}

}  // namespace
}  // namespace forceshade::faults
