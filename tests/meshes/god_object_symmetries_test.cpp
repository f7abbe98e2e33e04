// SPDX-License-Identifier: BSD-3-Clause
// The consequences of the definition of the god-object (docs/god-object.md, Consequences) for a mesh that is renumbered or turned
// over.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/reference.h"
#include "reference/meshes/directions.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/random_paths.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

using mesh::Place;
using mesh::Side;
using mesh::Sides;
using reference::GodObject;
using reference::meshes::Surface;
using reference::meshes::Vector;
using tests::built;
using tests::Counts;
using tests::Friction;
using tests::is_same;
using tests::is_touching;
using tests::kEachFriction;
using tests::on_random_paths;
using tests::place_of;
using tests::point_of;
using tests::Scene;
using tests::show;
using tests::squared_distance;
using tests::Step;

// A renumbering may change ties, and at rest in a triangle the last grid step.
class Renumbered {
 public:
  Renumbered(const Scene& scene, std::uint64_t seed) : random_(seed), mesh_(scene.made.mesh) {
    const auto shuffled = [&](std::size_t size) {
      std::vector<std::uint32_t> order(size);
      std::iota(order.begin(), order.end(), 0U);
      std::ranges::shuffle(order, random_);
      return order;
    };
    new_vertex_ = shuffled(mesh_.vertices.size());
    new_triangle_ = shuffled(mesh_.triangles.size());
    mesh::CornerNormals normals(mesh_.triangles.size());
    for (std::size_t i = 0; i < new_vertex_.size(); ++i) mesh_.vertices[new_vertex_[i]] = scene.made.mesh.vertices[i];
    for (std::size_t i = 0; i < new_triangle_.size(); ++i) {
      turns_.push_back(random_() % 3);
      for (std::size_t k = 0; k < 3; ++k) {
        mesh_.triangles[new_triangle_[i]][(k + turns_[i]) % 3] = new_vertex_[scene.made.mesh.triangles[i][k]];
        normals[new_triangle_[i]][(k + turns_[i]) % 3] = scene.normals[i][k];
      }
    }
    mesh::Materials materials = scene.given;
    for (std::size_t i = 0; i < materials.of_triangle.size(); ++i)
      materials.of_triangle[new_triangle_[i]] = scene.given.of_triangle[i];
    surface_.emplace(mesh_);
    god_object_ = built(mesh_, normals, scene.made.sides, Scene::kStiffness, materials);
  }

  const GodObject& god_object() const { return *god_object_; }
  const Surface& surface() const { return *surface_; }

  // The same point, in the other numbering.
  mesh::GodObject state(const mesh::GodObject& old) const {
    mesh::GodObject state = old;
    if (old.place == Place::vertex) state.index[0] = new_vertex_[old.index[0]];
    if (old.place == Place::edge) {
      state.index = {new_vertex_[old.index[0]], new_vertex_[old.index[1]]};
      if (state.index[0] > state.index[1]) {
        std::swap(state.index[0], state.index[1]);
        state.parameter[0] = reference::meshes::kGrid - old.parameter[0];
      }
    }
    if (old.place == Place::triangle) {
      state.index[0] = new_triangle_[old.index[0]];
      const auto [k, l] = old.parameter;
      const std::array<std::uint32_t, 3> weights{reference::meshes::kGrid - k - l, k, l};
      const std::size_t turn = turns_[old.index[0]];
      state.parameter = {weights[(4 - turn) % 3], weights[(5 - turn) % 3]};
    }
    return state;
  }

 private:
  std::mt19937_64 random_;
  mesh::TriangleMesh mesh_;
  std::vector<std::uint32_t> new_vertex_, new_triangle_;
  std::vector<std::size_t> turns_;
  std::optional<Surface> surface_;
  std::optional<GodObject> god_object_;
};

// In the same triangle, each of the three weights at most one grid step apart.
bool is_a_grid_step_apart(const mesh::GodObject& a, const mesh::GodObject& b) {
  if (a.place != Place::triangle || b.place != Place::triangle || a.index != b.index || a.side != b.side) return false;
  const auto off = [](std::uint32_t x, std::uint32_t y) { return std::abs(static_cast<int>(x) - static_cast<int>(y)); };
  return off(a.parameter[0], b.parameter[0]) <= 1 && off(a.parameter[1], b.parameter[1]) <= 1 &&
         off(a.parameter[0] + a.parameter[1], b.parameter[0] + b.parameter[1]) <= 1;
}

TEST(god_object_consequences, renumbering_changes_only_ties_and_the_last_grid_step) {
  std::optional<Renumbered> other;
  const std::vector<std::string> expected{"same", "a tie of directions", "the last grid step"};
  for (const Friction friction : kEachFriction)
    on_random_paths(
        5, 220, 150, expected,
        [&](const Scene& scene, const Step& step, Counts& counts) {
          if (step.before.place == Place::nowhere) other.emplace(scene, 77);
          // Move by move, so that a tie is seen where it is.
          const mesh::Tick one = scene.god_object.step(step.before, step.position, 1);
          const mesh::Tick renumbered = other->god_object().step(other->state(step.before), step.position, 1);
          mesh::Tick as_expected = one;
          as_expected.after = other->state(one.after);
          if (is_same(renumbered, as_expected)) {
            ++counts["same"];
            return;
          }
          const Vector u = reference::meshes::exact_point(step.position) - place_of(scene.surface, step.before);
          if (is_touching(step.before) && directions(scene.surface, point_of(scene.surface, step.before).feature, u).is_tied) {
            ++counts["a tie of directions"];
            return;
          }
          const bool is_rest = one.status == Status::contact && renumbered.status == Status::contact;
          if (is_rest && one.force == renumbered.force && is_a_grid_step_apart(as_expected.after, renumbered.after)) {
            ++counts["the last grid step"];
            return;
          }
          ++counts["a tie of rounding"];
          EXPECT_EQ(squared_distance(scene.surface, one.after, step.position),
                    squared_distance(other->surface(), renumbered.after, step.position))
              << show(renumbered) << ", expected " << show(as_expected);
        },
        friction);
}

TEST(god_object_consequences, turning_every_triangle_over_swaps_the_sides_off_the_rim) {
  std::optional<GodObject> other;
  const auto turned_over = [](mesh::GodObject state, const Surface& surface) {
    if (state.place == Place::triangle) std::swap(state.parameter[0], state.parameter[1]);
    if (is_touching(state) && !surface.is_at_rim(point_of(surface, state).feature))
      state.side = state.side == Side::front ? Side::back : Side::front;
    return state;
  };
  for (const Friction friction : kEachFriction)
    on_random_paths(
        6, 220, 150, {"turned", "a tie"},
        [&](const Scene& scene, const Step& step, Counts& counts) {
          if (scene.made.sides != Sides::both) return;
          if (step.before.place == Place::nowhere) {
            mesh::TriangleMesh mesh = scene.made.mesh;
            mesh::CornerNormals normals = scene.normals;
            for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
            for (auto& corners : normals) {
              std::swap(corners[1], corners[2]);
              for (mesh::Normal& normal : corners) normal = {-normal[0], -normal[1], -normal[2]};
            }
            other = built(mesh, normals, Sides::both, Scene::kStiffness, scene.given);
            return;  // the start stores front
          }
          // At the rim both store front: so a slide from there may not turn over, and shading from there does not.
          const mesh::Tick one = scene.god_object.step(step.before, step.position, 1);
          const auto is_at_rim = [&](const mesh::GodObject& state) {
            return is_touching(state) && scene.surface.is_at_rim(point_of(scene.surface, state).feature);
          };
          if (is_at_rim(step.before) || is_at_rim(one.after)) {
            ++counts["at the rim"];
            return;
          }
          const mesh::Tick turned = other->step(turned_over(step.before, scene.surface), step.position, 1);
          mesh::Tick as_expected = one;
          as_expected.after = turned_over(one.after, scene.surface);
          ++counts["turned"];
          if (is_same(turned, as_expected)) return;
          // k and l have changed places, so that a tie between them goes the other way.
          ++counts["a tie"];
          EXPECT_EQ(turned.status, one.status);
          EXPECT_EQ(turned.moves, one.moves);
          EXPECT_EQ(turned.after.side, as_expected.after.side) << show(turned) << ", expected " << show(as_expected);
          const bool is_rest = one.status == Status::contact && turned.force == one.force;
          EXPECT_TRUE((is_rest && is_a_grid_step_apart(as_expected.after, turned.after)) ||
                      squared_distance(scene.surface, one.after, step.position) ==
                          squared_distance(scene.surface, turned_over(turned.after, scene.surface), step.position))
              << show(turned) << ", expected " << show(as_expected);
        },
        friction);
}

}  // namespace
}  // namespace forceshade
