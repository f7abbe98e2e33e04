// SPDX-License-Identifier: BSD-3-Clause
// What follows from the definition of the god-object (docs/god-object.md, Consequences), on random meshes and paths.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "properties/mesh_source.h"
#include "reference/meshes/descent.h"
#include "reference/meshes/directions.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

using mesh::Place;
using mesh::Side;
using mesh::Sides;
using mesh::TickStatus;
using properties::MeshPath;
using properties::MeshSource;
using properties::RandomMesh;
using reference::GodObject;
using reference::meshes::Feature;
using reference::meshes::Fold;
using reference::meshes::Fraction;
using reference::meshes::GridPoint;
using reference::meshes::Integer;
using reference::meshes::Surface;
using reference::meshes::Vector;
using tests::is_same;
using tests::show;

using Position = std::array<float, 3>;

GodObject built(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals, Sides sides, float stiffness) {
  return tests::built(GodObject::build(tests::shaded(mesh, normals, sides, stiffness)));
}

// A random mesh with its god-object, shaded.
struct Scene {
  Scene(const RandomMesh& random, mesh::CornerNormals corner_normals)
      : made(random),
        normals(std::move(corner_normals)),
        god_object(built(made.mesh, normals, made.sides, kStiffness)),
        surface(made.mesh),
        crossings(surface) {}

  reference::meshes::Ground ground() const { return {surface, crossings, made.sides, mesh::SelfIntersections::refused}; }

  static constexpr float kStiffness = 0.7F;
  RandomMesh made;
  mesh::CornerNormals normals;
  GodObject god_object;
  Surface surface;
  reference::meshes::Crossings crossings;
};

struct Step {
  mesh::GodObject before;
  Position position;
  mesh::Tick tick;
};

bool is_touching(const mesh::GodObject& state) {
  return state.place == Place::vertex || state.place == Place::edge || state.place == Place::triangle;
}

GridPoint point_of(const Surface& surface, const mesh::GodObject& state) {
  const std::size_t index = state.place == Place::edge ? surface.edge_between(state.index[0], state.index[1]) : state.index[0];
  return {{state.place, index}, state.parameter};
}

Vector place_of(const Surface& surface, const mesh::GodObject& state) {
  return is_touching(state) ? surface.position(point_of(surface, state)) : reference::meshes::exact_point(state.position);
}

Integer squared_distance(const Surface& surface, const mesh::GodObject& state, const Position& position) {
  const Vector off = place_of(surface, state) - reference::meshes::exact_point(position);
  return dot(off, off);
}

// Calls check(scene, step, counts) for each tick of a random path on each of random meshes, every family as often, and prints
// the counts. A name that stands in `expected` must have been counted.
using Counts = std::map<std::string, int>;
template <class Check>
void on_random_paths(std::uint64_t seed, int meshes, int ticks, const std::vector<std::string>& expected, Check check) {
  MeshSource source(seed);
  Counts counts;
  for (int i = 0; i < meshes && !testing::Test::HasFailure(); ++i) {
    const RandomMesh made = source.next();
    const Scene scene(made, source.normals_of(made.mesh));
    MeshPath path(made.mesh, seed + static_cast<std::uint64_t>(i));
    mesh::GodObject state;
    for (int k = 0; k < ticks && !testing::Test::HasFailure(); ++k) {
      const Position position = path.next();
      const Step step{state, position, scene.god_object.step(state, position)};
      SCOPED_TRACE("mesh " + std::to_string(i) + ", " + std::string(properties::kMeshFamilies[made.family]) + ", tick " +
                   std::to_string(k) + ": from " + tests::feature_text(state) + " to " + show(step.tick));
      ++counts[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(step.tick.status)])];
      if (is_touching(step.tick.after))
        ++counts[std::string(mesh::kPlaceNames[static_cast<std::size_t>(step.tick.after.place)])];
      if (step.tick.after.side == Side::back) ++counts["back"];
      check(scene, step, counts);
      state = step.tick.after;
    }
  }
  for (const auto& [name, count] : counts) std::printf("  %8d %s\n", count, name.c_str());
  for (const char* always : {"free", "touching", "invalid", "vertex", "edge", "triangle", "back"})
    EXPECT_GT(counts[always], 0) << always;
  for (const std::string& name : expected) EXPECT_GT(counts[name], 0) << name;
}

TEST(god_object_consequences, resting_is_idempotent) {
  on_random_paths(1, 220, 200, {"rested again"}, [](const Scene& scene, const Step& step, Counts& counts) {
    if (step.tick.status == TickStatus::unfinished || step.tick.status == TickStatus::invalid) return;
    const mesh::Tick again = scene.god_object.step(step.tick.after, step.position);
    EXPECT_EQ(again.status, step.tick.status) << show(again);
    EXPECT_EQ(again.after, step.tick.after) << show(again);
    EXPECT_EQ(again.force, step.tick.force) << show(again);
    ++counts["rested again"];
  });
}

TEST(god_object_consequences, an_invalid_position_changes_nothing_and_gives_no_force) {
  on_random_paths(2, 110, 100, {"invalid while touching"}, [](const Scene&, const Step& step, Counts& counts) {
    if (step.tick.status != TickStatus::invalid) return;
    EXPECT_EQ(step.tick.after, step.before);
    EXPECT_EQ(step.tick.force, (Position{0, 0, 0}));
    counts["invalid while touching"] += is_touching(step.before);
  });
}

// One move a tick: so every point at which the surface is left or met again is a state.
TEST(god_object_consequences, fewer_moves_a_tick_lead_to_the_same_state_and_from_point_to_point_the_distance_falls) {
  on_random_paths(
      3, 220, 150, {"several moves", "landed farther off"}, [](const Scene& scene, const Step& step, Counts& counts) {
        if (step.tick.status == TickStatus::invalid || step.tick.status == TickStatus::unfinished) return;
        mesh::GodObject state = step.before;
        unsigned moves = 0;
        for (int ticks = 0; ticks <= 300; ++ticks) {
          const mesh::Tick one = scene.god_object.step(state, step.position, 1);
          moves += one.moves;
          if (one.status != TickStatus::unfinished) {
            EXPECT_EQ(one.after, step.tick.after) << show(one);
            EXPECT_EQ(one.force, step.tick.force) << show(one);
            EXPECT_EQ(moves, step.tick.moves);
            counts["several moves"] += moves > 1;
            return;
          }
          const bool is_nearer =
              squared_distance(scene.surface, one.after, step.position) < squared_distance(scene.surface, state, step.position);
          if (is_touching(state))
            ASSERT_TRUE(is_nearer) << show(one);
          else
            counts["landed farther off"] += !is_nearer;
          state = one.after;
        }
        FAIL() << "not at rest after 300 single moves";
      });
}

// Whether each coordinate times 2^places is one too.
bool can_be_scaled(const Position& position, int places) {
  return std::ranges::all_of(position, [&](float x) {
    const float scaled = std::ldexp(x, places);
    return std::fabs(x) <= 1e4F && (x == 0 || (std::fabs(x) >= 0x1p-30F && std::fabs(scaled) >= 0x1p-30F)) &&
           std::fabs(scaled) <= 1e4F && std::ldexp(scaled, -places) == x;
  });
}

Position scaled(const Position& position, int places) {
  return {std::ldexp(position[0], places), std::ldexp(position[1], places), std::ldexp(position[2], places)};
}

TEST(god_object_consequences, a_size_times_a_power_of_two_changes_no_state) {
  std::mt19937_64 random(4);
  const Surface* last = nullptr;
  int places = 0;
  std::optional<GodObject> other;
  on_random_paths(
      4, 220, 150, {"scaled", "of another size and touching"}, [&](const Scene& scene, const Step& step, Counts& counts) {
        if (last != &scene.surface || step.before.place == Place::nowhere) {
          last = &scene.surface;
          do {
            places = static_cast<int>(random() % 33) - 16;
          } while (!std::ranges::all_of(scene.made.mesh.vertices, [&](const Position& v) { return can_be_scaled(v, places); }));
          mesh::TriangleMesh larger = scene.made.mesh;
          for (mesh::Vertex& vertex : larger.vertices) vertex = scaled(vertex, places);
          other = built(larger, scene.normals, scene.made.sides, Scene::kStiffness);
        }
        const bool is_free = step.before.place == Place::free;
        if (!can_be_scaled(step.position, places) || (is_free && !can_be_scaled(step.before.position, places))) return;
        mesh::GodObject before = step.before;
        before.position = scaled(before.position, places);
        mesh::Tick tick = other->step(before, scaled(step.position, places));
        for (float& coordinate : tick.after.position) coordinate = std::ldexp(coordinate, -places);
        EXPECT_EQ(tick.status, step.tick.status) << show(tick);
        EXPECT_EQ(tick.moves, step.tick.moves) << show(tick);
        EXPECT_EQ(tick.after, step.tick.after) << show(tick);
        for (std::size_t axis = 0; axis < 3; ++axis)  // below 2^-126 a component has fewer digits
          if (std::fabs(step.tick.force[axis]) >= 0x1p-100F) {
            EXPECT_EQ(tick.force[axis], std::ldexp(step.tick.force[axis], places)) << show(tick);
          }
        ++counts["scaled"];
        counts["of another size and touching"] += places != 0 && is_touching(tick.after);
      });
}

// What a renumbering may change: ties, and at rest in a triangle the last grid step.
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
    surface_.emplace(mesh_);
    god_object_ = built(mesh_, normals, scene.made.sides, Scene::kStiffness);
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
  on_random_paths(5, 220, 150, expected, [&](const Scene& scene, const Step& step, Counts& counts) {
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
    const bool is_rest = one.status == TickStatus::touching && renumbered.status == TickStatus::touching;
    if (is_rest && one.force == renumbered.force && is_a_grid_step_apart(as_expected.after, renumbered.after)) {
      ++counts["the last grid step"];
      return;
    }
    ++counts["a tie of rounding"];
    EXPECT_EQ(squared_distance(scene.surface, one.after, step.position),
              squared_distance(other->surface(), renumbered.after, step.position))
        << show(renumbered) << ", expected " << show(as_expected);
  });
}

TEST(god_object_consequences, turning_every_triangle_over_swaps_the_sides_off_the_rim) {
  std::optional<GodObject> other;
  const auto turned_over = [](mesh::GodObject state, const Surface& surface) {
    if (state.place == Place::triangle) std::swap(state.parameter[0], state.parameter[1]);
    if (is_touching(state) && !surface.is_at_rim(point_of(surface, state).feature))
      state.side = state.side == Side::front ? Side::back : Side::front;
    return state;
  };
  on_random_paths(6, 220, 150, {"turned", "a tie"}, [&](const Scene& scene, const Step& step, Counts& counts) {
    if (scene.made.sides != Sides::both) return;
    if (step.before.place == Place::nowhere) {
      mesh::TriangleMesh mesh = scene.made.mesh;
      mesh::CornerNormals normals = scene.normals;
      for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
      for (auto& corners : normals) {
        std::swap(corners[1], corners[2]);
        for (mesh::Normal& normal : corners) normal = {-normal[0], -normal[1], -normal[2]};
      }
      other = built(mesh, normals, Sides::both, Scene::kStiffness);
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
    const bool is_rest = one.status == TickStatus::touching && turned.force == one.force;
    EXPECT_TRUE((is_rest && is_a_grid_step_apart(as_expected.after, turned.after)) ||
                squared_distance(scene.surface, one.after, step.position) ==
                    squared_distance(scene.surface, turned_over(turned.after, scene.surface), step.position))
        << show(turned) << ", expected " << show(as_expected);
  });
}

// Crossings of a ray, counted with CGAL's predicates: nothing in common with either side.
class Inside {
 public:
  explicit Inside(const mesh::TriangleMesh& mesh) {
    for (const mesh::Triangle& triangle : mesh.triangles) {
      std::array<Point, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = point(mesh.vertices[triangle[i]]);
      triangles_.push_back(corners);
    }
  }

  // Of a point off the surface.
  bool operator()(const Position& position) {
    const Point from = point(position);
    for (;;) {
      const auto far = [&] { return std::uniform_real_distribution<double>(-1e6, 1e6)(random_); };
      const Point to(far(), far(), std::copysign(1e6, far()));
      int crossings = 0;
      bool is_general = true;
      for (const auto& [a, b, c] : triangles_) {
        const auto above = CGAL::orientation(a, b, c, from), below = CGAL::orientation(a, b, c, to);
        const auto first = CGAL::orientation(from, to, a, b), second = CGAL::orientation(from, to, b, c),
                   third = CGAL::orientation(from, to, c, a);
        if (above == CGAL::COPLANAR || below == CGAL::COPLANAR) {
          // In the plane, but off the triangle: another ray decides, unless this one is clearly apart.
          if (!(first == second && second == third)) continue;
          is_general = false;
        } else if (above != below) {
          is_general &= first != CGAL::COPLANAR && second != CGAL::COPLANAR && third != CGAL::COPLANAR;
          crossings += first == second && second == third;
        }
      }
      if (is_general) return crossings % 2 == 1;
    }
  }

 private:
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  static Point point(const Position& p) {
    const auto exact = [](float x) { return std::fabs(x) < 0x1p-30F ? 0 : static_cast<double>(x); };
    return {exact(p[0]), exact(p[1]), exact(p[2])};
  }

  std::vector<std::array<Point, 3>> triangles_;
  std::mt19937_64 random_{1};
};

TEST(god_object_consequences, it_never_gets_into_a_closed_mesh_nor_out_of_one_that_blocks_both_sides) {
  bool is_out = false, is_in = false;  // it was free outside, or inside, and has had to stay there
  std::optional<Inside> is_inside;
  const std::vector<std::string> expected{"kept out", "kept in", "left from behind"};
  on_random_paths(7, 330, 200, expected, [&](const Scene& scene, const Step& step, Counts& counts) {
    constexpr std::array<std::string_view, 4> kClosed{"bipyramid", "slab", "star", "torus"};
    if (std::ranges::find(kClosed, properties::kMeshFamilies[scene.made.family]) == kClosed.end()) return;
    if (step.before.place == Place::nowhere) {
      is_out = is_in = false;
      is_inside.emplace(scene.made.mesh);
    }
    const bool blocks_both = scene.made.sides == Sides::both;
    if (step.tick.status == TickStatus::free) {
      const bool is_now_inside = (*is_inside)(step.tick.after.position);
      EXPECT_FALSE(is_out && is_now_inside) << "it was outside";
      EXPECT_FALSE(blocks_both && is_in && !is_now_inside) << "it was inside";
      counts["left from behind"] += is_in && !is_now_inside;
      counts["kept out"] += is_out;
      counts["kept in"] += blocks_both && is_in;
      is_out = !is_now_inside;
      is_in = is_now_inside;
    } else if (is_touching(step.tick.after) && (is_out || is_in) && blocks_both) {
      EXPECT_EQ(step.tick.after.side, is_out ? Side::front : Side::back);
    }
  });
}

// The squared distance of p from a closed triangle.
Fraction squared_distance(const Surface& surface, std::size_t index, const Vector& p) {
  const auto& triangle = surface.triangles()[index];
  const auto corner = [&](std::size_t i) { return p - surface.vertices()[triangle.vertices[i]]; };
  const Vector &e = triangle.sides[0], f = -triangle.sides[2], w = corner(0);
  const Integer ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), we = dot(w, e), wf = dot(w, f);
  const Integer whole = ee * ff - ef * ef, beta = we * ff - wf * ef, gamma = wf * ee - we * ef;
  if (beta >= 0 && gamma >= 0 && beta + gamma <= whole) {
    const Vector off = whole * w - beta * e - gamma * f;
    return {dot(off, off), whole * whole};
  }
  std::optional<Fraction> least;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector &side = triangle.sides[i], from = corner(i);
    const Integer length = dot(side, side), along = std::clamp(Integer(dot(from, side)), Integer(0), length);
    const Vector off = length * from - along * side;
    const Fraction distance{dot(off, off), length * length};
    if (!least || distance < *least) least = distance;
  }
  return *least;
}

std::vector<std::size_t> triangles_at(const Surface& surface, const Feature& feature) {
  if (feature.place == Place::vertex) return surface.fan(feature.index).triangles;
  if (feature.place == Place::edge) return surface.edges()[feature.index].triangles;
  return {feature.index};
}

TEST(god_object_consequences, every_rest_but_a_refusal_is_a_local_minimum_and_off_p_never_at_the_rim_or_on_a_wide_edge) {
  const std::vector<std::string> expected{"refused", "nearest of its triangles", "nearest on the surface alone", "narrow",
                                          "at the rim"};
  on_random_paths(8, 330, 200, expected, [](const Scene& scene, const Step& step, Counts& counts) {
    if (step.tick.status != TickStatus::touching) return;
    const auto end = descend(scene.ground(), step.before, step.position, step.position, 256);
    const auto& rest = end.rest.value();
    const Vector p = reference::meshes::exact_point(step.position);
    const Feature& feature = rest.r.feature;
    const bool is_at_p = is_zero(rest.D_over);
    const bool is_at_rim = scene.surface.is_at_rim(feature);
    if (!is_at_p) {
      // u at r is -D, from a point with other parameters than the state's: rests at a foot are no refusals.
      const auto ways = directions(scene.surface, feature, -rest.D_over);
      const auto own =
          rest.side == Side::front ? reference::meshes::DirectionKind::front : reference::meshes::DirectionKind::back;
      if (ways.is_nearer || ways.way == own || ways.way == reference::meshes::DirectionKind::open) {
        ++counts["refused"];
        EXPECT_EQ(rest.D_under, 1) << "a refusal rests at a point of the grid";
        return;
      }
    }
    const Fraction distance{dot(rest.D_over, rest.D_over), rest.D_under * rest.D_under};
    for (const std::size_t i : triangles_at(scene.surface, feature))
      EXPECT_EQ(squared_distance(scene.surface, i, p), distance) << "triangle " << i;
    ++counts["nearest of its triangles"];
    for (std::size_t i = 0; i < scene.surface.triangles().size(); ++i)
      if (squared_distance(scene.surface, i, p) < distance) {
        ++counts["nearest on the surface alone"];
        break;
      }
    counts["at the rim"] += is_at_rim;
    EXPECT_TRUE(is_at_p || !is_at_rim) << "at the rim";
    if (feature.place != Place::edge || is_at_rim) return;
    const Fold fold = scene.surface.edges()[feature.index].fold;
    const bool is_narrow = rest.side == Side::front ? fold == Fold::narrow : fold == Fold::wide;
    counts["narrow"] += is_narrow && !is_at_p;
    EXPECT_TRUE(is_narrow || is_at_p || fold == Fold::flat);
  });
}

// docs/energy.md, Meshes: the account of an unshaded tick, in exact numbers and without slack. All times 1/K.
TEST(god_object_consequences, a_tick_gives_no_more_than_the_account_with_the_rounding_of_its_state) {
  using Rational = boost::multiprecision::mpq_rational;
  using Offset = std::array<Rational, 3>;
  const auto dot_of = [](const Offset& a, const Offset& b) { return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
  const auto difference = [](const Offset& a, const Offset& b) { return Offset{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto over = [](const Vector& a, const Integer& under) {
    return Offset{Rational(a[0], under), Rational(a[1], under), Rational(a[2], under)};
  };
  struct Ended {
    mesh::GodObject state;
    Vector p;
    Offset D;
  };
  std::optional<Ended> last;
  on_random_paths(10, 440, 200, {"moved on", "rounded", "beyond the account of r alone"},
                  [&](const Scene& scene, const Step& step, Counts& counts) {
                    const std::optional<Ended> before = std::exchange(last, std::nullopt);
                    if (step.tick.status != TickStatus::touching) return;
                    const auto end = descend(scene.ground(), step.before, step.position, step.position, 256);
                    const auto& rest = end.rest.value();
                    const Vector p = reference::meshes::exact_point(step.position);
                    last = Ended{step.tick.after, p, over(rest.D_over, rest.D_under)};
                    if (!before || before->state != step.before || !is_touching(step.before)) return;
                    const Offset moved = over(p - before->p, 1), g = over(place_of(scene.surface, step.before) - before->p, 1);
                    const Offset rounding = difference(g, before->D);  // g - r
                    const Rational account = dot_of(before->D, before->D) - dot_of(last->D, last->D) + dot_of(moved, moved);
                    const Rational given = 2 * dot_of(before->D, moved);
                    EXPECT_LE(given, account + 2 * dot_of(rounding, difference(before->D, moved)) + dot_of(rounding, rounding));
                    ++counts["moved on"];
                    counts["rounded"] += dot_of(rounding, rounding) > 0;
                    counts["beyond the account of r alone"] += given > account;
                  });
}

TEST(god_object_consequences, shading_turns_the_force_and_keeps_its_size) {
  std::optional<GodObject> plain;
  on_random_paths(9, 220, 150, {"turned", "left as it is"}, [&](const Scene& scene, const Step& step, Counts& counts) {
    if (step.before.place == Place::nowhere)
      plain = tests::built(GodObject::build(
          {tests::checked(scene.made.mesh), {}, scene.made.sides, mesh::Shading::none, Scene::kStiffness, {}}));
    const mesh::Tick unshaded = plain->step(step.before, step.position);
    EXPECT_EQ(unshaded.after, step.tick.after);
    const auto size = [](const Position& f) { return std::hypot(double{f[0]}, double{f[1]}, double{f[2]}); };
    const double before = size(unshaded.force), after = size(step.tick.force);
    // Each component is within 2^-24 of its size, or within 2^-150.
    EXPECT_NEAR(after, before, 0x1p-22 * before + 0x1p-147);
    const double along = double{unshaded.force[0]} * double{step.tick.force[0]} +
                         double{unshaded.force[1]} * double{step.tick.force[1]} +
                         double{unshaded.force[2]} * double{step.tick.force[2]};
    EXPECT_GE(along, -0x1p-22 * before * before - 0x1p-147);
    if (before > 0) ++counts[unshaded.force == step.tick.force ? "left as it is" : "turned"];
  });
}

}  // namespace
}  // namespace forceshade
