// SPDX-License-Identifier: BSD-3-Clause
// Certificates of points of different seeds or subjects are added up, and nothing that one of them found is lost.

#include <gtest/gtest.h>

#include <functional>

#include "forceshade/certify.h"
#include "tests/certificate/made_certificate.h"
#include "tests/support/words.h"

namespace forceshade::properties {
namespace {

using Seeds = std::vector<std::uint64_t>;

// A certificate of one law, with so many points.
CertificateFile file_of(const std::string& name, std::uint64_t seed, std::uint64_t points = 1000000) {
  CertificateFile file{name, {tests::made_build(), 2, {tests::made_law()}, {}, "2026-01-31T23:59:59Z", "a processor"}};
  static_cast<Findings&>(file.certificate.subjects[0]) = tests::made_findings(points);
  file.certificate.subjects[0].seeds = {seed};
  return file;
}

std::string answer_to_merging(const std::vector<CertificateFile>& files) {
  return tests::thrown_by<Error>([&] { merged(files); });
}

TEST(merge_points, adds_up_every_count_of_a_subject) {
  const CertificateFile a = file_of("a.json", 1), b = file_of("b.json", 2, 400000);
  const Certificate sum = merged({a, b});
  ASSERT_EQ(sum.subjects.size(), 1U);
  const SubjectResult &all = sum.subjects[0], &x = a.certificate.subjects[0], &y = b.certificate.subjects[0];
  EXPECT_EQ(all.seeds, (Seeds{1, 2}));
  const auto expect_sum = [](const Comparison& whole, const Comparison& one, const Comparison& other) {
    EXPECT_EQ(whole.points, one.points + other.points);
    for (const auto& counts : {&Comparison::points_by_instruction_set, &Comparison::points_by_aim, &Comparison::points_by_stage,
                               &Comparison::points_by_method, &Comparison::points_by_status}) {
      EXPECT_EQ((whole.*counts).size(), (one.*counts).size());
      for (const auto& [name, count] : whole.*counts)
        EXPECT_EQ(count, (one.*counts).at(name) + (other.*counts).at(name)) << name;
    }
  };
  expect_sum(all, x, y);
  expect_sum(all.spread, x.spread, y.spread);
  EXPECT_EQ(all.spread.parameter_sets, 14U);
  for (std::size_t i = 0; i < all.properties.size(); ++i)
    EXPECT_EQ(all.properties[i].cases, x.properties[i].cases + y.properties[i].cases);
  EXPECT_EQ(sum.seconds, 4);
  EXPECT_EQ(to_json(from_json(to_json(sum), "sum.json")), to_json(sum)) << "and is a certificate";
}

TEST(merge_points, makes_enough_of_two_that_are_too_little_for_drive) {
  const CertificateFile a = file_of("a.json", 1, 600000), b = file_of("b.json", 2, 600000);
  const Identity& law = a.certificate.subjects[0].identity;
  for (const CertificateFile& file : {a, b}) EXPECT_NE(refusal(file.certificate, tests::made_build(), law), std::nullopt);
  EXPECT_EQ(refusal(merged({a, b}), tests::made_build(), law), std::nullopt);
}

TEST(merge_points, keeps_subjects_apart_and_in_their_order) {
  CertificateFile a = file_of("a.json", 1), b = file_of("b.json", 1);
  b.certificate.subjects = {tests::made_law(LawId::wall), tests::made_law(LawId::bump_2p, {15.24F, 25.4F, 1})};
  const Certificate sum = merged({a, b});
  ASSERT_EQ(sum.subjects.size(), 3U);
  EXPECT_EQ(sum.subjects[0].name(), "bump-2p");
  EXPECT_EQ(sum.subjects[1].name(), "wall");
  EXPECT_EQ(sum.subjects[2].points, 1000000U) << "other parameters are another subject";
}

// Points of one renderer are no evidence of another's.
TEST(merge_points, adds_no_points_of_a_program_s_renderer_to_the_library_s) {
  const CertificateFile library = file_of("a.json", 1, 600000);
  for (const RenderedBy who : {RenderedBy::program, RenderedBy::unknown}) {
    CertificateFile other = file_of("b.json", 2, 600000);
    other.certificate.subjects[0].rendered_by = who;
    for (const auto& files : {std::vector{library, other}, std::vector{other, library}}) {
      const Certificate sum = merged(files);
      ASSERT_EQ(sum.subjects.size(), 2U);
      for (const SubjectResult& entry : sum.subjects) EXPECT_EQ(entry.points, 600000U);
      EXPECT_NE(refusal(sum, tests::made_build(), sum.subjects[0].identity), std::nullopt);
    }
  }
}

// Only one of them may have been made with --subject, whose file says how to make the subject again.
TEST(merge_points, keeps_the_subject_file_of_whichever_has_one) {
  const CertificateFile bare = file_of("a.json", 1);
  CertificateFile named = file_of("b.json", 2);
  named.certificate.subjects[0].subject_file = "law = \"bump-2p\"\n";
  for (const auto& files : {std::vector{bare, named}, std::vector{named, bare}})
    EXPECT_EQ(merged(files).subjects[0].subject_file, "law = \"bump-2p\"\n");
}

// A change of one of two files, wherever it stands, is found in the sum.
TEST(merge_points, loses_nothing_that_failed_in_any_of_the_files) {
  const std::vector<std::function<void(SubjectResult&)>> faults{
      [](SubjectResult& s) { s.mismatches = 1, s.counterexamples = {"at 1"}; },
      [](SubjectResult& s) { s.spread.mismatches = 1, s.spread.counterexamples = {"at 1"}; },
      [](SubjectResult& s) {
        s.properties[0] = {"equivalence", 9, false, "at 1"};
      },
      [](SubjectResult& s) {
        s.properties[3] = {"passivity", 9, false, "at 1"};
      }};
  for (const auto& fault : faults)
    for (std::size_t wrong = 0; wrong < 3; ++wrong) {
      std::vector<CertificateFile> files{file_of("a.json", 1), file_of("b.json", 2), file_of("c.json", 3)};
      fault(files[wrong].certificate.subjects[0]);
      const Certificate sum = merged(files);
      EXPECT_FALSE(sum.held()) << wrong;
      EXPECT_NE(to_json(sum).find("at 1"), std::string::npos) << "the counterexample";
      EXPECT_NE(refusal(sum, tests::made_build(), sum.subjects[0].identity), std::nullopt);
      EXPECT_NO_THROW(from_json(to_json(sum), "sum.json"));
    }
}

TEST(merge_points, keeps_the_first_counterexamples_the_closest_call_and_the_sets_that_all_compared) {
  CertificateFile a = file_of("a.json", 1), b = file_of("b.json", 2);
  SubjectResult &x = a.certificate.subjects[0], &y = b.certificate.subjects[0];
  x.mismatches = y.mismatches = 7;
  for (int i = 0; i < 7; ++i) {
    x.counterexamples.push_back("a" + std::to_string(i));
    y.counterexamples.push_back("b" + std::to_string(i));
  }
  y.closest_call = {2.5F, 0, -0.5F, 1e-9};
  x.points_by_instruction_set["avx512"] = x.points;
  const SubjectResult sum = merged({a, b}).subjects[0];
  EXPECT_EQ(sum.mismatches, 14U);
  EXPECT_EQ(sum.counterexamples.size(), kCounterexamples);
  EXPECT_EQ(sum.counterexamples[6], "a6");
  EXPECT_EQ(sum.counterexamples[7], "b0");
  EXPECT_EQ(sum.closest_call.ulps_from_tie, 1e-9);
  EXPECT_FALSE(sum.points_by_instruction_set.contains("avx512"));
  EXPECT_TRUE(sum.covers("avx2"));
}

TEST(merge_points, refuses_the_same_points_twice_and_what_contradicts) {
  const auto expect = [](const CertificateFile& other, const std::string& words) {
    EXPECT_EQ(answer_to_merging({file_of("a.json", 1), other}), "b.json: " + words + "; a.json has it");
  };
  expect(file_of("b.json", 1), "bump-2p: expected another seed than 1, which gives the same points again");
  CertificateFile b = file_of("b.json", 2);
  b.certificate.subjects[0].jumps.clear();
  expect(b, "bump-2p: expected the same parts and jumps");
  using Change = void (*)(std::vector<LoopEnergy>&);
  for (const Change change :
       {Change([](auto& its) { its[0].depth_mm += 1; }), Change([](auto& its) { its[0].bound_mJ[0] -= 1; }),
        Change([](auto& its) { its[0].bound_mJ[1] += 1; }), Change([](auto& its) { its[0].witness_mJ -= 0.125; }),
        Change([](auto& its) { its[0].measured_mJ = 0.3; }), Change([](auto& its) { its.pop_back(); })}) {
    b = file_of("b.json", 2);
    change(b.certificate.subjects[0].energy);
    expect(b, "bump-2p: expected the same energies per loop");
  }
  b = file_of("b.json", 2);
  b.certificate.build.flags = "-O1";
  EXPECT_NE(answer_to_merging({file_of("a.json", 1), b}).find("b.json: expected the build of a.json"), std::string::npos);
  EXPECT_EQ(answer_to_merging({file_of("a.json", 1)}), "a.json: expected another certificate to join it to");
}

TEST(merge_points, joins_a_merged_certificate_to_another) {
  const Certificate two = merged({file_of("a.json", 1), file_of("b.json", 3)});
  const Certificate three = merged({{"two.json", two}, file_of("c.json", 2)});
  EXPECT_EQ(three.subjects[0].seeds, (Seeds{1, 2, 3}));
  EXPECT_EQ(answer_to_merging({{"two.json", two}, file_of("c.json", 3)}),
            "c.json: bump-2p: expected another seed than 3, which gives the same points again; two.json has it");
}

}  // namespace
}  // namespace forceshade::properties
