// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certificate.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <set>
#include <span>
#include <stdexcept>

#include "certificate/build.h"
#include "forceshade/certify.h"
#include "properties/field_properties.h"
#include "properties/height_map_subject.h"
#include "properties/law_subject.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

std::vector<std::shared_ptr<const Subject>> laws(const std::vector<LawId>& ids, const Parameters& parameters) {
  std::vector<std::shared_ptr<const Subject>> subjects;
  for (const LawId id : ids) subjects.push_back(std::make_shared<LawSubject>(id, parameters));
  return subjects;
}

// The certificate of two laws, and of a map with a cone and a plane.
Certificate small_certificate(unsigned threads = 2) {
  static const std::atomic<bool> never{false};
  const HeightMap cone{{{height::Cone{0.5F, -0.25F, 2.5F, 4}}, {height::Plane{0.1F, 0, 0}, true}}};
  CertifyOptions options{laws({LawId::wall, LawId::bump_2p}, kBump), 20000, 200, 3, threads};
  options.subjects.push_back(std::make_shared<HeightMapSubject>("cone.toml", cone, height::Mode::true_height, 0.5F));
  return certify(
             options, [](std::string_view, double) {}, never)
      .value();
}

TEST(certificate, counts_every_point_once_in_each_breakdown) {
  const Certificate certificate = small_certificate();
  EXPECT_TRUE(certificate.held());
  ASSERT_EQ(certificate.subjects.size(), 3U);
  for (const SubjectResult& law : std::span(certificate.subjects).first(2)) {
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
    EXPECT_EQ(law.spread.points, 5000U);
    EXPECT_EQ(law.spread.parameter_sets, 5U);
    EXPECT_EQ(law.spread.mismatches, 0U);
  }
  EXPECT_FALSE(certificate.processor.empty());
  EXPECT_EQ(certificate.date.size(), 20U) << certificate.date;
}

TEST(certificate, says_what_kind_of_force_each_law_is) {
  const Certificate certificate = small_certificate();
  const SubjectResult &wall = certificate.subjects[0], &bump = certificate.subjects[1];
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

// The witness gives less than the bound, where no loop is known that gives as much.
TEST(certificate, says_what_the_witness_gives_and_not_what_is_possible) {
  const LawSubject subject(LawId::bump_3p_shaded, kBump);
  const auto law = std::get<reference::Law>(reference::Law::build(LawId::bump_3p_shaded, kBump));
  const std::vector<LoopEnergy> energies = subject.energies(Monitor());
  ASSERT_EQ(energies.size(), witness_depths(law).size());
  for (const LoopEnergy& loop : energies) {
    const WitnessLoop witness = witness_loop(law, static_cast<float>(loop.depth_mm));
    EXPECT_EQ(loop.bound_mJ, witness.bound_mJ);
    EXPECT_EQ(loop.witness_mJ, witness.given_mJ);
    EXPECT_LT(loop.witness_mJ, loop.bound_mJ[0]);
    EXPECT_NE(loop.measured_mJ, loop.witness_mJ) << "it is of rounded forces";
  }
}

// The renderer's energy is measured: one that is twice as stiff gives twice the energy around the same loops.
TEST(certificate, says_what_the_renderer_gave_around_the_witness_and_not_what_the_law_gives) {
  const LawSubject right(LawId::bump_2p, kBump), stiffer(LawId::bump_2p, kBump, [](LawId law, Parameters parameters) {
    parameters.stiffness *= 2;
    return fast_law(law, parameters);
  });
  const std::vector<LoopEnergy> of_right = right.energies(Monitor()), of_stiffer = stiffer.energies(Monitor());
  ASSERT_EQ(of_right.size(), of_stiffer.size());
  for (std::size_t i = 0; i < of_right.size(); ++i) {
    EXPECT_EQ(of_stiffer[i].witness_mJ, of_right[i].witness_mJ);
    EXPECT_EQ(of_stiffer[i].measured_mJ, 2 * of_right[i].measured_mJ);
    EXPECT_GT(of_right[i].measured_mJ, 0);
  }
}

TEST(certificate, is_not_made_while_rounding_is_not_to_nearest) {
  const CertifyOptions options{laws({LawId::wall}, kBump), 20000, 200, 3, 1};
  const std::atomic<bool> never{false};
  std::fesetround(FE_UPWARD);
  EXPECT_THROW(certify(
                   options, [](std::string_view, double) {}, never),
               std::runtime_error);
  std::fesetround(FE_TONEAREST);
}

TEST(certificate, does_not_depend_on_the_number_of_threads_and_reads_back_what_it_wrote) {
  Certificate one = small_certificate(1), four = small_certificate(4);
  one.seconds = four.seconds = 0;
  one.date = four.date;
  const std::string text = to_json(one);
  EXPECT_EQ(text, to_json(four));
  EXPECT_EQ(to_json(from_json(text, "here.json")), text);
}

TEST(certificate, is_not_made_when_stopped) {
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(certify(
      {laws({LawId::wall}, kBump), 20000, 200, 3, 2}, [](std::string_view, double) {}, stop));
}

// A check as long as the default, with a seed that is not: what it reaches is enough for driving.
TEST(certificate, is_enough_for_driving_when_made_by_default) {
  static const std::atomic<bool> never{false};
  const Parameters odd{15.24F, 25.4F, 0.7F};
  const Certificate certificate =
      certify(
          {.subjects = laws({LawId::wall, LawId::bump_1p_shaded}, odd), .seed = 20261122, .threads = 2},
          [](std::string_view, double) {}, never)
          .value();
  for (const SubjectResult& law : certificate.subjects)
    EXPECT_EQ(refusal(certificate, current_build(), law.identity), std::nullopt) << law.name();
  EXPECT_FALSE(Certificate{}.held()) << "a certificate of nothing certifies nothing";
}

}  // namespace
}  // namespace forceshade::properties
