// SPDX-License-Identifier: BSD-3-Clause
// The properties hold on height maps of every kind, and each of them can fail.

#include "properties/height_properties.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "forceshade/properties.h"
#include "properties/field_properties.h"
#include "properties/generators.h"
#include "properties/height_map_subject.h"
#include "properties/height_positions.h"
#include "tests/support/any_height_map.h"

namespace forceshade::properties {
namespace {

using height::Edge;
using height::Interpolant;
using Mode = height::Mode;

constexpr int kCases = 300;
constexpr std::uint64_t kSeed = 3;

std::shared_ptr<const height::Grid> texture(Interpolant interpolant, Edge edge = Edge::tile) {
  height::Grid grid{16, 12, 0.25F, edge, interpolant, {}};
  for (std::uint32_t j = 0; j < grid.rows; ++j)
    for (std::uint32_t i = 0; i < grid.columns; ++i)
      grid.values.push_back(0.125F * static_cast<float>((3 * i + 5 * j * j) % 7));
  return std::make_shared<const height::Grid>(std::move(grid));
}

struct Named {
  const char* name;
  HeightMap map;
};

std::vector<Named> maps() {
  return {{"plane", {{{height::Plane{0.75F, -0.25F, 1}}}}},
          {"cone", {{{height::Cone{0.5F, -0.25F, 2.5F, 4}}}}},
          {"dent", {{{height::SphereCap{1, -1, 5, 8}, true}}}},
          {"cylinder cap", {{{height::CylinderCap{1, 15.24F, 25.4F}}}}},
          {"polygons", {{{height::Polygons{{{-4, 0}, {0, 2}, {1, 2}, {4, 0}}}}}}},
          {"Gaussian", {{{height::Gaussian{1, -1, 3, 1.5F}}}}},
          {"grating", {{{height::Grating{0.5F, 3, 2, 0.25F}}}}},
          {"bilinear", {{{texture(Interpolant::bilinear)}}}},
          {"spline", {{{texture(Interpolant::cubic_spline)}}}},
          {"clamped spline", {{{texture(Interpolant::cubic_spline, Edge::clamp), true}}}},
          {"bump and texture", {{{height::SphereCap{0, 0, 5, 8}}, {texture(Interpolant::cubic_spline)}}}}};
}

RenderedHeightMap subject_of(const HeightMap& map, Mode mode) {
  return std::get<RenderedHeightMap>(fast_rendering(map, mode, 0.5F));
}

PropertyResult result_of(const RenderedHeightMap& subject, const std::string& property) {
  for (const PropertyResult& result : run_properties(HeightMapSubject(subject), kCases, kSeed))
    if (result.name == property) return result;
  throw std::invalid_argument(property);
}

TEST(height_properties, hold_on_maps_of_every_kind) {
  for (const auto& [name, map] : maps())
    for (const auto& [mode, word] : height::kModes) {
      const std::vector<PropertyResult> results = run_properties(HeightMapSubject(subject_of(map, mode)), kCases, kSeed);
      EXPECT_GE(results.size(), 4U);
      for (const PropertyResult& result : results)
        EXPECT_EQ(result.held, result.name != "cell lines" || std::string(name) != "bilinear")
            << name << ", " << word << ", " << result.name << ": " << result.counterexample;
    }
}

// The fast path of `map` with its answers changed by `change(right, position, answer)`, `right` being the fast path itself.
template <class Change>
RenderedHeightMap changed(const HeightMap& map, Mode mode, const Change& change) {
  RenderedHeightMap subject = subject_of(map, mode);
  subject.force_at = [right = subject.force_at, change](const Eigen::Vector3f& position) {
    return change(right, position, right(position));
  };
  return subject;
}

void expect_refused(const RenderedHeightMap& subject, const std::vector<std::string>& properties, const std::string& what) {
  for (const std::string& property : properties) EXPECT_FALSE(result_of(subject, property).held) << what << ": " << property;
}

TEST(height_properties, name_every_kink) {
  std::map<std::string, std::string> words;
  for (const auto& [name, map] : maps())
    for (const std::string& jump : HeightMapClaims(subject_of(map, Mode::true_height).law).jumps()) words[name] += jump + "; ";
  EXPECT_EQ(words["cone"], "part 1, cone: its apex; part 1, cone: its rim; ");
  EXPECT_EQ(words["dent"], "part 1, sphere-cap: its rim; ");
  EXPECT_EQ(words["polygons"], "part 1, polygons: its knots; ");
  EXPECT_EQ(words["bilinear"].find("part 1, bilinear grid: its cell lines, the gradient by up to"), 0U) << words["bilinear"];
  EXPECT_EQ(words["bump and texture"], "part 1, sphere-cap: its rim; ");
  for (const char* smooth : {"plane", "Gaussian", "grating", "spline"}) EXPECT_EQ(words[smooth], "");
}

TEST(height_properties, refuse_a_gradient_of_the_wrong_sign) {
  const auto mirrored = [](const ForceAt&, const Eigen::Vector3f&, Rendered answer) {
    answer.force.head<2>() *= -1;
    return answer;
  };
  for (const auto& [name, map] : maps())
    for (const auto& [mode, word] : height::kModes)
      expect_refused(changed(map, mode, mirrored), {"equivalence", "passivity"}, std::string(name) + ", " + std::string(word));
}

TEST(height_properties, refuse_x_and_y_exchanged) {
  const auto exchanged = [](const ForceAt&, const Eigen::Vector3f&, Rendered answer) {
    std::swap(answer.force.x(), answer.force.y());
    return answer;
  };
  for (const auto& [name, map] : maps())
    expect_refused(changed(map, Mode::conservative, exchanged), {"equivalence", "passivity"}, name);
}

TEST(height_properties, refuse_a_normal_that_was_not_normalised_and_one_that_was) {
  const auto with_length = [](double power) {
    return [power](const ForceAt&, const Eigen::Vector3f&, Rendered answer) {
      const Eigen::Vector3d force = answer.force.cast<double>();
      if (force.z() > 0) answer.force = (force * std::pow(force.norm() / force.z(), power)).cast<float>();
      return answer;
    };
  };
  for (const auto& [name, map] : maps()) {
    expect_refused(changed(map, Mode::true_height, with_length(1)), {"equivalence", "unit normals", "passivity"}, name);
    expect_refused(changed(map, Mode::force_shaded, with_length(1)), {"equivalence", "unit normals", "passivity"}, name);
    expect_refused(changed(map, Mode::conservative, with_length(-1)), {"equivalence", "unit normals"}, name);
  }
}

TEST(height_properties, refuse_a_force_from_the_wrong_cell) {
  const auto late = [](const ForceAt& right, const Eigen::Vector3f& position, const Rendered& answer) {
    const double place = static_cast<double>(position.x()) / 0.25 - 0.5, beyond = place - std::floor(place);
    return beyond < 1e-3 ? right(position - Eigen::Vector3f(0.25F, 0, 0)) : answer;
  };
  for (const Interpolant interpolant : {Interpolant::bilinear, Interpolant::cubic_spline})
    for (const auto& [mode, word] : height::kModes)
      expect_refused(changed({{{texture(interpolant)}}}, mode, late), {"equivalence", "continuity", "cell lines"},
                     std::string(word));
}

// Force shading gives energy away: small loops show it, if the bound of the quadrature is no wider than it must be.
TEST(height_properties, refuse_energy_from_a_map_that_should_have_a_potential) {
  for (const auto& [name, map] : maps()) {
    const RenderedHeightMap subject = subject_of(map, Mode::force_shaded);
    HeightMapClaims claims(subject.law);
    claims.is_conservative = true;
    const HeightTarget target{subject.law, claims};
    const auto gives_none = [&](Chooser& choose) { return passivity(subject, claims, choose(polygon_of(target))); };
    EXPECT_FALSE(run_property("passivity", kCases, kSeed, gives_none).held) << name;
  }
}

TEST(height_properties, hold_where_depth_is_measured_from_another_surface) {
  const HeightMap map{{{height::CylinderCap{0, 5, 8}}}, {{height::Polygons{{{-4, 0}, {0, 2}, {4, 0}}}}}};
  const RenderedHeightMap subject = subject_of(map, Mode::force_shaded);
  for (const PropertyResult& result : run_properties(HeightMapSubject(subject), kCases, kSeed))
    EXPECT_TRUE(result.held) << result.name << ": " << result.counterexample;
  EXPECT_EQ(HeightMapClaims(subject.law).jumps(), std::vector<std::string>{"part 1, cylinder-cap: its two edges"});
}

TEST(height_properties, find_where_the_gradient_of_a_bilinear_map_jumps_and_by_how_much) {
  const HeightMap roof{
      {{std::make_shared<const height::Grid>(height::Grid{3, 2, 2, Edge::clamp, Interpolant::bilinear, {0, 1, 0, 0, 1, 0}})}}};
  const RenderedHeightMap subject = subject_of(roof, Mode::true_height);
  const HeightMapClaims claims(subject.law);
  EXPECT_EQ(claims.jumps(),
            std::vector<std::string>{"part 1, bilinear grid: its cell lines, the gradient by up to 1 at (0, -1) mm"});
  const auto found = gradient_across_cells(subject, claims, {-0x1p-20F, 0.5F, -1}, {0x1p-20F, 0.5F, -1});
  ASSERT_TRUE(found);
  EXPECT_NE(found->find("across a cell line at x = -0x1p-20"), std::string::npos) << *found;
  EXPECT_NE(found->find("the gradient jumps by 1;"), std::string::npos) << *found;
  EXPECT_EQ(continuity(subject, claims, {-0x1p-20F, 0.5F, -1}, {0x1p-20F, 0.5F, -1}), std::nullopt) << "a known kink";
  const PropertyResult result = result_of(subject, "cell lines");
  EXPECT_FALSE(result.held);
  EXPECT_NE(result.counterexample.find("the gradient jumps by"), std::string::npos) << result.counterexample;
  std::printf("  %s\n", result.counterexample.c_str());
}

// Across a line of a flat spline, a Gaussian under it turns the gradient as much as it does elsewhere.
TEST(height_properties, allow_a_gradient_to_turn_with_every_part) {
  height::Grid flat{4, 4, 1, Edge::tile, Interpolant::cubic_spline, std::vector<float>(16, 0.0F)};
  const auto grid = std::make_shared<const height::Grid>(std::move(flat));
  const height::Gaussian hill{0, 0, 2, 0.5F};
  const Eigen::Vector3f a(-0x1p-8F, 0.25F, -1), b(0x1p-8F, 0.25F, -1);
  for (const HeightMap& map : {HeightMap{{{hill}, {grid}}}, HeightMap{{{grid}, {hill}}}}) {
    const RenderedHeightMap subject = subject_of(map, Mode::true_height);
    const auto found = gradient_across_cells(subject, HeightMapClaims(subject.law), a, b);
    EXPECT_EQ(found, std::nullopt);
  }
}

// Each property on a generated position, pair or path of a generated map.
// The ends of the domain are among the positions, in each coordinate.
TEST(height_properties, are_checked_at_the_ends_of_the_domain_in_each_coordinate) {
  const RenderedHeightMap subject = subject_of(maps().front().map, Mode::force_shaded);
  const HeightMapClaims claims(subject.law);
  HeightPositionSource source(subject.law, claims, kSeed);
  std::array<int, 3> at_an_end{};
  for (int i = 0; i < 20000; ++i) {
    const Aimed aimed = source.next();
    if (aimed.aim != Aim::domain_end) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      at_an_end[static_cast<std::size_t>(axis)] += std::fabs(aimed.position[axis]) > 0.999F * reference::kDomainEnd;
  }
  std::printf("  at an end in x, y and z: %d, %d and %d\n", at_an_end[0], at_an_end[1], at_an_end[2]);
  for (const int count : at_an_end) EXPECT_GT(count, 50);
}

TEST(height_properties, simpler_maps_have_fewer_parts_but_one) {
  std::map<std::size_t, int> counts;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const tests::AnyHeightMap any = tests::any_height_map().draw(seed);
    ++counts[any.map.parts.size()];
    const std::vector<tests::AnyHeightMap> simpler = tests::any_height_map().simpler(any);
    EXPECT_EQ(simpler.empty(), any.map.parts.size() == 1);
    for (const tests::AnyHeightMap& one : simpler) {
      EXPECT_GE(one.map.parts.size(), 1U);
      EXPECT_LT(one.map.parts.size(), any.map.parts.size());
    }
  }
  EXPECT_EQ(counts.size(), 3U);
}

TEST(height_properties, hold_on_generated_maps) {
  std::array<int, 3> statuses{};
  const PropertyResult result = run_property("any map", 500, kSeed, [&](Chooser& choose) -> Violation {
    const tests::AnyHeightMap any = choose(tests::any_height_map());
    const auto subject = std::get<RenderedHeightMap>(fast_rendering(any.map, any.mode, any.stiffness));
    const HeightMapClaims claims(subject.law);
    const HeightTarget target{subject.law, claims};
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3f position = choose(position_of(target));
      ++statuses[static_cast<std::size_t>(subject.force_at(position).status)];
      if (const Violation violation = equivalence(subject, position)) return violation;
      if (const Violation violation = unit_normals(subject, position)) return violation;
    }
    const Neighbours pair = choose(neighbours_on(target));
    if ((pair.b().array().abs() <= 1e4F).all())
      if (const Violation violation = continuity(subject, claims, pair.a, pair.b())) return violation;
    return passivity(subject, claims, choose(polygon_of(target)));
  });
  EXPECT_TRUE(result.held) << result.counterexample;
  std::printf("  %llu maps; free %d, contact %d, invalid %d\n", static_cast<unsigned long long>(result.cases), statuses[0],
              statuses[1], statuses[2]);
  for (const int count : statuses) EXPECT_GT(count, 100) << "a status was hardly ever reached";
}

// As far as the thesis's bump is wide, and no farther than 250 cells of the finest grid, which may be that of the surface.
TEST(certified_slice, goes_over_at_most_250_cells_of_every_grid) {
  const auto grid = [](float pitch) -> height::Part {
    return {std::make_shared<const height::Grid>(height::Grid{4, 4, pitch, {}, {}, std::vector<float>(16)})};
  };
  const height::Part level{height::Plane{}};
  const auto reach = [](const HeightMap& map) {
    const reference::Slice slice = certified_slice(map);
    EXPECT_EQ(slice.from, -slice.to);
    return slice.to;
  };
  EXPECT_EQ(reach({{level}, {level}}), 12.7F);
  EXPECT_EQ(reach({{grid(1)}}), 12.7F);
  EXPECT_EQ(reach({{level, grid(0.02F)}}), 250 * 0.02F);
  EXPECT_EQ(reach({{level}, {level, grid(0.01F)}}), 250 * 0.01F);
  EXPECT_EQ(reach({{grid(0.01F)}, {grid(0.03F)}}), 250 * 0.01F);
}

}  // namespace
}  // namespace forceshade::properties
