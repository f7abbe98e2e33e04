// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/invariants_of_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "properties/conformance/simulators/course.h"

namespace forceshade::conformance::simulators {
namespace {

constexpr double kMillijoules = 1000;  // in a joule

using From = StepInvariant::From;

// The larger one; what is no number is larger than any.
const Felt& larger(const Felt& one, const Felt& other) {
  return std::isnan(one.value) || one.value > other.value ? one : other;
}

Felt speed_on_a_plane(const Run& run, std::size_t k) {
  const Course& course = run.course;
  const Eigen::Vector3d truth = course.scene.velocity + course.along_ground(course.force()) / course.scene.mass *
                                                            (course.scene.step() * static_cast<double>(k));
  const Eigen::Vector3d is = course.along_ground(run.states[k].velocity);
  const double gained = course.scene.mass / 2 * (is.squaredNorm() - truth.squaredNorm());
  return {(is - truth).norm(), kShare * std::max(kLeastSpeed, truth.norm()),
          measured((is - truth).norm(), "m/s off: ") + measured_instead_of(truth.norm(), is.norm(), "m/s") +
              (gained < 0 ? ", a loss of " : ", a gain of ") + measured(kMillijoules * std::abs(gained), "mJ")};
}

Felt force_of_a_plane(const Run& run, std::size_t k) {
  const double load = run.course.load(), is = run.course.normal().dot(run.shown_force(k));
  return {std::abs(is - load), kShare * load, measured_instead_of(load, is, "N")};
}

Felt sideways(const Run& run, std::size_t k) {
  return felt_newtons(run.course.along_ground(run.shown_force(k)).norm(), kShare * run.course.load(), "sideways");
}

// The force that a normal that is not the plane's own adds sideways, were the whole load on it.
Felt reported_normals(const Run& run, std::size_t k) {
  const double load = run.course.load();
  Felt worst = felt_newtons(0, kShare * load, "sideways");
  for (const Contact& contact : run.states[k].contacts) {
    if (std::abs(contact.force) <= kShare * load) continue;
    const double angle = std::acos(std::clamp(contact.normal.normalized().dot(run.course.normal()), -1.0, 1.0));
    const double share = (contact.normal - run.course.normal()).norm();
    worst = larger(
        felt_newtons(load * share, kShare * load,
                     "beside the true force, in a direction " + measured(180 / std::numbers::pi * angle, "degrees") + " off"),
        worst);
  }
  return worst;
}

Felt touching_exactly(const Run& run, std::size_t k) {
  return larger(sideways(run, k), felt_newtons(run.course.along_ground(run.reported_force(k)).norm(),
                                               kShare * run.course.load(), "sideways, as it reports"));
}

Felt moved_at_rest(const Run& run, std::size_t k) {
  const double moved = (run.states[k].position - run.states[run.course.settled()].position).norm(),
               along = run.course.along_ground(run.states[k].position - run.states[0].position).norm();
  return felt_millimetres(std::max(moved, along), kPath, "moved at rest");
}

Felt static_force(const Run& run, std::size_t k) {
  const double load = run.course.load(), is = run.course.normal().dot(run.reported_force(k));
  return {std::abs(is - load), kShare * load, "it reports " + measured_instead_of(load, is, "N")};
}

Felt report_and_motion(const Run& run, std::size_t k) {
  const Eigen::Vector3d shown = run.shown_force(k), reported = run.reported_force(k);
  return {(reported - shown).norm(), kShare * std::max(run.course.force().norm(), shown.norm()),
          "it reports " + measured(reported.norm(), "N") + ", and the motion shows " + measured(shown.norm(), "N") + ", " +
              measured((reported - shown).norm(), "N apart")};
}

Felt force_in_the_air(const Run& run, std::size_t k) {
  const double allowed = kShare * run.course.scene.mass * run.course.scene.gravity.norm();
  if (run.clearance(k - 1) <= kClear || run.clearance(k) <= kClear) return felt_newtons(0, allowed, "in the air");
  return larger(felt_newtons(run.shown_force(k).norm(), allowed, "in the air, as the motion shows"),
                felt_newtons(run.reported_force(k).norm(), allowed, "in the air, as it reports"));
}

Felt pull(const Run& run, std::size_t k) {
  const double allowed = kShare * run.course.scene.mass * run.course.scene.gravity.norm();
  Felt worst =
      felt_newtons(std::max(0.0, -run.shown_force(k).dot(nearest(run.course.profile, run.states[k - 1].position).normal)),
                   allowed, "towards the ground");
  for (const Contact& contact : run.states[k].contacts)
    worst = larger(felt_newtons(std::max(0.0, -contact.force), allowed, "towards the ground, as it reports"), worst);
  return worst;
}

// A step of its motion may be in the ground before a contact is found. One that is not hard gives way until it has come to
// rest.
Felt sunk(const Run& run, std::size_t k) {
  const bool is_looked_at = run.simulator.constraint == SimulatorCapabilities::Constraint::hard || k + 1 == run.states.size();
  return felt_millimetres(is_looked_at ? std::max(0.0, -run.clearance(k)) : 0, kPath + run.fastest(k) * run.course.scene.step(),
                          "in the ground");
}

Felt energy_gained(const Run& run, std::size_t k) {
  const double kinetic = run.course.scene.mass / 2 * run.fastest(k) * run.fastest(k),
               allowed = kEnergyShare * kinetic + kPath * run.course.force().norm(),
               gained = std::max(0.0, run.energy(k) - run.energy(0));
  return {gained, allowed,
          measured(kMillijoules * gained, "mJ out of nothing, allowed ") + measured(kMillijoules * allowed, "mJ")};
}

Felt finite(const Run& run, std::size_t k) {
  bool is_finite = run.states[k].position.allFinite() && run.states[k].velocity.allFinite();
  for (const Contact& contact : run.states[k].contacts)
    is_finite = is_finite && contact.normal.allFinite() && std::isfinite(contact.force);
  return {is_finite ? 0.0 : 1.0, 0, is_finite ? "only numbers" : "an answer that is no number"};
}

Courses static_courses() {
  Courses all;
  for (const double rate : {60, 120, 240, 480, 960})
    for (const Course& course : static_at(rate)) all.push_back(course);
  return all;
}

Courses joined_courses(std::initializer_list<Courses> some) {
  Courses all;
  for (const Courses& courses : some) all.insert(all.end(), courses.begin(), courses.end());
  return all;
}

}  // namespace

std::vector<StepInvariant> step_invariants() {
  return {{"every answer is a finite number", all_courses(), From::beginning, false, finite},
          {"a flat floor keeps the speed, however it is triangulated", slides(), From::beginning, false, speed_on_a_plane},
          {"a flat floor pushes with what lies on it, however it is triangulated", slides(), From::settled, false,
           force_of_a_plane},
          {"a flat floor has no ghost forces at inner edges", slides(), From::beginning, false, sideways},
          {"the normals that are reported on a flat floor are its own", slides(), From::beginning, true, reported_normals},
          {"a sphere that touches exactly is pushed along the normal", rests(), From::beginning, false, touching_exactly},
          {"a sphere at rest stays at rest", joined_courses({rests(), static_courses()}), From::settled, false, moved_at_rest},
          {"the static force is the same at any rate", static_courses(), From::settled, true, static_force},
          {"what is reported agrees with the motion", all_courses(), From::beginning, true, report_and_motion},
          {"there is no force out of contact", joined_courses({drops(), leaves(), obstacles()}), From::beginning, false,
           force_in_the_air},
          {"the ground never pulls", all_courses(), From::beginning, false, pull},
          {"nothing sinks into the ground or passes through it", all_courses(), From::beginning, false, sunk},
          {"nothing passes where faces meet", meetings(), From::beginning, false, sunk},
          {"there is no energy out of nothing", all_courses(), From::beginning, false, energy_gained}};
}

}  // namespace forceshade::conformance::simulators
