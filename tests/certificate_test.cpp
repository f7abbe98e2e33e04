// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/certificate.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <set>
#include <stdexcept>

#include "forceshade/properties/build.h"
#include "forceshade/properties/certify.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

Certificate small_certificate(unsigned threads = 2) {
  static const std::atomic<bool> never{false};
  return certify(
             {{LawId::wall, LawId::bump_2p}, kBump, 20000, 200, 3, threads}, [](std::string_view, double) {}, never)
      .value();
}

TEST(certificate, counts_every_point_once_in_each_breakdown) {
  const Certificate certificate = small_certificate();
  EXPECT_TRUE(certificate.held());
  ASSERT_EQ(certificate.laws.size(), 2U);
  for (const LawResult& law : certificate.laws) {
    EXPECT_EQ(law.points, 20000U);
    for (const auto& counts : {law.points_by_aim, law.points_by_stage, law.points_by_method, law.points_by_status}) {
      std::uint64_t sum = 0;
      for (const auto& [name, count] : counts) sum += count;
      EXPECT_EQ(sum, law.points);
    }
    const std::uint64_t aimed = law.points - law.points_by_aim.at("volume") - law.points_by_aim.at("any bits");
    EXPECT_NEAR(static_cast<double>(aimed), 10000, 500) << "half of the points are aimed";
    std::set<std::string> names;
    for (const PropertyResult& property : law.properties) names.insert(property.name);
    EXPECT_EQ(names, (std::set<std::string>{"equivalence", "continuity", "unit normals", "passivity"}));
    EXPECT_EQ(law.energy.size(), 5U);
  }
}

TEST(certificate, says_what_kind_of_force_each_law_is) {
  const Certificate certificate = small_certificate();
  const LawResult &wall = certificate.laws[0], &bump = certificate.laws[1];
  EXPECT_TRUE(wall.conservative);
  EXPECT_TRUE(wall.jumps.empty());
  EXPECT_FALSE(bump.conservative);
  EXPECT_EQ(bump.jumps, (std::vector<std::string>{"x = 0", "|x| = w/2"}));
  for (const LoopEnergy& loop : wall.energy) EXPECT_EQ(loop.bound_mJ[1], 0);
  for (const LoopEnergy& loop : bump.energy) {
    EXPECT_LT(loop.bound_mJ[0], loop.bound_mJ[1]) << "an interval around an irrational number";
    EXPECT_LE(loop.witness_mJ, loop.bound_mJ[1]);
    EXPECT_GE(loop.witness_mJ, 0.99 * loop.bound_mJ[1]);
    // The loop crosses the line within one binary32 step, 2⁻²⁰ mm, and either side's force of K·D at most may be felt there.
    EXPECT_NEAR(loop.measured_mJ, loop.witness_mJ, 0x1p-20 * loop.depth_mm);
  }
}

TEST(certificate, is_not_made_while_rounding_is_not_to_nearest) {
  std::fesetround(FE_UPWARD);
  EXPECT_THROW(small_certificate(), std::runtime_error);
  std::fesetround(FE_TONEAREST);
}

TEST(certificate, does_not_depend_on_the_number_of_threads) {
  Certificate one = small_certificate(1), four = small_certificate(4);
  one.seconds = four.seconds = 0;
  EXPECT_EQ(to_json(one), to_json(four));
}

TEST(certificate, reads_back_what_it_wrote) {
  const Certificate certificate = small_certificate();
  const std::string text = to_json(certificate);
  EXPECT_EQ(to_json(from_json(text, "here.json")), text);
}

TEST(certificate, is_not_made_when_stopped) {
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(certify(
      {{LawId::wall}, kBump, 20000, 200, 3, 2}, [](std::string_view, double) {}, stop));
}

TEST(certificate, allows_what_it_covers_and_says_why_not) {
  const Certificate certificate = small_certificate();
  const Build build = current_build();
  EXPECT_EQ(refusal(certificate, build, LawId::bump_2p, kBump), std::nullopt);
  EXPECT_EQ(refusal(certificate, build, LawId::wall, {1, 1, 0.5F}), std::nullopt) << "the wall has no radius";
  const auto expect = [&](const Certificate& c, const Build& b, LawId law, const Parameters& p, const char* words) {
    const auto reason = refusal(c, b, law, p);
    ASSERT_TRUE(reason) << words;
    EXPECT_NE(reason->find(words), std::string::npos) << *reason;
  };
  expect(certificate, build, LawId::bump_3p, kBump, "does not cover the law bump-3p");
  expect(certificate, build, LawId::bump_2p, {15.24F, 25.4F, 0.6F}, "with other parameters");
  expect(certificate, build, LawId::bump_2p, {15.240001F, 25.4F, 0.5F}, "with other parameters");
  expect(certificate, build, LawId::wall, {1, 1, 0.6F}, "with other parameters");
  Build other = build;
  other.library_digest = "0";
  expect(certificate, other, LawId::bump_2p, kBump, "another build");
  Certificate failed = certificate;
  failed.laws[1].mismatches = 1;
  expect(failed, build, LawId::bump_2p, kBump, "failed");
  failed = certificate;
  failed.laws[1].properties[2].held = false;
  expect(failed, build, LawId::bump_2p, kBump, "failed");
  failed = certificate;
  failed.laws[1].points = 0;
  expect(failed, build, LawId::bump_2p, kBump, "failed");
  EXPECT_FALSE(Certificate{}.held()) << "a certificate of nothing certifies nothing";
}

TEST(certificate, names_the_file_and_what_is_wrong_with_it) {
  const auto message = [](const std::string& text) {
    try {
      from_json(text, "here.json");
    } catch (const CertificateError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(message("").find("here.json: expected a forceshade certificate"), std::string::npos);
  EXPECT_NE(message("{}").find("schema"), std::string::npos);
  EXPECT_NE(message(R"({"schema": 3})").find("schema is 3; expected 4: certify again"), std::string::npos);
  std::string text = to_json(small_certificate());
  text.replace(text.find("\"bump-2p\""), 9, "\"bump-9p\"");
  EXPECT_NE(message(text).find("unknown law \"bump-9p\""), std::string::npos);
}

}  // namespace
}  // namespace forceshade::properties
