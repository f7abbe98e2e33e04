// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "files/csv.h"

namespace forceshade::conformance::simulators {
namespace {

using Forces = std::vector<Eigen::Vector3d>;
constexpr std::size_t kMostForces = 1024;  // in a line of the protocol

State beginning(const Course& course) {
  return {course.scene.position, course.scene.velocity};
}

std::optional<std::string> refusal_of(const Course& course, const SimulatorCapabilities& its) {
  const double fastest = course.scene.velocity.norm();
  if (its.refusal) return its.refusal;
  if (course.scene.radius < its.smallest_radius) return "its smallest radius is " + shortest(its.smallest_radius) + " m";
  if (its.speed_cap && fastest > *its.speed_cap) return "its largest speed is " + shortest(*its.speed_cap) + " m/s";
  return std::nullopt;
}

// From a reset, unless the simulator was opened just now.
Run run_with(SimulatorUnderTest& simulator, const Course& course, const Forces& forces, bool is_reset) {
  Run run{course, simulator.capabilities(), {beginning(course)}, refusal_of(course, simulator.capabilities())};
  for (std::size_t begin = 0; begin < forces.size() && !run.refusal; begin += kMostForces) {
    const std::size_t size = std::min(kMostForces, forces.size() - begin);
    Motion motion = simulator.apply(std::span(forces).subspan(begin, size), is_reset && begin == 0);
    run.refusal = motion.refusal;
    std::ranges::move(motion.states, std::back_inserter(run.states));
  }
  return run;
}

Forces pushes(const Course& course) {
  return Forces(course.steps, course.push);
}

}  // namespace

Eigen::Vector3d Run::shown_force(std::size_t k) const {
  return course.scene.mass * course.scene.rate * (states[k].velocity - states[k - 1].velocity) - course.force();
}

Eigen::Vector3d Run::reported_force(std::size_t k) const {
  Eigen::Vector3d sum(0, 0, 0);
  for (const Contact& contact : states[k].contacts) sum += contact.force * contact.normal;
  return sum;
}

double Run::energy(std::size_t k) const {
  return course.scene.mass / 2 * states[k].velocity.squaredNorm() - course.force().dot(states[k].position);
}

double Run::fastest(std::size_t until_k) const {
  double speed = 0;
  for (std::size_t k = 0; k <= until_k; ++k) speed = std::max(speed, states[k].velocity.norm());
  return speed;
}

double Run::clearance(std::size_t k) const {
  return nearest(course.profile, states[k].position).distance - course.scene.radius;
}

const Run& Bench::run(const Course& course) {
  const auto found = std::ranges::find(runs_, course, &Run::course);
  return found != runs_.end() ? *found : runs_.emplace_back(run_anew(course));
}

Run Bench::run_anew(const Course& course) const {
  const std::unique_ptr<SimulatorUnderTest> simulator = open_(course.scene);
  Run run = run_with(*simulator, course, pushes(course), false);
  simulator->say_goodbye();
  return run;
}

Run Bench::run_after_reset(const Course& course) const {
  const Eigen::Vector3d other(5, 3, 0);  // N
  return run_disturbed(course, course.steps / 2, other).after_reset;
}

Bench::Disturbed Bench::run_disturbed(const Course& course, std::size_t step, const Eigen::Vector3d& force) const {
  const std::unique_ptr<SimulatorUnderTest> simulator = open_(course.scene);
  Forces forces = pushes(course);
  forces[step - 1] = force;
  Run disturbed = run_with(*simulator, course, forces, false);
  Run after = run_with(*simulator, course, pushes(course), true);
  simulator->say_goodbye();
  return {std::move(disturbed), std::move(after)};
}

}  // namespace forceshade::conformance::simulators
