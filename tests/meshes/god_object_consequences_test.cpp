// SPDX-License-Identifier: BSD-3-Clause
// The consequences of the definition of the god-object (docs/god-object.md, Consequences), on random meshes and paths, for the
// states and forces of one mesh; god_object_symmetries_test.cpp has what follows for two.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "forceshade/reference.h"
#include "reference/meshes/descent.h"
#include "reference/meshes/directions.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/random_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/support/mesh_source.h"

namespace forceshade {
namespace {

using mesh::Place;
using mesh::Side;
using mesh::Sides;
using reference::GodObject;
using reference::meshes::Feature;
using reference::meshes::Fold;
using reference::meshes::Fraction;
using reference::meshes::Integer;
using reference::meshes::Surface;
using reference::meshes::Vector;
using tests::Counts;
using tests::Friction;
using tests::is_touching;
using tests::kEachFriction;
using tests::on_random_paths;
using tests::place_of;
using tests::Position;
using tests::Scene;
using tests::show;
using tests::squared_distance;
using tests::Step;

TEST(god_object_consequences, resting_is_idempotent) {
  for (const Friction friction : kEachFriction)
    on_random_paths(
        1, 220, 200, {"rested again"},
        [](const Scene& scene, const Step& step, Counts& counts) {
          if (step.tick.status == Status::unfinished || step.tick.status == Status::invalid) return;
          const mesh::Tick again = scene.god_object.step(step.tick.after, step.position);
          EXPECT_EQ(again.status, step.tick.status) << show(again);
          EXPECT_EQ(again.after, step.tick.after) << show(again);
          EXPECT_EQ(again.force, step.tick.force) << show(again);
          ++counts["rested again"];
        },
        friction);
}

TEST(god_object_consequences, an_invalid_position_changes_nothing_and_gives_no_force) {
  on_random_paths(2, 110, 100, {"invalid while touching"}, [](const Scene&, const Step& step, Counts& counts) {
    if (step.tick.status != Status::invalid) return;
    EXPECT_EQ(step.tick.after, step.before);
    EXPECT_EQ(step.tick.force, (Position{0, 0, 0}));
    counts["invalid while touching"] += is_touching(step.before);
  });
}

// One move a tick: so every point at which the surface is left or met again is a state.
TEST(god_object_consequences, fewer_moves_a_tick_lead_to_the_same_state_and_from_point_to_point_the_distance_falls) {
  for (const Friction friction : kEachFriction)
    on_random_paths(
        3, 220, 150, {"several moves", "landed farther off"},
        [](const Scene& scene, const Step& step, Counts& counts) {
          if (step.tick.status == Status::invalid || step.tick.status == Status::unfinished) return;
          mesh::GodObject state = step.before;
          unsigned moves = 0;
          for (int ticks = 0; ticks <= 300; ++ticks) {
            const mesh::Tick one = scene.god_object.step(state, step.position, 1);
            moves += one.moves;
            if (one.status != Status::unfinished) {
              EXPECT_EQ(one.after, step.tick.after) << show(one);
              EXPECT_EQ(one.force, step.tick.force) << show(one);
              EXPECT_EQ(moves, step.tick.moves);
              counts["several moves"] += moves > 1;
              return;
            }
            const bool is_nearer = squared_distance(scene.surface, one.after, step.position) <
                                   squared_distance(scene.surface, state, step.position);
            if (is_touching(state))
              ASSERT_TRUE(is_nearer) << show(one);
            else
              counts["landed farther off"] += !is_nearer;
            state = one.after;
          }
          FAIL() << "not at rest after 300 single moves";
        },
        friction);
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

  // Returns true if a point off the surface is inside.
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
  for (const Friction friction : kEachFriction) {
    std::vector<std::string> expected{"kept out", "left from behind"};
    if (friction == Friction::none) expected.emplace_back("kept in");
    on_random_paths(
        7, 330, 200, expected,
        [&](const Scene& scene, const Step& step, Counts& counts) {
          constexpr std::array<std::string_view, 4> kClosed{"bipyramid", "slab", "star", "torus"};
          if (std::ranges::find(kClosed, tests::kMeshFamilies[scene.made.family]) == kClosed.end()) return;
          if (step.before.place == Place::nowhere) {
            is_out = is_in = false;
            is_inside.emplace(scene.made.mesh);
          }
          const bool blocks_both = scene.made.sides == Sides::both;
          if (step.tick.status == Status::free) {
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
        },
        friction);
  }
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

TEST(god_object_consequences, every_rest_but_a_refusal_is_a_local_minimum_and_off_p_never_at_the_rim_or_on_a_wide_edge) {
  const std::vector<std::string> expected{"refused", "nearest of its triangles", "nearest on the surface alone", "narrow",
                                          "at the rim"};
  on_random_paths(8, 330, 200, expected, [](const Scene& scene, const Step& step, Counts& counts) {
    if (step.tick.status != Status::contact) return;
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
    for (const std::size_t i : scene.surface.triangles_at(feature))
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

// docs/energy.md, Meshes: the account of an unshaded tick, in exact numbers and without slack. All times 1/K. Where friction
// holds the god-object, nothing is rounded.
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
  for (const Friction friction : kEachFriction) {
    std::vector<std::string> expected{"moved on", "rounded"};
    if (friction == Friction::none) expected.emplace_back("beyond the account of r alone");
    on_random_paths(
        10, 440, 200, expected,
        [&](const Scene& scene, const Step& step, Counts& counts) {
          const std::optional<Ended> before = std::exchange(last, std::nullopt);
          if (step.tick.status != Status::contact) return;
          const auto end = descend(scene.ground(), step.before, step.position, step.position, 256);
          const auto& rest = end.rest.value();
          const Vector p = reference::meshes::exact_point(step.position);
          last = Ended{step.tick.after, p, over(rest.D_over + rest.tangential_over, rest.D_under)};
          if (!before || before->state != step.before || !is_touching(step.before)) return;
          const Offset moved = over(p - before->p, 1), g = over(place_of(scene.surface, step.before) - before->p, 1);
          const Offset rounding = difference(g, before->D);  // g - r
          const Rational account = dot_of(before->D, before->D) - dot_of(last->D, last->D) + dot_of(moved, moved);
          const Rational given = 2 * dot_of(before->D, moved);
          EXPECT_LE(given, account + 2 * dot_of(rounding, difference(before->D, moved)) + dot_of(rounding, rounding));
          ++counts["moved on"];
          counts["rounded"] += dot_of(rounding, rounding) > 0;
          counts["beyond the account of r alone"] += given > account;
        },
        friction);
  }
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
