// SPDX-License-Identifier: BSD-3-Clause
// Invariants of contact: no force before it, one that opposes the hand at its beginning, no energy over a path that closes.

#include <algorithm>
#include <cmath>

#include "files/csv.h"
#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"

namespace forceshade::conformance {
namespace {

using properties::show;

constexpr int kApproachSteps = 60;    // of a straight way into contact
constexpr int kLoopSteps = 500;       // of one side of a loop
constexpr float kLeastForce = 1e-3F;  // N: of a contact that can be felt
constexpr double kLeastWork = 1e-3;   // mJ: what rounding gives

// From the air into contact, along it, out, and back through the air; the renderer's writable positions.
Path loop(const SceneRenderer& renderer, const Approach& here, const Eigen::Vector3f& along, int steps) {
  Path path;
  const auto side = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    for (int i = 0; i < steps; ++i)
      path.push_back(renderer.writable(from + static_cast<float>(i) / static_cast<float>(steps) * (to - from)));
  };
  side(here.air, here.contact);
  side(here.contact, here.contact + along);
  side(here.contact + along, here.air + along);
  side(here.air + along, here.air);
  path.push_back(here.air);
  return path;
}

// By the trapezoid rule, of the force on the hand, mJ.
double work(const Path& path, const Path& forces) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    sum += 0.5 * (forces[i] + forces[i - 1]).cast<double>().dot((path[i] - path[i - 1]).cast<double>());
  return sum;
}

}  // namespace

Invariant no_force_in_the_air(const Trial& trial) {
  Invariant invariant{"no force out of contact"};
  const std::span<const Approach> all = trial.approaches;
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all) {
    const Path path{approach.air, approach.contact, approach.air, approach.air};  // also after a contact
    const Path forces = trial.renderer.forces_along(path);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      ++invariant.cases;
      if (!forces[i].isZero(0))
        invariant.violated("at " + show(path[i]) + " mm, in the air" + (i == 3 ? " after a contact" : "") + ", the force is " +
                           show(forces[i]) + " N: a hand would feel " + newtons(forces[i]) + " from nothing");
    }
  }
  return invariant;
}

// Along a straight way, and in one jump.
Invariant contact_pushes_back(const Trial& trial) {
  Invariant invariant{"contact gives a force"};
  const std::span<const Approach> all = trial.approaches;
  for (const Approach& approach : all) {
    const auto exact = trial.subject.open_reference();
    exact->step(approach.air);
    if (exact->step(approach.contact).force.norm() < kLeastForce) continue;
    for (const int steps : {kApproachSteps, 1}) {
      const Path forces = trial.renderer.forces_along(approach.line(trial.renderer, steps));
      ++invariant.cases;
      if (!differ(forces.back(), {0, 0, 0}))
        invariant.violated("from " + show(approach.air) + " to " + show(approach.contact) + " mm in " + std::to_string(steps) +
                           (steps == 1 ? " step" : " steps") + " the force is " + show(forces.back()) +
                           " N: a hand would go through the surface");
    }
  }
  if (invariant.cases == 0) invariant.not_applicable = trial.why_no_approach();
  return invariant;
}

// It may be turned by shading, on a mesh by up to a right angle.
Invariant first_force_opposes(const Trial& trial) {
  Invariant invariant{"the surface does not attract: the first force of a contact opposes the hand"};
  if (const auto* mesh = std::get_if<MeshRendering>(&trial.description.what); mesh && mesh->shading != mesh::Shading::none) {
    invariant.not_applicable = "a shaded force on a mesh may be turned by up to a right angle";
    return invariant;
  }
  const std::span<const Approach> all = trial.approaches;
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all) {
    const Path path = approach.line(trial.renderer, kApproachSteps), forces = trial.renderer.forces_along(path);
    const auto first = std::ranges::find_if(forces, [](const Eigen::Vector3f& force) { return !force.isZero(0); });
    ++invariant.cases;
    if (first == forces.end()) continue;  // it penetrates, which is for the definition to say
    const Eigen::Vector3f onward = (approach.contact - approach.air).normalized();
    if (const float pull = first->dot(onward); pull > 1e-4F)
      invariant.violated("on the way from " + show(approach.air) + " to " + show(approach.contact) + " mm, at " +
                         show(path[static_cast<std::size_t>(first - forces.begin())]) + " mm, the first force is " +
                         show(*first) + " N: a hand would be pulled in with " + shortest(pull) + " N");
  }
  return invariant;
}

// The work of the definition itself along a path, rounded once in each place.
double work_of_definition(const Trial& trial, const Path& path) {
  const auto session = trial.subject.open_reference();
  std::vector<Eigen::Vector3f> forces;
  for (const Eigen::Vector3f& position : path) forces.push_back(session->step(position).force);
  return work(path, forces);
}

// Twice as many steps tell how exact the sum is. Active laws, such as shaded ones, give energy: as much is allowed to a
// renderer that claims the definition.
Invariant loops_give_no_energy(const Trial& trial) {
  Invariant invariant{"a closed path gives no more energy than declared"};
  const auto declared = trial.renderer.hello().loop_energy;
  if (!declared) {
    invariant.not_applicable = "the renderer declares that it may be any";
    return invariant;
  }
  const std::span<const Approach> all = trial.first_approaches(5);
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all)
    for (const float along : {3.0F, -3.0F}) {
      const auto work_of = [&](int steps) {
        const Path path = loop(trial.renderer, approach, {along, 0, 0}, steps);
        return work(path, trial.renderer.forces_along(path));
      };
      const double coarse = work_of(kLoopSteps), fine = work_of(2 * kLoopSteps);
      ++invariant.cases;
      trial.monitor.at(0.97);
      const double slack = 2 * std::abs(fine - coarse) + kLeastWork;
      if (fine <= *declared + slack) continue;
      const double its = work_of_definition(trial, loop(trial.renderer, approach, {along, 0, 0}, 2 * kLoopSteps));
      if (trial.renderer.hello().claims_definition && fine <= its + slack) continue;
      const bool is_active = its > *declared + kLeastWork;
      invariant.violated("in at " + show(approach.contact) + " mm, " + shortest(along) + " mm along x, out and back to " +
                         show(approach.air) + " mm gives " + shortest(fine) + " mJ (" + shortest(coarse) +
                         " mJ in half as many steps): a hand that goes round gets as much each time" +
                         (is_active ? "; the definition itself gives " + shortest(its) +
                                          " mJ here: declare null, or at least the most that it gives"
                                    : ""));
    }
  return invariant;
}

}  // namespace forceshade::conformance
