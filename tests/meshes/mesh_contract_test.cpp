// SPDX-License-Identifier: BSD-3-Clause
// The input of a god-object on a mesh is checked, by a type or by both sides, and a tick that cannot be decided says so.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "fast/meshes/advance.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

// A mesh is checked, or it has another type.
template <class Checked>
constexpr bool is_made_by_its_check_alone =
    !std::is_default_constructible_v<Checked> && !std::is_aggregate_v<Checked> &&
    !std::is_constructible_v<Checked, mesh::TriangleMesh> && !std::is_constructible_v<Checked, mesh::TriangleMesh, bool>;
static_assert(is_made_by_its_check_alone<mesh::JoinedMesh> && is_made_by_its_check_alone<mesh::CheckedMesh>);
static_assert(!std::is_constructible_v<mesh::CheckedMesh, mesh::JoinedMesh>,
              "the meetings of its triangles were not looked for");

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

MeshRendering triangle(mesh::Shading shading) {
  MeshRendering rendering = tests::unshaded({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}}, mesh::Sides::front);
  rendering.shading = shading;
  rendering.normals = mesh::CornerNormals(1, {{{0, 0, 1}, {0, 0, 1}, {0.6F, 0, 0.8F}}});
  rendering.texture.corners = {
      {{{{0, 0}, {1, 0, 0}, {0, 1, 0}}, {{4, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 4}, {1, 0, 0}, {0, 1, 0}}}}};
  rendering.texture.map.parts = {{height::Plane{}, false}};
  return rendering;
}

// Both sides give the same reason; empty where both build it.
std::string refusal(const MeshRendering& rendering) {
  const auto words = [](const auto& built) {
    const auto* error = std::get_if<ParameterError>(&built);
    return error == nullptr ? std::string() : error->message();
  };
  const std::string exact = words(reference::GodObject::build(rendering));
  EXPECT_EQ(words(fast::GodObject::build(rendering)), exact);
  return exact;
}

TEST(mesh_contract, a_stiffness_outside_its_range_is_refused_by_both_sides) {
  MeshRendering rendering = triangle(mesh::Shading::none);
  const auto god_object = tests::built(fast::GodObject::build(rendering));
  for (const float wrong : {0.0F, 0.000999F, 1000.1F, -1.0F, kNaN, kInfinity}) {
    rendering.stiffness = wrong;
    EXPECT_NE(refusal(rendering).find("stiffness is "), std::string::npos) << wrong;
    EXPECT_TRUE(std::holds_alternative<ParameterError>(god_object.with_stiffness(wrong))) << wrong;
  }
  for (const float right : {0.001F, 1000.0F}) {
    rendering.stiffness = right;
    EXPECT_EQ(refusal(rendering), "") << right;
    EXPECT_TRUE(std::holds_alternative<fast::GodObject>(god_object.with_stiffness(right))) << right;
  }
}

TEST(mesh_contract, a_shading_without_what_it_uses_is_refused_and_never_replaced_by_none) {
  for (const mesh::Shading shading : {mesh::Shading::vertex_scheme, mesh::Shading::texture_scheme}) {
    MeshRendering rendering = triangle(shading);
    EXPECT_EQ(refusal(rendering), "");
    rendering.normals.clear();
    EXPECT_NE(refusal(rendering).find("number of triangles with normals is 0"), std::string::npos);
    for (const float wrong : {2.1F, -2.1F, kNaN, kInfinity}) {
      rendering = triangle(shading);
      rendering.normals[0][2][1] = wrong;
      EXPECT_NE(refusal(rendering).find("component of a normal"), std::string::npos) << wrong;
    }
  }
  MeshRendering rendering = triangle(mesh::Shading::texture_scheme);
  rendering.texture.corners.clear();
  EXPECT_NE(refusal(rendering).find("number of triangles with texture is 0"), std::string::npos);
  rendering = triangle(mesh::Shading::texture_scheme);
  rendering.texture.map.parts.clear();
  EXPECT_NE(refusal(rendering), "") << "a map without parts";
  for (const float wrong : {1000.1F, 0x1p-31F, kNaN}) {
    rendering = triangle(mesh::Shading::texture_scheme);
    rendering.texture.corners[0][1].gradient_y[2] = wrong;
    EXPECT_NE(refusal(rendering).find("gradient of a texture coordinate"), std::string::npos) << wrong;
  }
}

TEST(mesh_contract, a_shading_that_uses_neither_normals_nor_a_texture_looks_at_none) {
  for (const mesh::Shading shading : {mesh::Shading::none, mesh::Shading::edge_scheme}) {
    MeshRendering rendering = triangle(shading);
    rendering.normals = mesh::CornerNormals(7, {{{kNaN, 0, 0}, {}, {}}});
    rendering.texture = {};
    EXPECT_EQ(refusal(rendering), "");
  }
}

// As laws answer where their last stage cannot decide: no force, and a status on which a loop stops.
TEST(mesh_contract, a_tick_whose_force_the_last_stage_cannot_decide_is_invalid_and_has_no_force) {
  for (const Status status : {Status::contact, Status::unfinished}) {
    mesh::Tick tick{status, 3, {1, 2, 3}, {}};
    fast::set_force(std::nullopt, tick);
    EXPECT_EQ(tick.status, Status::invalid);
    EXPECT_EQ(tick.force, (std::array<float, 3>{}));
    EXPECT_EQ(tick.moves, 3);
    tick.status = status;
    fast::set_force(std::array<float, 3>{0, 0, 0.5F}, tick);
    EXPECT_EQ(tick.status, status);
    EXPECT_EQ(tick.force, (std::array<float, 3>{0, 0, 0.5F}));
  }
}

// A session whose ticks are given, since no input is known that the last stage cannot decide.
class Given final : public fast::TickSession {
 public:
  explicit Given(const mesh::Tick& tick) : tick_(tick) {}
  mesh::Tick tick(const std::array<float, 3>&) noexcept override { return tick_; }
  fast::Stage stage() const noexcept override { return fast::Stage::wide; }
  void resume(const mesh::GodObject&) noexcept override {}

 private:
  mesh::Tick tick_;
};

TEST(mesh_contract, a_loop_gets_no_force_from_an_invalid_tick_whatever_it_holds) {
  for (const Status status : {Status::invalid, Status::free, Status::contact, Status::unfinished}) {
    Given session({status, 1, {1, 2, 3}, {}});
    const fast::Evaluation answer = session.step({0, 0, 0});
    EXPECT_EQ(answer.status, status);
    EXPECT_EQ(answer.force, finished(status) == Status::contact ? Eigen::Vector3f(1, 2, 3) : Eigen::Vector3f(0, 0, 0));
    EXPECT_EQ(answer.stage, fast::Stage::wide);
  }
}

// A coordinate that no tick leaves, since it is beyond the domain or would have become 0: the exact differences have no room
// for it.
TEST(mesh_contract, a_state_that_no_tick_leaves_counts_as_that_of_a_beginning) {
  const auto god_object = tests::built(fast::GodObject::build(triangle(mesh::Shading::none)));
  for (const float wrong : {1.2e-15F, -9.3e-10F, 1e-37F, 1e-45F, 1e9F, kNaN, kInfinity})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh::GodObject state{.place = mesh::Place::free, .position = {1, 1, 2}};
      state.position[axis] = wrong;
      for (const std::array<float, 3>& to : {std::array<float, 3>{1, 1, -1}, {1, 1, 3}})
        EXPECT_EQ(god_object.tick(state, to).after, god_object.tick({}, to).after) << wrong;
    }
}

}  // namespace
}  // namespace forceshade
