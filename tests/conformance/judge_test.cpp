// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "forceshade/subjects.h"
#include "properties/conformance/judgement_text.h"
#include "tests/conformance/made_judgement.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::conformance {
namespace {

const Description kBump{"bump-2p", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}};

// Positions of the subject with the answers of the fast path.
std::vector<Case> answered(const Description& description, std::size_t count) {
  const auto subject = properties::subject_of(description);
  const auto positions = subject->positions(1);
  const auto session = subject->renderer().open();
  std::vector<Case> cases;
  for (std::size_t i = 0; i < count; ++i) {
    const properties::Aimed aimed = positions->next();
    cases.push_back(
        {aimed.position, i == 0, session->step(aimed.position).force, std::string(name_of(aimed.aim)), std::to_string(i)});
  }
  return cases;
}

Judgement judged(const Description& description, const std::vector<Case>& cases, const Tolerance& tolerance,
                 std::uint64_t before = 0) {
  Judge judge(properties::subject_of(description), tolerance, before);
  for (const Case& each : cases) judge.add(each);
  return judge.judgement();
}

// The first case in contact, whose answer is not near a power of two.
std::size_t one_in_contact(const std::vector<Case>& cases) {
  std::size_t i = 0;
  while (!(std::fabs(cases[i].force.z()) > 1 && std::fabs(cases[i].force.z()) < 1.5F)) ++i;
  return i;
}

TEST(judge, finds_nothing_wrong_with_the_fast_path) {
  const Judgement found = judged(kBump, answered(kBump, 5000), {});
  EXPECT_TRUE(found.held());
  EXPECT_EQ(found.all.cases, 5000U);
  EXPECT_EQ(found.all.wrong, 0U);
  EXPECT_EQ(found.by_ulps[0], 5000U);
  EXPECT_GT(found.by_aim.at("tie").cases, 50U);
  EXPECT_FALSE(found.worst[0] || found.simplest);
}

// The nearest binary32 is some 10^-8 of the force away from the exact one.
TEST(judge, measures_newtons_from_the_exact_force_and_not_from_the_nearest_number) {
  const std::vector<Case> cases = answered(kBump, 1000);
  EXPECT_TRUE(judged(kBump, cases, {Unit::newton, 1e-3}).held());
  const Judgement strict = judged(kBump, cases, {Unit::newton, 1e-15});
  EXPECT_FALSE(strict.held());
  EXPECT_EQ(strict.all.wrong, 0U);
  EXPECT_GT(strict.all.beyond, 300U);
}

TEST(judge, passes_one_number_off_at_one_ulp_and_not_at_none) {
  std::vector<Case> cases = answered(kBump, 5000);
  const std::size_t at = one_in_contact(cases);
  cases[at].force.z() = std::nextafter(cases[at].force.z(), 10.0F);
  const Judgement strict = judged(kBump, cases, {Unit::ulp, 0}), generous = judged(kBump, cases, {Unit::ulp, 1});
  EXPECT_FALSE(strict.held());
  EXPECT_EQ(strict.all.beyond, 1U);
  EXPECT_TRUE(generous.held());
  for (const Judgement& found : {strict, generous}) {
    EXPECT_EQ(found.all.wrong, 1U);
    EXPECT_EQ(found.by_aim.at(cases[at].aim).wrong, 1U);
    EXPECT_EQ(found.by_ulps[1], 1U);
    ASSERT_TRUE(found.worst[0]);
    EXPECT_EQ(found.worst[0]->its.place, std::to_string(at));
  }
  EXPECT_EQ(strict.simplest->its.place, std::to_string(at));
}

TEST(judge, takes_both_zeros_for_one_number_and_what_is_none_for_wrong) {
  std::vector<Case> cases = answered(kBump, 2000);
  for (Case& each : cases)
    for (float& component : each.force)
      if (component == 0) component = -0.0F;
  EXPECT_TRUE(judged(kBump, cases, {}).held());
  const std::size_t at = one_in_contact(cases);
  cases[at].force.y() = std::numeric_limits<float>::quiet_NaN();
  const Judgement found = judged(kBump, cases, {Unit::newton, 1e30});
  EXPECT_EQ(found.all.beyond, 1U);
  EXPECT_EQ(found.by_ulps.back(), 1U);
  EXPECT_EQ(found.by_newtons.back(), 1U);
}

TEST(judge, names_the_worst_in_each_unit_and_the_simplest) {
  Judge judge(properties::subject_of(kBump), {});
  judge.add({{2, 0, -1000}, true, {0, 0, 0}, "", "far"});        // some 500 N missing
  judge.add({{3, 0, 12}, false, {0, 0, 0x1p-149F}, "", "air"});  // an exact zero
  judge.add({{2.3456F, 0.1F, -1.234F}, false, {0, 0, 0}, "", "many bits"});
  const Judgement& found = judge.judgement();
  EXPECT_EQ(found.all.wrong, 3U);
  EXPECT_EQ(found.worst[static_cast<std::size_t>(Unit::newton)]->its.place, "far");
  EXPECT_EQ(found.worst[static_cast<std::size_t>(Unit::percent)]->its.place, "air");
  EXPECT_EQ(found.simplest->its.place, "air");
  EXPECT_EQ(found.simplest->digits[2], "0");
}

TEST(judgement, of_parts_put_together_is_that_of_all_cases) {
  std::vector<Case> cases = answered(kBump, 3000);
  for (std::size_t i = 0; i < cases.size(); i += 7) cases[i].force *= 1 + 0x1p-23F * static_cast<float>(i % 11 * i);
  Judgement parts;
  for (const auto& [begin, end] : {std::pair{0, 1000}, {1000, 1001}, {1001, 1001}, {1001, 3000}})
    parts.append(
        judged(kBump, {cases.begin() + begin, cases.begin() + end}, {Unit::ulp, 2}, static_cast<std::uint64_t>(begin)));
  const Identity identity = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});
  const Judgement whole = judged(kBump, cases, {Unit::ulp, 2});
  EXPECT_GT(whole.all.beyond, 100U);
  EXPECT_EQ(text_of(json_of(parts, identity, {Unit::ulp, 2})), text_of(json_of(whole, identity, {Unit::ulp, 2})));
}

TEST(judgement, of_parts_counts_what_is_not_judged) {
  Judgement its, later;
  its.undecided = 1;
  its.unfinished = 2;
  later.undecided = 4;
  later.unfinished = 8;
  its.append(later);
  EXPECT_EQ(its.undecided, 5U);
  EXPECT_EQ(its.unfinished, 10U);
}

// A hand that is fast on one path begins the next one at rest.
TEST(judge, begins_a_path_without_speed_where_the_case_says_so) {
  const Description wall{"wall", DescribedLaw{LawId::wall, {.stiffness = 0.5F}}};
  Judge judge(properties::subject_of(wall), {}, 0, damping::Parameters{.rate = 1000, .damping = 0.01F});
  judge.add({{0, 0, 1}, true, {0, 0, 0}, "", "air"});
  EXPECT_TRUE(judge.add({{0, 0, -1}, false, {0, 0, 0.5F}, "", "fast"})) << "which is damped";
  EXPECT_FALSE(judge.add({{0, 0, -1.5F}, true, {0, 0, 0.75F}, "", "anew"}));
}

TEST(judge, holds_of_no_case_at_all_is_nothing) {
  EXPECT_FALSE(judged(kBump, {}, {}).held());
}

// A mesh remembers: the same positions along one path, and with the path begun again, are different questions.
TEST(judge, begins_a_path_of_a_mesh_where_the_case_says_so) {
  const tests::TemporaryDirectory folder;
  folder.write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Description mesh = subjects::read_file(folder.write(
      "tetrahedron.toml", "mesh = \"tetrahedron.off\"\nunit = \"mm\"\nshading = \"none\"\nstiffness = \"0.5N/mm\"\n"));
  EXPECT_TRUE(judged(mesh, answered(mesh, 300), {}).held());
  // From outside through a face: contact at the second position. Begun there, it is inside, and free.
  const std::vector<Case> path{{{2, 2, -1}, true, {0, 0, 0}}, {{2, 2, 1}, false, {0, 0, -0.5F}}};
  const std::vector<Case> two{{{2, 2, -1}, true, {0, 0, 0}}, {{2, 2, 1}, true, {0, 0, 0}}};
  const std::vector<Case> neither{{{2, 2, -1}, true, {0, 0, 0}}, {{2, 2, 1}, true, {0, 0, -0.5F}}};
  EXPECT_TRUE(judged(mesh, path, {}).held());
  EXPECT_TRUE(judged(mesh, two, {}).held());
  EXPECT_EQ(judged(mesh, neither, {}).all.wrong, 1U);
  EXPECT_EQ(judged(mesh, {path[0], {{2, 2, 1.25F}, false, {0, 0, 0}}}, {}).worst[0]->digits[2],
            "-0.625000000000000000000000000000");
}

TEST(judgement, is_said_in_words_with_a_case_to_paste_and_as_json) {
  Judge judge(properties::subject_of(kBump), {});
  judge.add({{3, 0, -0.5F}, true, {1.3490643F, 0, 2.5137453F}, "surface", "mine.csv:2"});
  judge.add({{3, 0, -0.5F}, false, {1.3490643F, 0, 2.513745F}, "surface", "mine.csv:3"});
  const Identity identity = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});
  const std::string words = words_of(judge.judgement(), identity, {}), json = text_of(json_of(judge.judgement(), identity, {}));
  for (const char* part : {"bump-2p: correctly rounded 1 of 2 (50 %)", "wrong, aimed at surface: 1 of 2 (50 %)",
                           "mine.csv:3: at x = ", "FAILED: 1 of 2 (50 %) within the tolerance, correctly rounded",
                           "position_mm {0x1.8p+1f, 0x0p+0f, -0x1p-1f}"})
    EXPECT_NE(words.find(part), std::string::npos) << part << "\n" << words;
  for (const char* part :
       {"\"schema\": \"forceshade judgement 1\"", "\"held\": false", "\"wrong\": 1", "\"2.51374520880613724883", "mine.csv:3"})
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
}

TEST(judgement, says_each_of_its_numbers_where_it_belongs) {
  const Identity identity = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});
  const std::string words = words_of(made_judgement(), identity, {}), json = json_of(made_judgement(), identity, {}).dump();
  for (const char* part :
       {"bump-2p: correctly rounded 40 of 100 (40 %)\n", "not judged, because the definition was not decided: 3\n",
        "not judged, because the definition's god-object did not come to rest: 1\n",
        "ulp from it: 0: 40; 1: 5; 2 to 3: 6; 4 to 7: 7; no number: 42\n", "wrong, aimed at surface: 56 of 90 (62.22 %)\n",
        "wrong, aimed at tie: 4 of 10 (40 %)\n", "the largest error in ulp: 5 ulp, 0.5 N, 25 % of the force\n",
        "FAILED: 50 of 100 (50 %) within the tolerance"})
    EXPECT_NE(words.find(part), std::string::npos) << part << "\n" << words;
  for (const char* part :
       {R"("undecided":3,"unfinished":1)", R"({"ulp":"4 to 7","cases":7})", R"({"ulp":"no number","cases":42})",
        R"({"at_most":"1e-45","cases":40},{"at_most":"1e-3","cases":10},{"at_most":"1e5","cases":8})",
        R"({"at_most":null,"cases":42})", R"("surface":{"cases":90,"wrong":56,"beyond_tolerance":47})"})
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
}

TEST(counterexample, is_lines_of_c_that_lose_nothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
  const std::array<Eigen::Vector3f, 2> path{Eigen::Vector3f(3, -0.0F, 0x1p-149F), {kNan, kInfinite, -kInfinite}};
  const Identity identity{"mesh", "a\nb.off", {{"stiffness_N_per_mm", 0.5F}}};
  Judged judged;
  judged.exact.force = {0, 0, 0.1F};
  judged.its.force = {0, 0, -0.1F};
  const std::array<std::uint32_t, 2> periods{1, 20};
  EXPECT_EQ(test_to_paste(identity, path, periods, judged),
            "// a\\nb.off: stiffness 0.5 N/mm\n"
            "const float path_mm[][3] = {{0x1.8p+1f, -0x0p+0f, 0x1p-149f},\n"
            "                             {NAN, INFINITY, -INFINITY}};  // from no contact\n"
            "const unsigned periods[] = {1, 20};\n"
            "const float force_N[3] = {0x0p+0f, 0x0p+0f, 0x1.99999ap-4f};  // at its end, not {0x0p+0f, 0x0p+0f, "
            "-0x1.99999ap-4f}\n");
}

using Numbers = Sample<std::uint64_t>;

TEST(sample, keeps_all_where_they_are_few) {
  Numbers sample;
  for (std::uint64_t i = 0; i < 5; ++i) sample.add(i, 10 * i);
  std::vector<std::uint64_t> values = sample.values();
  std::ranges::sort(values);
  EXPECT_EQ(values, (std::vector<std::uint64_t>{0, 10, 20, 30, 40}));
}

TEST(sample, is_the_same_in_whatever_order_they_come) {
  constexpr std::uint64_t kCount = 3 * Numbers::kMost;
  Numbers forwards, backwards;
  for (std::uint64_t i = 0; i < kCount; ++i) forwards.add(i, i);
  for (std::uint64_t i = kCount; i-- > 0;) backwards.add(i, i);
  EXPECT_EQ(forwards.values(), backwards.values());
  EXPECT_EQ(forwards.values().size(), Numbers::kMost);
  EXPECT_EQ(forwards.seen(), kCount);
}

// Each sixteenth of the numbers has its share, to five standard deviations of a random one.
TEST(sample, prefers_neither_the_first_nor_the_last) {
  constexpr std::uint64_t kParts = 16, kOfPart = 5000;
  Numbers sample;
  for (std::uint64_t i = 0; i < kParts * kOfPart; ++i) sample.add(i, i);
  std::vector<double> kept(kParts);
  for (const std::uint64_t i : sample.values()) ++kept[i / kOfPart];
  const double expected = static_cast<double>(Numbers::kMost) / kParts;
  for (const double one : kept) EXPECT_NEAR(one, expected, 5 * std::sqrt(expected));
}

}  // namespace

}  // namespace forceshade::conformance
