// SPDX-License-Identifier: BSD-3-Clause
// Positions that no hand has, and what comes after them.

#include <cmath>
#include <limits>

#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"

namespace forceshade::conformance {
namespace {

using properties::show;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kLongest = 0.010;  // s: for which the last force may be held

// Each odd number in each coordinate of a position, beside the z axis and on it.
Path odd_positions() {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  Path all;
  for (const float number : {kNan, kInfinite, -kInfinite, 1e26F, -1e26F, std::numeric_limits<float>::denorm_min(),
                             std::numeric_limits<float>::max()})
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (const float beside : {1.0F, 0.0F}) {
        all.emplace_back(beside, beside, -0.5F);
        all.back()[axis] = number;
      }
  return all;
}

}  // namespace

Invariant any_position_gets_a_finite_force(const Trial& trial) {
  Invariant invariant{"any position gets a finite force"};
  for (const Eigen::Vector3f& position : odd_positions()) {
    const Path forces = trial.renderer.forces_along(Path{position});
    ++invariant.cases;
    if (!forces[0].allFinite())
      invariant.violated("at " + show(position) + " mm the force is " + show(forces[0]) +
                         " N: a device gets no force, the last one, or its largest");
  }
  return invariant;
}

// From the air into contact, with an odd position before, gives the force that comes without it.
Invariant odd_position_leaves_nothing_behind(const Trial& trial) {
  Invariant invariant{"an odd position leaves nothing behind"};
  const std::span<const Approach> all = trial.first_approaches(3);
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all) {
    // In the air the speed of the jump is forgotten.
    Path line(trial.settling(), approach.air);
    for (const Eigen::Vector3f& position : approach.line(trial.renderer, 4)) line.push_back(position);
    const Eigen::Vector3f expected = trial.renderer.forces_along(line).back();
    for (const Eigen::Vector3f& odd : odd_positions()) {
      Path path{approach.air, odd};
      path.insert(path.end(), line.begin(), line.end());
      const Eigen::Vector3f force = trial.renderer.forces_along(path).back();
      ++invariant.cases;
      if (!same_bits(force, expected))
        invariant.violated("after " + show(odd) + " mm, and then from the air at " + show(approach.air) + " mm to " +
                           show(approach.contact) + " mm, the force is " + show(force) + " N, and without it " +
                           show(expected) + " N: a hand would feel " + newtons(force - expected));
    }
  }
  return invariant;
}

// A device that has lost its position passes NaN on.
Invariant no_position_no_force(const Trial& trial) {
  Invariant invariant{"without a position there is no force after 10 ms"};
  const auto& hello = trial.renderer.hello();
  const auto held = hello.remembers && hello.rate ? static_cast<std::size_t>(std::ceil(kLongest * *hello.rate)) : 0;
  const std::span<const Approach> all = trial.first_approaches(5);
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all) {
    Path path{approach.air, approach.contact};
    path.resize(path.size() + held + 10, Eigen::Vector3f::Constant(kNan));
    const Path forces = trial.renderer.forces_along(path);
    ++invariant.cases;
    for (std::size_t i = 2 + held; i < forces.size(); ++i)
      if (!forces[i].isZero(0))
        invariant.violated("in contact at " + show(approach.contact) + " mm, then " + std::to_string(i - 1) +
                           " positions that are no numbers: the force is " + show(forces[i]) + " N: a hand would feel " +
                           newtons(forces[i]) + " from a device that does not know where it is");
  }
  return invariant;
}

}  // namespace forceshade::conformance
