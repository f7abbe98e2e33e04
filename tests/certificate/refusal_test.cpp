// SPDX-License-Identifier: BSD-3-Clause
// The refusals of drive: each thing that a certificate can lack, and the words for it.

#include <gtest/gtest.h>

#include <functional>

#include "forceshade/certificate.h"
#include "rendering/breakdown.h"
#include "tests/certificate/made_certificate.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

std::string of_law(const Certificate& certificate, const Build& build = tests::made_build(), LawId law = LawId::bump_2p,
                   const Parameters& parameters = kBump) {
  return refusal(certificate, build, identity_of(law, parameters)).value_or("allowed");
}

std::string of_map(const Certificate& certificate, const Build& build = tests::made_build(),
                   const Identity& map = tests::made_map_identity()) {
  return refusal(certificate, build, map).value_or("allowed");
}

void expect_words(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << "expected: " << words << "; got: " << said;
}

// Changes the findings of a law and of a map, and expects the refusal of each.
void expect_both(const std::function<void(Findings&)>& change, const std::string& of_a_law, const std::string& of_a_map) {
  Certificate certificate = tests::made_certificate();
  change(certificate.subjects[0]);
  change(certificate.subjects[2]);
  expect_words(of_law(certificate), of_a_law);
  expect_words(of_map(certificate), of_a_map);
}

TEST(refusal, allows_what_was_checked_for_as_long_as_certify_does_by_default) {
  EXPECT_EQ(of_law(tests::made_certificate()), "allowed");
  EXPECT_EQ(of_map(tests::made_certificate()), "allowed");
  EXPECT_EQ(of_law(tests::made_certificate_with_sweeps()), "allowed");
  Certificate wall = tests::made_certificate();
  wall.subjects[0] = tests::made_law(LawId::wall);
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
  const std::string law = "says that bump-2p failed", map = "says that hill.toml failed";
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

// A kind that the library does not have is rendered by a program alone (compares_subjects_of_any_kind).
TEST(refusal, takes_no_renderer_of_a_program_s_for_the_library_s) {
  for (const auto& [who, words] : {std::pair{RenderedBy::program, "is of a program's own renderer for "},
                                   {RenderedBy::unknown, "does not say whose renderer was compared for "}})
    for (const bool library_first : {true, false}) {
      Certificate certificate = tests::made_certificate();
      const auto another = [who = who](SubjectResult of) {
        of.rendered_by = who;
        return of;
      };
      const SubjectResult law = another(certificate.subjects[0]), map = another(certificate.subjects[2]);
      const auto at = library_first ? certificate.subjects.end() : certificate.subjects.begin();
      certificate.subjects.insert(at, {law, map});
      EXPECT_EQ(of_law(certificate), "allowed") << "the library's is there, too";
      EXPECT_EQ(of_map(certificate), "allowed");
      for (SubjectResult& one : certificate.subjects)
        if (one.rendered_by == RenderedBy::library) static_cast<Comparison&>(one) = tests::made_comparison(10);
      expect_words(of_law(certificate), "has 10 points for bump-2p");
      expect_words(of_map(certificate), "has 10 points for hill.toml");
      certificate.subjects = {law, map};
      expect_words(of_law(certificate), std::string(words) + "bump-2p; driving needs one of the library's");
      expect_words(of_map(certificate), std::string(words) + "hill.toml; driving needs one of the library's");
    }
}

TEST(refusal, says_that_it_was_a_program_s_own_renderer_that_failed_where_no_other_did) {
  for (const bool library_failed : {false, true})
    for (const bool library_first : {true, false}) {
      Certificate certificate = tests::made_certificate();
      if (library_failed) certificate.subjects[0].mismatches = 1;
      SubjectResult own = tests::made_law();
      own.mismatches = 1;
      own.rendered_by = RenderedBy::program;
      certificate.subjects.insert(library_first ? certificate.subjects.end() : certificate.subjects.begin(), own);
      EXPECT_EQ(of_law(certificate), library_failed ? "the certificate says that bump-2p failed"
                                                    : "the certificate says that a program's own renderer of bump-2p failed");
    }
}

// Either of two entries may come first, with any parameters.
TEST(refusal, looks_at_every_entry_for_the_subject) {
  for (const bool failed_first : {true, false})
    for (const float stiffness : {0.5F, 0.75F}) {
      Certificate certificate = tests::made_certificate();
      SubjectResult failed = tests::made_law(LawId::bump_2p, {15.24F, 25.4F, stiffness});
      failed.mismatches = 1;
      certificate.subjects.insert(failed_first ? certificate.subjects.begin() : certificate.subjects.end(), failed);
      expect_words(of_law(certificate), "says that bump-2p failed");
      SubjectResult map = tests::made_map(height::Mode::true_height, stiffness);
      map.mismatches = 1;
      certificate.subjects.insert(failed_first ? certificate.subjects.begin() : certificate.subjects.end(), map);
      expect_words(of_map(certificate), "hill.toml failed");
    }
}

TEST(refusal, takes_one_entry_that_is_enough_beside_one_that_is_not) {
  for (const bool small_first : {true, false}) {
    Certificate certificate = tests::made_certificate();
    SubjectResult small = tests::made_law();
    static_cast<Comparison&>(small) = tests::made_comparison(10);
    certificate.subjects.insert(small_first ? certificate.subjects.begin() : certificate.subjects.end(), small);
    EXPECT_EQ(of_law(certificate), "allowed");
  }
}

// Enough of the same shape with another stiffness is not enough of this one.
TEST(refusal, counts_the_evidence_of_the_subject_alone) {
  for (const bool other_first : {true, false}) {
    Certificate certificate = tests::made_certificate();
    static_cast<Comparison&>(certificate.subjects[0]) = tests::made_comparison(10);
    static_cast<Comparison&>(certificate.subjects[2]) = tests::made_comparison(10);
    for (const SubjectResult& other :
         {tests::made_map(height::Mode::true_height, 0.75F), tests::made_law(LawId::bump_2p, {15.24F, 25.4F, 0.75F})})
      certificate.subjects.insert(other_first ? certificate.subjects.begin() : certificate.subjects.end(), other);
    expect_words(of_map(certificate), "has 10 points for hill.toml");
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
    certificate.subjects[0] = tests::made_law(law);
    certificate.subjects[0].points_by_stage[std::string(stage)] = 0;
    if (in_spread_too) certificate.subjects[0].spread.points_by_stage[std::string(stage)] = 0;
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
  certificate.subjects[2].points_by_stage = certificate.subjects[2].spread.points_by_stage = {{"binary64", 1}};
  EXPECT_EQ(of_map(certificate), "allowed") << "a plane is decided by binary64";
}

TEST(refusal, says_that_sweeps_alone_are_not_enough) {
  Certificate swept = tests::made_certificate_with_sweeps();
  swept.subjects.clear();
  EXPECT_TRUE(swept.held());
  for (const std::string& said : {of_law(swept), of_map(swept)})
    expect_words(said, "the certificate has sweeps only; driving needs one of points and properties");
}

TEST(refusal, names_what_differs_of_a_height_map) {
  const Certificate certificate = tests::made_certificate();
  Identity other = tests::made_map_identity();
  other.digest = std::string(64, 'd');
  expect_words(
      of_map(certificate, tests::made_build(), other),
      "covers another height map: expected the digest " + other.digest + ", got " + std::string(64, 'c') + " (hill.toml)");
  expect_words(of_map(certificate, tests::made_build(), tests::made_map_identity(height::Mode::conservative)),
               "covers hill.toml with other parameters: expected rendering height-map-conservative, stiffness 0.5 N/mm; got "
               "rendering height-map, stiffness 0.5 N/mm");
  expect_words(of_map(certificate, tests::made_build(), tests::made_map_identity(height::Mode::true_height, 0.6F)),
               "stiffness 0.6 N/mm; got rendering height-map, stiffness 0.5 N/mm");
  // The one of two that has this shape says what differs.
  Certificate two = certificate;
  two.subjects[2] = tests::made_map(height::Mode::conservative, 0.75F);
  SubjectResult another = tests::made_map();
  another.identity.digest = std::string(64, 'd');
  two.subjects.push_back(another);
  expect_words(of_map(two), "got rendering height-map-conservative, stiffness 0.75 N/mm");
  Certificate laws = certificate;
  laws.subjects.pop_back();
  expect_words(of_map(laws), "does not cover the height map hill.toml");
}

// Its file may have been renamed since.
TEST(refusal, does_not_look_at_the_name_of_a_height_map_s_file) {
  Identity renamed = tests::made_map_identity();
  renamed.name = "mound.toml";
  EXPECT_EQ(of_map(tests::made_certificate(), tests::made_build(), renamed), "allowed");
}

// A subject of a kind that this program has no special rule for: what it is called, what it is made of, and its parameters.
TEST(refusal, compares_subjects_of_any_kind) {
  const Identity springs{"pair of springs", "soft", {{"stiffness_N_per_mm", 0.5F}, {"order", std::string("first")}}, ""};
  Certificate certificate = tests::made_certificate();
  certificate.subjects.push_back(tests::made_subject(springs));
  certificate.subjects.back().rendered_by = RenderedBy::program;
  EXPECT_EQ(of_map(certificate, tests::made_build(), springs), "allowed");
  Identity other = springs;
  other.name = "hard";
  expect_words(of_map(certificate, tests::made_build(), other), "does not cover the pair of springs hard");
  other = springs;
  other.parameters[1].second = std::string("second");
  expect_words(of_map(certificate, tests::made_build(), other), "expected stiffness 0.5 N/mm, order second; got stiffness");
  other.parameters.pop_back();
  expect_words(of_map(certificate, tests::made_build(), other), "soft with other parameters");
  other = springs;
  std::swap(other.parameters[0], other.parameters[1]);
  EXPECT_EQ(of_map(certificate, tests::made_build(), other), "allowed") << "their order says nothing";
}

}  // namespace
}  // namespace forceshade::properties
