// SPDX-License-Identifier: BSD-3-Clause
// Defects of renderers where faces touch, coincide or share an edge in any number, each in this program's own: what finds it,
// and that nothing else does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "properties/conformance/conform.h"
#include "rendering/meshes/make.h"
#include "tests/conformance/own_renderer.h"

namespace forceshade::conformance {
namespace {

const std::string kMeet = "nothing passes where faces meet", kOne = "faces that coincide feel like one",
                  kWhole = "a split face feels like the whole",
                  kAsDefined = "where faces meet the force is that of the definition";

Description cube_scene() {
  return {"cube", MeshRendering{.checked = std::get<mesh::CheckedMesh>(mesh::check(mesh::cube(20))),
                                .sides = mesh::Sides::front,
                                .shading = mesh::Shading::none,
                                .stiffness = 0.5F}};
}

// Changes the forces in a scene, by what the renderer sees of the scene.
using Fault = std::function<Spoil(const mesh::TriangleMesh& mesh)>;

Conformance with_fault(const Fault& fault, const char* claims) {
  const auto spoiler = [=](Description& scene, Json& hello) {
    hello["claims"] = claims;
    return fault(std::get<MeshRendering>(scene.what).mesh());
  };
  return conform(cube_scene(), own_renderer(cube_scene(), spoiler), {.points = 200});
}

std::set<std::string> found_in(const Conformance& its) {
  EXPECT_FALSE(its.failure) << *its.failure;
  std::set<std::string> names;
  if (its.judgement.all.beyond > 0) names.insert("exact");
  for (const Invariant& invariant : its.invariants)
    if (invariant.violation) names.insert(invariant.name);
  return names;
}

std::size_t most_faces_at_an_edge(const mesh::TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> counts;
  std::size_t most = 0;
  for (const mesh::Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, ++counts[std::minmax(t[i], t[(i + 1) % 3])]);
  return most;
}

bool has_one_twice(const mesh::TriangleMesh& mesh) {
  std::set<std::set<std::uint32_t>> seen;
  return !std::ranges::all_of(mesh.triangles, [&](const mesh::Triangle& t) { return seen.insert({t[0], t[1], t[2]}).second; });
}

// A vertex that lies inside the side of a triangle, along y.
bool has_split_side(const mesh::TriangleMesh& mesh) {
  return std::ranges::any_of(mesh.vertices, [](const mesh::Vertex& v) { return v[0] == 0 && v[1] == 0.5F; });
}

TEST(meeting_faces, are_felt_as_they_are_defined_by_the_real_time_path) {
  const Conformance its = with_fault([](const mesh::TriangleMesh&) { return Spoil(); }, "definition");
  EXPECT_EQ(found_in(its), std::set<std::string>{});
  EXPECT_TRUE(its.held());
  for (const std::string& name : {kMeet, kOne, kWhole, kAsDefined}) {
    const auto found = std::ranges::find(its.invariants, name, &Invariant::name);
    ASSERT_NE(found, its.invariants.end()) << name;
    EXPECT_FALSE(found->not_applicable) << name;
    EXPECT_GT(found->cases, 90U) << name;
  }
}

TEST(meeting_faces, are_not_tried_on_a_renderer_of_regular_meshes) {
  const auto spoiler = [](Description& scene, Json& hello) {
    EXPECT_TRUE(std::get<MeshRendering>(scene.what).checked.is_regular()) << "it is not opened on another one";
    hello["meshes"] = "regular";
    return Spoil();
  };
  const Conformance its = conform(cube_scene(), own_renderer(cube_scene(), spoiler), {.points = 200});
  EXPECT_TRUE(its.held());
  for (const std::string& name : {kMeet, kOne, kWhole, kAsDefined}) {
    const auto found = std::ranges::find(its.invariants, name, &Invariant::name);
    ASSERT_NE(found, its.invariants.end()) << name;
    ASSERT_TRUE(found->not_applicable) << name;
    EXPECT_EQ(*found->not_applicable, R"(it declares meshes "regular" and not "any")");
  }
}

// The hand below the spine is let go; it is the same where pages lie there twice, or are split.
TEST(meeting_faces, let_a_hand_through_a_spine) {
  const Fault fault = [](const mesh::TriangleMesh& mesh) -> Spoil {
    if (mesh.triangles.size() < 8 || most_faces_at_an_edge(mesh) < 4 || mesh.vertices.front()[2] == 0) return {};
    return [](const Eigen::Vector3f& hand, Eigen::Vector3f& force, bool) {
      if (hand.z() < -std::abs(hand.x())) force.setZero();
    };
  };
  EXPECT_EQ(found_in(with_fault(fault, "invariants")), std::set<std::string>{kMeet});
  EXPECT_EQ(found_in(with_fault(fault, "definition")), (std::set<std::string>{kMeet, kAsDefined}));
}

TEST(meeting_faces, push_twice_where_they_coincide) {
  const Fault fault = [](const mesh::TriangleMesh& mesh) -> Spoil {
    if (!has_one_twice(mesh)) return {};
    return [](const Eigen::Vector3f&, Eigen::Vector3f& force, bool) { force *= 2; };
  };
  EXPECT_EQ(found_in(with_fault(fault, "invariants")), std::set<std::string>{kOne});
}

TEST(meeting_faces, push_aside_where_a_side_is_split) {
  const Fault fault = [](const mesh::TriangleMesh& mesh) -> Spoil {
    if (!has_split_side(mesh)) return {};
    return [](const Eigen::Vector3f& hand, Eigen::Vector3f& force, bool) {
      if (!force.isZero(0) && std::abs(hand.y() - 0.5F) < 0.3F) force.y() += 0.05F * force.norm();
    };
  };
  EXPECT_EQ(found_in(with_fault(fault, "invariants")), std::set<std::string>{kWhole});
}

// By less than a hand would notice, at a plate twice and in boxes that touch.
TEST(meeting_faces, push_by_one_unit_too_much) {
  const Fault fault = [](const mesh::TriangleMesh& mesh) -> Spoil {
    if (!has_one_twice(mesh)) return {};
    return [](const Eigen::Vector3f&, Eigen::Vector3f& force, bool) {
      if (force.z() != 0) force.z() = std::nextafter(force.z(), 1e9F);
    };
  };
  EXPECT_EQ(found_in(with_fault(fault, "definition")), std::set<std::string>{kAsDefined});
  EXPECT_EQ(found_in(with_fault(fault, "invariants")), std::set<std::string>{});
}

}  // namespace
}  // namespace forceshade::conformance
