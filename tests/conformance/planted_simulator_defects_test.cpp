// SPDX-License-Identifier: BSD-3-Clause
// Defects of simulators, each in an exact one: what finds it, and that nothing else does. Those with a number are in
// tests/conformance/planted_defects.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "properties/conformance/simulators/conform_simulator.h"
#include "properties/conformance/simulators/finding.h"
#include "tests/conformance/own_simulator.h"

namespace forceshade::conformance::simulators {
namespace {

using Names = std::set<std::string>;

const std::string kFinite = "every answer is a finite number",
                  kSpeed = "a flat floor keeps the speed, however it is triangulated",
                  kLoad = "a flat floor pushes with what lies on it, however it is triangulated",
                  kGhost = "a flat floor has no ghost forces at inner edges",
                  kNormals = "the normals that are reported on a flat floor are its own",
                  kTouching = "a sphere that touches exactly is pushed along the normal",
                  kRest = "a sphere at rest stays at rest", kStatic = "the static force is the same at any rate",
                  kReport = "what is reported agrees with the motion", kAir = "there is no force out of contact",
                  kPull = "the ground never pulls", kSunk = "nothing sinks into the ground or passes through it",
                  kEnergy = "there is no energy out of nothing", kUnits = "millimetres and metres give the same motion",
                  kTurn = "a quarter turn of the scene turns the motion",
                  kMirror = "a mirrored scene gives the mirrored motion",
                  kNumbers = "other numbers of triangles and vertices change nothing",
                  kMeet = "nothing passes where faces meet", kOne = "faces that coincide feel like one",
                  kWhole = "a split face feels like the whole", kTwice = "the same run twice gives the same bits",
                  kFresh = "a reset equals a fresh start",
                  kNoNumber = "after a force that is no number and a reset, all is as before",
                  kHuge = "1e30 N move the sphere by as much, or are refused",
                  kVertex = "a vertex that is no number, 0.9 m away, leaves the floor where it is",
                  kTriangle = "a degenerate triangle, 0.9 m away, leaves the floor where it is";

Names failures(const Defect& defect) {
  const SimulatorConformance its = conform_simulator(own_simulator(defect));
  EXPECT_FALSE(its.failure) << *its.failure;
  Names names;
  for (const Invariant& invariant : its.invariants)
    if (invariant.violation) names.insert(invariant.name);
  EXPECT_EQ(names.empty(), its.held());
  return names;
}

bool touches(const World& world) {
  return !world.now.contacts.empty();
}

TEST(planted_simulator_defect, none_is_found_where_there_is_none) {
  EXPECT_EQ(failures({}), Names{});
}

TEST(planted_simulator_defect, number_24_a_force_in_the_frame_of_the_body) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step&) {
                            const double rolled = (world.now.position.x() - world.scene.position.x()) / world.scene.radius;
                            for (Contact& contact : world.now.contacts)
                              contact.normal = Eigen::AngleAxisd(-rolled, Vector3d::UnitY()) * contact.normal;
                          }}),
            (Names{kNormals, kReport}));
}

// At its usual rate it is right.
TEST(planted_simulator_defect, number_28_the_stiffness_depends_on_the_time_step) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step& step) {
                            constexpr double kUsual = 240;
                            world.now.velocity = step.free + kUsual * step.way;
                            for (Contact& contact : world.now.contacts) contact.force *= kUsual / world.scene.rate;
                          }}),
            (Names{kRest, kStatic}));
}

TEST(planted_simulator_defect, number_29_an_impulse_is_reported_as_a_force) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step&) {
                            for (Contact& contact : world.now.contacts) contact.force *= world.scene.step();
                          }}),
            (Names{kStatic, kReport}));
}

// The scenes have no friction, and it has some. Reported with the right sign, that agrees with the motion.
Defect friction(double reported_sign) {
  return {.stepped = [=](World& world, const Step&) {
    if (!touches(world)) return;
    Contact& contact = world.now.contacts.front();
    const Vector3d slip = world.now.velocity - contact.normal.dot(world.now.velocity) * contact.normal;
    if (slip.norm() < 0.1) return;
    const Vector3d friction = -0.05 * contact.force * slip.normalized(),
                   slower = world.scene.step() / world.scene.mass * friction,
                   all = contact.force * contact.normal + reported_sign * friction;
    world.now.velocity += slower;
    world.now.position += world.scene.step() * slower;
    contact = {all.normalized(), all.norm()};
  }};
}

TEST(planted_simulator_defect, number_30_friction_pushes_along_the_slip) {
  EXPECT_EQ(failures(friction(1)), (Names{kSpeed, kGhost, kNormals}));
  EXPECT_EQ(failures(friction(-1)), (Names{kSpeed, kGhost, kNormals, kReport}));
}

// At lines between cells of 16 x 16.
TEST(planted_simulator_defect, inner_edges_of_a_flat_floor_push) {
  const auto cell = [](double x) { return std::floor((x + 0.075) / 0.15); };
  EXPECT_EQ(failures({.stepped =
                          [=](World& world, const Step& step) {
                            const Vector3d &is = world.now.position, &was = step.before.position;
                            if (touches(world) && world.ground.is_flat() &&
                                (cell(is.x()) != cell(was.x()) || cell(is.y()) != cell(was.y())))
                              world.now.velocity *= 0.95;
                          }}),
            (Names{kSpeed, kGhost, kReport, kHuge}));
}

TEST(planted_simulator_defect, contact_in_every_second_step) {
  EXPECT_EQ(failures({.misses = [](const World& world, double) { return world.steps % 2 == 1; }}),
            (Names{kLoad, kRest, kStatic}));
}

TEST(planted_simulator_defect, normals_that_are_reported_are_oblique) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step&) {
                            for (Contact& contact : world.now.contacts) contact.normal.x() += 0.03;
                          }}),
            (Names{kNormals, kTouching, kReport}));
}

TEST(planted_simulator_defect, the_ground_sticks) {
  EXPECT_EQ(failures({.freed =
                          [](const World& world, Vector3d& free) {
                            constexpr double kNear = 1e-4;
                            if (!world.ground.way_out(world.now.position, world.scene.radius + kNear).isZero(0))
                              free.z() = std::min(free.z(), 0.0);
                          }}),
            (Names{kPull, kReport}));
}

TEST(planted_simulator_defect, a_sphere_at_rest_creeps) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step&) {
                            if (touches(world) && world.now.velocity.norm() < 1e-3) world.now.position.x() += 4e-6;
                          }}),
            Names{kRest});
}

// On the other side of a plate, it is pushed on.
TEST(planted_simulator_defect, a_fast_sphere_goes_through) {
  EXPECT_EQ(failures({.misses = [](const World& world, double depth) { return depth >= 0.06 * world.scene.radius; }}),
            (Names{kSunk, kPull, kMeet}));
}

TEST(planted_simulator_defect, an_impact_gives_energy) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step& step) {
                            if (step.free.z() < -1.5) world.now.velocity = step.free + 2.1 * world.scene.rate * step.way;
                          }}),
            (Names{kEnergy, kReport}));
}

TEST(planted_simulator_defect, the_air_resists) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step&) {
                            if (!touches(world)) world.now.velocity *= 0.995;
                          }}),
            (Names{kAir, kPull, kReport}));
}

TEST(planted_simulator_defect, speeds_are_capped_in_units_of_the_scene) {
  EXPECT_EQ(failures({.freed =
                          [](const World& world, Vector3d& free) {
                            const double most = 400 / world.scene.units_per_metre;
                            free = free.cwiseMax(-most).cwiseMin(most);
                          }}),
            (Names{kUnits, kHuge}));
}

// It moves sideways, by what is little in a step, where this holds.
Names failures_of_drift(const std::function<bool(const World&)>& is_moved) {
  return failures({.stepped = [&](World& world, const Step&) {
    if (is_moved(world)) world.now.position.y() += 1e-5;
  }});
}

TEST(planted_simulator_defect, one_direction_is_another_one) {
  EXPECT_EQ(failures_of_drift([](const World& world) { return world.now.velocity.y() > 0.7; }), Names{kTurn});
  EXPECT_EQ(failures_of_drift([](const World& world) { return world.now.velocity.y() < -0.1; }), Names{kMirror});
}

TEST(planted_simulator_defect, the_motion_depends_on_the_order_of_triangles) {
  EXPECT_EQ(failures_of_drift([](const World& world) {
              const auto* mesh = std::get_if<GroundMesh>(&world.scene.ground);
              return mesh != nullptr && mesh->triangles[0][0] > 0;
            }),
            Names{kNumbers});
}

TEST(planted_simulator_defect, a_reset_leaves_the_velocity) {
  EXPECT_EQ(failures({.reset = [](World& world, const State& before) { world.now.velocity = before.velocity; }}),
            (Names{kFresh, kHuge}));
}

TEST(planted_simulator_defect, a_draw_that_is_never_the_same) {
  std::mt19937_64 random(1);
  EXPECT_EQ(failures({.stepped = [&](World& world,
                                     const Step&) { world.now.velocity *= 1 + 1e-13 * static_cast<double>(random() % 8); }}),
            (Names{kTwice, kFresh}));
}

TEST(planted_simulator_defect, a_force_that_is_no_number_is_taken) {
  EXPECT_EQ(failures({.takes_any_force = true}), Names{kNoNumber});
}

TEST(planted_simulator_defect, a_vertex_that_is_no_number_takes_the_floor_away) {
  EXPECT_EQ(failures({.opened = [](World& world) { world.refusal.reset(); }}), Names{kVertex});
}

TEST(planted_simulator_defect, a_degenerate_triangle_takes_the_floor_away) {
  EXPECT_EQ(failures({.opened =
                          [](World& world) {
                            const auto* mesh = std::get_if<GroundMesh>(&world.scene.ground);
                            if (mesh == nullptr) return;
                            if (const auto& last = mesh->triangles.back(); last[0] == last[1]) world.ground = {};
                          }}),
            Names{kTriangle});
}

TEST(planted_simulator_defect, a_vertex_that_is_no_number_ends_it) {
  EXPECT_EQ(failures({.opened =
                          [](World& world) {
                            if (world.refusal) throw files::ProcessFailed("it ended");
                          }}),
            Names{kVertex});
}

TEST(planted_simulator_defect, the_first_contact_has_a_force_that_is_no_number) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step& step) {
                            if (touches(world) && step.before.contacts.empty())
                              world.now.contacts[0].force = std::numeric_limits<double>::quiet_NaN();
                          }}),
            (Names{kFinite, kTouching, kReport}));
}

TEST(planted_simulator_defect, a_sphere_falls_through_the_spine_of_a_book) {
  EXPECT_EQ(failures({.misses =
                          [](const World& world, double) {
                            return world.scene.name.starts_with("a book") && std::abs(world.now.position.x()) < 0.05;
                          }}),
            Names{kMeet});
}

TEST(planted_simulator_defect, faces_that_coincide_push_twice) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step& step) {
                            if (world.scene.name.ends_with("each triangle twice"))
                              world.now.velocity += world.scene.rate * step.way;
                          }}),
            Names{kOne});
}

TEST(planted_simulator_defect, a_sphere_stumbles_where_a_face_is_split) {
  EXPECT_EQ(failures({.stepped =
                          [](World& world, const Step& step) {
                            const bool is_split = world.scene.name.ends_with("in two");
                            if (is_split && touches(world) && world.now.position.x() > 0 && step.before.position.x() <= 0)
                              world.now.velocity *= 0.95;
                          }}),
            Names{kWhole});
}

TEST(simulators, one_that_refuses_every_scene_has_held_nothing) {
  const SimulatorConformance its =
      conform_simulator(own_simulator({.opened = [](World& world) { world.refusal = "no licence"; }}));
  EXPECT_FALSE(its.failure);
  EXPECT_FALSE(its.held());
  EXPECT_EQ(its.invariants.size(), 26U);
  for (const Invariant& invariant : its.invariants) EXPECT_EQ(invariant.not_applicable, "no licence") << invariant.name;
}

TEST(simulators, one_that_reports_no_contacts_is_not_asked_whether_they_agree_with_the_motion) {
  const auto its = conform_simulator(own_simulator({.reports = SimulatorCapabilities::Reports::nothing}));
  const auto asked = std::ranges::find(its.invariants, kReport, &Invariant::name);
  ASSERT_NE(asked, its.invariants.end());
  EXPECT_EQ(asked->not_applicable, "it reports no contacts");
}

TEST(simulators, one_that_ends_where_nothing_is_hostile_ends_the_check) {
  const SimulatorConformance its = conform_simulator(own_simulator({.opened = [](World& world) {
    if (world.ground.is_flat()) return;
    throw files::ProcessFailed("it ended");
  }}));
  EXPECT_EQ(its.failure, "it ended");
  EXPECT_FALSE(its.held());
}

TEST(simulators, two_numbers_are_printed_in_as_many_digits_as_show_that_they_differ) {
  EXPECT_EQ(measured_instead_of(1, 0.97, "N"), "0.97 N instead of 1 N");
  EXPECT_EQ(measured_instead_of(1, 1.0002318, "m/s"), "1.00023 m/s instead of 1 m/s");
  EXPECT_EQ(measured_instead_of(1, 1, "N"), "1 N instead of 1 N");
  EXPECT_EQ(measured_instead_of(0, 2, "N"), "2 N instead of 0 N");
  EXPECT_EQ(measured_instead_of(1, std::nextafter(1, 2), "N"), "1.0000000000000002 N instead of 1 N");
}

}  // namespace
}  // namespace forceshade::conformance::simulators
