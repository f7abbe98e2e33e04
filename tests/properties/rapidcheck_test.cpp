// SPDX-License-Identifier: BSD-3-Clause
// RapidCheck runs the same properties on cases of its own, and finds as simple a counterexample.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "properties/field_properties.h"
#include "properties/height_map_subject.h"
#include "properties/law_subject.h"
#include "properties/mesh_source.h"
#include "properties/mesh_subject.h"
#include "rendering/breakdown.h"
#include "tests/meshes/rendering.h"
#include "tests/support/with_rapidcheck.h"

namespace forceshade::properties {
namespace {

constexpr int kCases = 200;
constexpr std::uint64_t kSeed = 4;

// The path of equivalence, as run_properties() goes it.
Violation equivalence_along(const Subject& subject, const std::vector<Eigen::Vector3f>& path) {
  const auto session = subject.renderer().open();
  const auto reference = subject.open_reference();
  for (const Eigen::Vector3f& position : path) {
    const fast::Evaluation answer = session->step(position);
    if (auto violation = difference(position, {answer.force, answer.status}, reference->step(position))) return violation;
  }
  return std::nullopt;
}

std::vector<PropertyResult> results_of(const Subject& subject) {
  std::vector<FurtherProperty> all{
      {"equivalence", [&](Chooser& choose) { return equivalence_along(subject, subject.draw_path(choose)); }},
      {"continuity", [&](Chooser& choose) { return subject.check_continuity(choose); }},
      {"unit normals", [&](Chooser& choose) { return subject.check_unit_normals(choose); }},
      {"passivity", [&](Chooser& choose) { return subject.check_passivity(choose); }}};
  for (const FurtherProperty& further : subject.further_properties()) all.push_back(further);
  std::vector<PropertyResult> results;
  for (const FurtherProperty& one : all) {
    const auto cases = static_cast<int>(cases_of(one.name, kCases));
    results.push_back(tests::run_with_rapidcheck(one.name, cases, kSeed, one.check));
  }
  return results;
}

void expect_all(const Subject& subject, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (const PropertyResult& result : results_of(subject)) {
    EXPECT_TRUE(result.held) << subject.identity().name << ", " << result.name << ": " << result.counterexample;
    EXPECT_EQ(result.cases, cases_of(result.name, kCases)) << result.name;
    found.push_back(result.name);
  }
  EXPECT_EQ(found, names);
}

TEST(rapidcheck, refutes_no_property_of_any_law) {
  for (const LawName& law : kLaws)
    expect_all(LawSubject(law.id, {15.24F, 25.4F, 0.5F}), {"equivalence", "continuity", "unit normals", "passivity"});
}

TEST(rapidcheck, refutes_no_property_of_a_height_map) {
  height::Grid grid{8, 6, 0.25F, height::Edge::tile, height::Interpolant::cubic_spline, {}};
  for (int i = 0; i < 48; ++i) grid.values.push_back(0.125F * static_cast<float>(5 * i * i % 7));
  const HeightMap map{{{height::SphereCap{0, 0, 5, 8}}, {std::make_shared<const height::Grid>(std::move(grid))}}};
  expect_all(HeightMapSubject("map.toml", map, height::Mode::true_height, 0.5F),
             {"equivalence", "continuity", "unit normals", "passivity", "cell lines"});
}

TEST(rapidcheck, refutes_no_property_of_a_mesh) {
  MeshSource source(11);
  RandomMesh random = source.of_family(7);
  const MeshRendering rendering{tests::checked(std::move(random.mesh)), {}, random.sides, mesh::Shading::none, 0.3F};
  expect_all(MeshSubject("star.off", rendering),
             {"equivalence", "continuity", "unit normals", "passivity", "states", "repeats"});
}

// A wall that pulls beyond 3 mm. The simplest case has no x and y, and one significant bit of z.
TEST(rapidcheck, and_the_library_find_cases_of_the_same_simplicity) {
  const LawSubject wall(LawId::wall, {.stiffness = 0.5F});
  const Property is_soft = [&](Chooser& choose) -> Violation {
    const Eigen::Vector3f first = wall.draw_path(choose).front();
    if (!(first.z() < -3 && first.z() >= -1e4F)) return std::nullopt;
    int exponent = 0;
    const float significant = std::frexp(first.z(), &exponent);
    return show(Eigen::Vector3f(first.x(), first.y(), significant));
  };
  const std::string simple = show(Eigen::Vector3f(0, 0, -0.5F));
  EXPECT_EQ(tests::run_with_rapidcheck("soft", kCases, kSeed, is_soft).counterexample, simple);
  EXPECT_EQ(run_property("soft", kCases, kSeed, is_soft).counterexample, simple);
}

}  // namespace
}  // namespace forceshade::properties
