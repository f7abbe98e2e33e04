// SPDX-License-Identifier: BSD-3-Clause
// What a device may be driven with: each thing that a certificate can lack, and the words that say so.

#include <gtest/gtest.h>

#include <functional>

#include "forceshade/certificate/evidence.h"
#include "forceshade/tests/certificate/made_certificate.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

std::string of_law(const Certificate& certificate, const Build& build = tests::made_build(), LawId law = LawId::bump_2p,
                   const Parameters& parameters = kBump) {
  return refusal(certificate, build, law, parameters).value_or("allowed");
}

std::string of_map(const Certificate& certificate, const Build& build = tests::made_build(),
                   const HeightIdentity& map = tests::made_map().identity) {
  return refusal(certificate, build, map).value_or("allowed");
}

void expect_words(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << "expected: " << words << "; got: " << said;
}

// What is wrong with a law's findings is as wrong with a map's.
void expect_both(const std::function<void(Findings&)>& change, const std::string& of_a_law, const std::string& of_a_map) {
  Certificate certificate = tests::made_certificate();
  change(certificate.laws[0]);
  change(certificate.height_maps[0]);
  expect_words(of_law(certificate), of_a_law);
  expect_words(of_map(certificate), of_a_map);
}

TEST(refusal, allows_what_was_checked_for_as_long_as_certify_does_by_default) {
  EXPECT_EQ(of_law(tests::made_certificate()), "allowed");
  EXPECT_EQ(of_map(tests::made_certificate()), "allowed");
  EXPECT_EQ(of_law(tests::made_certificate_with_sweeps()), "allowed");
  Certificate wall = tests::made_certificate();
  wall.laws[0].law = LawId::wall;
  EXPECT_EQ(of_law(wall, tests::made_build(), LawId::wall, {1, 1, 0.5F}), "allowed") << "the wall has no radius";
}

TEST(refusal, names_another_law_or_other_parameters) {
  const Certificate certificate = tests::made_certificate();
  expect_words(of_law(certificate, tests::made_build(), LawId::bump_3p), "does not cover the law bump-3p");
  for (const Parameters& other :
       {Parameters{15.240001F, 25.4F, 0.5F}, {15.24F, 25.400002F, 0.5F}, {15.24F, 25.4F, 0.50000006F}})
    expect_words(of_law(certificate, tests::made_build(), LawId::bump_2p, other),
                 "covers bump-2p with other parameters: expected");
}

TEST(refusal, names_another_build_compiler_or_flags) {
  const Certificate certificate = tests::made_certificate();
  Build build = tests::made_build();
  build.library_digest = std::string(64, 'b');
  for (const std::string& said : {of_law(certificate, build), of_map(certificate, build)})
    expect_words(said, "another build of the renderer: expected digest bbbb");
  build = tests::made_build();
  build.compiler = "Clang 14.0.6";
  for (const std::string& said : {of_law(certificate, build), of_map(certificate, build)})
    expect_words(said, "another compiler: expected Clang 14.0.6, got GNU 12.2.0");
  build = tests::made_build();
  build.flags = "-O1";
  for (const std::string& said : {of_law(certificate, build), of_map(certificate, build)})
    expect_words(said, "other compiler flags: expected -O1, got -O3 -ffp-contract=off");
}

// The code of each set is compared where it runs, or not at all.
TEST(refusal, names_an_instruction_set_that_was_not_compared) {
  const Certificate certificate = tests::made_certificate();
  Build build = tests::made_build();
  for (const char* covered : {"scalar", "avx2"}) {
    build.instruction_set = covered;
    EXPECT_EQ(of_law(certificate, build), "allowed") << covered;
    EXPECT_EQ(of_map(certificate, build), "allowed") << covered;
  }
  build.instruction_set = "avx512";
  for (const std::string& said : {of_law(certificate, build), of_map(certificate, build)})
    expect_words(said, "does not cover the instruction set that would run here");
  expect_words(of_law(certificate, build), "for bump-2p: expected avx512, got avx2, scalar");
  expect_both([](Findings& found) { found.points_by_instruction_set.erase("scalar"); }, "expected scalar, got avx2",
              "expected scalar, got avx2");
  expect_both([](Findings& found) { found.points_by_instruction_set["avx2"] -= 1; }, "expected avx2", "expected avx2");
  expect_both([](Findings& found) { found.spread.points_by_instruction_set.erase("avx2"); }, "expected avx2", "expected avx2");
}

TEST(refusal, says_that_a_check_failed) {
  const std::string law = "says that bump-2p failed", map = "says that the height map hill.toml failed";
  expect_both([](Findings& found) { found.mismatches = 1; }, law, map);
  expect_both([](Findings& found) { found.spread.mismatches = 1; }, law, map);
  expect_both([](Findings& found) { found.properties[2].held = false; }, law, map);
  expect_both([](Findings& found) { found.properties.pop_back(); }, law, map);
  expect_both([](Findings& found) { found.points = 0; }, law, map);
  Certificate swept = tests::made_certificate_with_sweeps();
  swept.sweeps.results[0].mismatches = 1;
  expect_words(of_law(swept), law);
  EXPECT_EQ(of_law(swept, tests::made_build(), LawId::cylinder), "allowed") << "another law's sweep";
}

// Whichever of two entries comes first, and whatever its parameters.
TEST(refusal, looks_at_every_entry_for_the_subject) {
  for (const bool failed_first : {true, false})
    for (const float stiffness : {0.5F, 0.75F}) {
      Certificate certificate = tests::made_certificate();
      LawResult failed = certificate.laws[0];
      failed.mismatches = 1;
      failed.parameters.stiffness = stiffness;
      certificate.laws.insert(failed_first ? certificate.laws.begin() : certificate.laws.end(), failed);
      expect_words(of_law(certificate), "says that bump-2p failed");
      HeightMapResult map = certificate.height_maps[0];
      map.mismatches = 1;
      map.identity.stiffness = stiffness;
      certificate.height_maps.insert(failed_first ? certificate.height_maps.begin() : certificate.height_maps.end(), map);
      expect_words(of_map(certificate), "hill.toml failed");
    }
}

TEST(refusal, takes_one_entry_that_is_enough_beside_one_that_is_not) {
  for (const bool small_first : {true, false}) {
    Certificate certificate = tests::made_certificate();
    LawResult small = certificate.laws[0];
    static_cast<Comparison&>(small) = tests::made_comparison(10);
    certificate.laws.insert(small_first ? certificate.laws.begin() : certificate.laws.end(), small);
    EXPECT_EQ(of_law(certificate), "allowed");
  }
}

// Enough of the same shape with another stiffness is not enough of this one.
TEST(refusal, counts_the_evidence_of_the_subject_alone) {
  for (const bool other_first : {true, false}) {
    Certificate certificate = tests::made_certificate();
    static_cast<Comparison&>(certificate.height_maps[0]) = tests::made_comparison(10);
    HeightMapResult other = tests::made_map();
    other.identity.stiffness = 0.75F;
    certificate.height_maps.insert(other_first ? certificate.height_maps.begin() : certificate.height_maps.end(), other);
    expect_words(of_map(certificate), "has 10 points for hill.toml");
    static_cast<Comparison&>(certificate.laws[0]) = tests::made_comparison(10);
    LawResult law = tests::made_law();
    law.parameters.stiffness = 0.75F;
    certificate.laws.insert(other_first ? certificate.laws.begin() : certificate.laws.end(), law);
    expect_words(of_law(certificate), "has 10 points for bump-2p");
  }
}

TEST(refusal, says_what_evidence_is_lacking) {
  expect_both([](Findings& found) { static_cast<Comparison&>(found) = tests::made_comparison(1); },
              "the certificate has 1 point for bump-2p; driving needs at least 1000000",
              "the certificate has 1 point for hill.toml; driving needs at least 200000");
  expect_both([](Findings& found) { static_cast<Comparison&>(found) = tests::made_comparison(found.points - 1); },
              "has 999999 points for bump-2p; driving needs at least 1000000",
              "has 199999 points for hill.toml; driving needs at least 200000");
  expect_both([](Findings& found) { static_cast<Comparison&>(found.spread) = tests::made_comparison(found.spread.points - 1); },
              "has 249999 points for bump-2p with other parameters; driving needs at least 250000",
              "has 49999 points for hill.toml with other parameters; driving needs at least 50000");
  for (const std::string_view aim : kAimNames)
    for (const bool of_spread : {false, true}) {
      const std::string words = "has no point of the aim \"" + std::string(aim) + "\" for ";
      const std::string with = of_spread ? " with other parameters" : "";
      const auto none = [&](Findings& found) {
        (of_spread ? static_cast<Comparison&>(found.spread) : found).points_by_aim[std::string(aim)] = 0;
      };
      expect_both(none, words + "bump-2p" + with + "; driving needs some of each aim", words + "hill.toml" + with);
    }
  for (const std::string_view status : kStatusNames)
    expect_both(
        [&](Findings& found) {
          found.points_by_status[std::string(status)] = found.spread.points_by_status[std::string(status)] = 0;
        },
        "has no point of the status \"" + std::string(status) + "\" for bump-2p",
        "has no point of the status \"" + std::string(status) + "\" for hill.toml");
  for (std::size_t i = 0; i < kPropertyNames.size(); ++i)
    expect_both(
        [i](Findings& found) { found.properties[i].cases -= 1; },
        std::string("has ") + (i == 3 ? "199" : "1999") + " cases of " + std::string(kPropertyNames[i]) + " for bump-2p",
        "driving needs at least " + std::string(i == 3 ? "200" : "2000"));
}

TEST(refusal, expects_each_stage_that_can_be_reached) {
  const auto without = [](LawId law, std::string_view stage, bool in_spread_too) {
    Certificate certificate = tests::made_certificate();
    certificate.laws[0].law = law;
    certificate.laws[0].points_by_stage[std::string(stage)] = 0;
    if (in_spread_too) certificate.laws[0].spread.points_by_stage[std::string(stage)] = 0;
    return of_law(certificate, tests::made_build(), law);
  };
  for (const LawName& law : kLaws)
    for (const std::string_view stage : kStageNames) {
      if (law.id == LawId::cylinder) continue;  // it is in the certificate a second time
      const bool is_product = law.id == LawId::wall || law.id == LawId::bump_1p;
      const bool is_reached =
          stage == "binary64" || (!is_product && !(law.id == LawId::bump_1p_shaded && stage == "double-double"));
      EXPECT_EQ(without(law.id, stage, false), "allowed") << law.name << ", which is reached in the spread";
      if (is_reached)
        expect_words(without(law.id, stage, true), "no point that the stage \"" + std::string(stage) + "\" decided");
      else
        EXPECT_EQ(without(law.id, stage, true), "allowed") << law.name << ' ' << stage;
    }
  Certificate certificate = tests::made_certificate();
  certificate.height_maps[0].points_by_stage = certificate.height_maps[0].spread.points_by_stage = {{"binary64", 1}};
  EXPECT_EQ(of_map(certificate), "allowed") << "a plane is decided by binary64";
}

TEST(refusal, says_that_sweeps_alone_are_not_enough) {
  Certificate swept = tests::made_certificate_with_sweeps();
  swept.laws.clear();
  swept.height_maps.clear();
  EXPECT_TRUE(swept.held());
  for (const std::string& said : {of_law(swept), of_map(swept)})
    expect_words(said, "the certificate has sweeps only; driving needs one of points and properties too");
}

TEST(refusal, names_what_differs_of_a_height_map) {
  const Certificate certificate = tests::made_certificate();
  HeightIdentity other = tests::made_map().identity;
  other.map_digest = std::string(64, 'd');
  expect_words(of_map(certificate, tests::made_build(), other), "another shape: expected map digest dddd");
  other = tests::made_map().identity;
  other.rendering = height::Rendering::conservative;
  expect_words(of_map(certificate, tests::made_build(), other),
               "another rendering: expected height-map-conservative, got height-map");
  other = tests::made_map().identity;
  other.stiffness = 0.6F;
  expect_words(of_map(certificate, tests::made_build(), other), "another stiffness: expected 0.6 N/mm, got 0.5 N/mm");
  // Of two, the one of this shape says what differs.
  Certificate two = certificate;
  HeightMapResult another = tests::made_map();
  another.identity.map_digest = std::string(64, 'd');
  two.height_maps[0].identity.rendering = height::Rendering::conservative;
  two.height_maps[0].identity.stiffness = 0.75F;
  two.height_maps.push_back(another);
  expect_words(of_map(two), "another rendering: expected height-map, got height-map-conservative");
  Certificate laws = certificate;
  laws.height_maps.clear();
  expect_words(of_map(laws), "covers no height map");
}

}  // namespace
}  // namespace forceshade::properties
