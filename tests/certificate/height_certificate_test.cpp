// SPDX-License-Identifier: BSD-3-Clause
// Every example is certified, and a certificate lets pass what it is about and nothing else.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "certificate/build.h"
#include "forceshade/certify.h"
#include "forceshade/heights.h"
#include "properties/height_map_subject.h"
#include "properties/rendered.h"
#include "reference/enclosure.h"
#include "report/report.h"
#include "tests/properties/subject_wrapper.h"

namespace forceshade::properties {
namespace {

using height::Mode;
using tests::SubjectWrapper;

struct Named {
  std::string name;
  HeightMap map;
  Mode mode;
};

std::shared_ptr<const Subject> subject_of(const Named& named) {
  return std::make_shared<HeightMapSubject>(named.name, named.map, named.mode, 0.5F);
}

Certificate certificate_of(const std::vector<Named>& maps, std::uint64_t points = 4000, unsigned threads = 2) {
  static const std::atomic<bool> never{false};
  CertifyOptions options{{}, points, 200, 3, threads};
  for (const Named& named : maps) options.subjects.push_back(subject_of(named));
  return certify(
             options, [](std::string_view, double) {}, never)
      .value();
}

Named cone() {
  return {"cone.toml", {{{height::Cone{0.5F, -0.25F, 2.5F, 4}}, {height::Plane{0.1F, 0, 0}, true}}}, Mode::true_height};
}

TEST(height_certificate, covers_every_example) {
  std::vector<Named> maps;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".toml") continue;
    heights::Spec spec = heights::read_spec(entry.path());
    maps.push_back({entry.path().filename(), std::move(spec.map), spec.mode});
  }
  const std::size_t examples = maps.size();
  EXPECT_GE(examples, 4U);
  const Certificate certificate = certificate_of(maps, 8000);
  EXPECT_TRUE(certificate.held());
  ASSERT_EQ(certificate.subjects.size(), examples);
  for (const SubjectResult& map : certificate.subjects) {
    EXPECT_TRUE(map.held()) << map.name() << (map.counterexamples.empty() ? "" : map.counterexamples.front());
    for (const auto& counts : {map.points_by_aim, map.points_by_stage, map.points_by_method, map.points_by_status}) {
      std::uint64_t sum = 0;
      for (const auto& [name, count] : counts) sum += count;
      EXPECT_EQ(sum, 8000U) << map.name();
    }
    for (const auto& [aim, count] : map.points_by_aim) EXPECT_GT(count, 100U) << map.name() << ": " << aim;
    for (const auto& [status, count] : map.points_by_status) EXPECT_GT(count, 500U) << map.name() << ": " << status;
    std::printf("  %-15s closest call %.2g ulp\n", map.name().c_str(), map.closest_call.ulps_from_tie);
    EXPECT_LT(map.closest_call.ulps_from_tie, 1e-3) << "ties are aimed at";
  }
}

TEST(height_certificate, says_what_kind_of_force_each_map_is) {
  const HeightMap dent{{{height::SphereCap{0, 0, 5, 8}, true}}}, hill{{{height::Gaussian{0, 0, 3, 5}}}};
  const Certificate certificate = certificate_of({{"dent", dent, Mode::conservative}, {"hill", hill, Mode::force_shaded}});
  const SubjectResult &first = certificate.subjects[0], &second = certificate.subjects[1];
  EXPECT_EQ(first.jumps, std::vector<std::string>{"part 1, sphere-cap: its rim"});
  EXPECT_TRUE(first.conservative);
  EXPECT_FALSE(first.unit_directions) << "its normal is as long as the map is steep";
  EXPECT_TRUE(second.jumps.empty());
  EXPECT_FALSE(second.conservative);
  EXPECT_TRUE(second.unit_directions);
  ASSERT_EQ(first.energy.size(), 2U);
  for (const LoopEnergy& loop : first.energy) EXPECT_EQ(loop.bound_mJ[1], 0);
  ASSERT_EQ(second.energy.size(), 2U);
  for (const LoopEnergy& loop : second.energy) {
    EXPECT_GE(loop.witness_mJ, 0.99 * loop.bound_mJ[1]);
    EXPECT_LE(loop.witness_mJ, loop.bound_mJ[1]);
    EXPECT_NEAR(loop.measured_mJ, loop.witness_mJ, 1e-4 * loop.bound_mJ[1]);
  }
}

// A map whose loops no interval encloses, or whose renderer throws along one.
class WithoutEnergy final : public SubjectWrapper {
 public:
  WithoutEnergy(std::shared_ptr<const Subject> its, bool throws) : SubjectWrapper(std::move(its)), throws_(throws) {}
  std::vector<LoopEnergy> energies(const Monitor&) const override {
    if (throws_) throw RendererThrew(Eigen::Vector3f(1, 2, 3), "no such place");
    throw reference::NotEnclosed("too steep");
  }

 private:
  bool throws_;
};

TEST(height_certificate, fails_in_words_where_the_energy_of_a_loop_is_not_known) {
  const std::atomic<bool> never{false};
  for (const auto& [throws, words] :
       {std::pair{false, std::string("the energy that a loop can give is not enclosed: too steep")},
        {true, RendererThrew(Eigen::Vector3f(1, 2, 3), "no such place").what()}}) {
    const auto certificate = certify(
        {{std::make_shared<WithoutEnergy>(subject_of(cone()), throws)}, 4000, 200, 3, 2}, [](std::string_view, double) {},
        never);
    ASSERT_TRUE(certificate);
    const SubjectResult& map = certificate->subjects.at(0);
    EXPECT_FALSE(map.held());
    EXPECT_TRUE(map.energy.empty());
    for (const PropertyResult& property : map.properties) {
      EXPECT_EQ(property.held, property.name != "passivity") << property.name;
      if (!property.held) {
        EXPECT_EQ(property.counterexample, words);
      }
    }
  }
}

TEST(height_certificate, is_none_if_stopped_while_the_energy_of_loops_is_computed) {
  std::atomic<bool> stop{false};
  double last = 0;
  const CertifyOptions options{{subject_of(cone())}, 4000, 20, 3, 1};
  const auto monitor = [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    last = done;
    if (done > 0.93) stop = true;
  };
  EXPECT_FALSE(certify(options, monitor, stop));
  EXPECT_GT(last, 0.93);
}

TEST(height_certificate, covers_the_map_that_was_checked) {
  const Certificate certificate = certificate_of({cone()});
  EXPECT_EQ(refusal(certificate, current_build(), identity_of("cone.toml", cone().map, Mode::true_height, 0.5F)),
            "the certificate has 4000 points for cone.toml; driving needs at least 200000");
  EXPECT_NE(refusal(certificate, current_build(), identity_of("cone.toml", cone().map, Mode::force_shaded, 0.5F))
                .value_or("")
                .find("with other parameters"),
            std::string::npos);
  EXPECT_EQ(certificate.subjects[0].spread.points, 1000U);
  EXPECT_EQ(certificate.subjects[0].spread.parameter_sets, 8U);
}

// The digest is of each number of a map, each kind, each sign and the order of the parts; not where it was read from.
TEST(height_certificate, is_bound_to_every_number_of_a_map) {
  height::Grid grid{3, 2, 0.5F, height::Edge::tile, height::Interpolant::cubic_spline, {1, 2, 3, 4, 5, 6}};
  std::set<std::string> digests;
  int maps = 0;
  const auto add = [&](std::vector<height::Part> parts, std::vector<height::Part> surface = {}) {
    ++maps;
    digests.insert(identity_of("", {std::move(parts), std::move(surface)}, Mode::force_shaded, 1).digest);
  };
  const auto add_grid = [&](const auto& change) {
    height::Grid changed = grid;
    change(changed);
    add({{std::make_shared<const height::Grid>(changed)}});
  };
  add_grid([](auto&) {});
  add_grid([](auto& g) { g.values[5] = 6.000001F; });
  add_grid([](auto& g) { g.pitch = 0.6F; });
  add_grid([](auto& g) { g.edge = height::Edge::clamp; });
  add_grid([](auto& g) { g.interpolant = height::Interpolant::bilinear; });
  add_grid([](auto& g) { std::swap(g.columns, g.rows); });
  for (const bool negated : {false, true}) {
    add({{height::Cone{0, 0, 1, 2}, negated}});
    add({{height::Cone{0, 1, 1, 2}, negated}});
    add({{height::SphereCap{0, 0, 1, 2}, negated}});
    add({{height::Gaussian{0, 0, 1, 2}, negated}});
    add({{height::Grating{0, 0, 1, 2}, negated}});
  }
  add({{height::Plane{}}, {height::Cone{0, 0, 1, 2}}});
  add({{height::Cone{0, 0, 1, 2}}, {height::Plane{}}});
  add({{height::Plane{}}}, {{height::Cone{0, 0, 1, 2}}});
  add({{height::Polygons{{{0, 1}, {2, 3}}}}});
  add({{height::Polygons{{{0, 1}, {2, 3}, {3, 0}}}}});
  EXPECT_EQ(digests.size(), static_cast<std::size_t>(maps));
  const auto again = [&] { return identity_of("", {{{std::make_shared<const height::Grid>(grid)}}}, Mode::true_height, 1); };
  EXPECT_TRUE(again().is_same(again()));
  EXPECT_TRUE(digests.contains(again().digest)) << "how it is rendered is no part of the map";
}

TEST(height_certificate, has_a_page_that_shows_the_map) {
  const std::string page = to_html(certificate_of({cone()}));
  for (const char* words :
       {"points per height map", "cone: x_mm 0.5, y_mm -0.25, height_mm 2.5, radius_mm 4",
        "plane: slope_x 0.1, slope_y 0, height_mm 0, negated true", "part 1, cone: its apex", "cone.toml", "height-map<br>"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace forceshade::properties
