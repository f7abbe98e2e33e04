// SPDX-License-Identifier: BSD-3-Clause
// A request that is repeated gets the same answer.

#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"

namespace forceshade::conformance {
namespace {

using properties::show;

constexpr std::size_t kPathSize = 1500;  // more than one request
constexpr std::size_t kTicksAtRest = 100, kSettling = 10;

Invariant compared(const std::string& name, const Path& path, const Path& one, const Path& other, const std::string& when) {
  Invariant invariant{name, path.size()};
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!same_bits(one[i], other[i]))
      invariant.violated("at " + show(path[i]) + " mm, position " + std::to_string(i) + " of the path: " + show(one[i]) +
                         " N, and " + when + ' ' + show(other[i]) + " N: a hand would feel " + newtons(one[i] - other[i]) +
                         " without having moved otherwise");
  return invariant;
}

}  // namespace

Invariant same_path_twice(const Trial& trial) {
  const Path path = drawn_path(trial, kPathSize, trial.seed + 1);
  const Path first = trial.renderer.forces_along(path);
  return compared("the same path twice gives the same bits", path, first, trial.renderer.forces_along(path), "the second time");
}

Invariant reset_equals_fresh_start(const Trial& trial) {
  const Path path = drawn_path(trial, kPathSize, trial.seed + 1);
  SceneRenderer fresh = trial.open(trial.description);
  const Path first = fresh.forces_along(path);
  fresh.say_goodbye();
  return compared("a reset equals a fresh start", path, trial.renderer.forces_along(path), first, "opened anew");
}

// A god-object comes to rest within some ticks at a place, and a hand comes into contact from the air.
Invariant rest_is_still(const Trial& trial) {
  Invariant invariant{"a hand at rest feels a force at rest"};
  if (trial.moves()) {
    invariant.not_applicable = "the objects move";
    return invariant;
  }
  std::vector<Path> ways;
  for (const Eigen::Vector3f& position : drawn_path(trial, 20, trial.seed + 1)) ways.push_back({position});
  for (const Approach& approach : trial.first_approaches(10)) ways.push_back(approach.line(trial.renderer, 20));
  for (Path way : ways) {
    const Eigen::Vector3f position = way.back();
    const std::size_t first = way.size() + kSettling + trial.settling();
    way.resize(way.size() + kTicksAtRest + trial.settling(), position);
    const Path forces = trial.renderer.forces_along(way);
    ++invariant.cases;
    for (std::size_t tick = first; tick < forces.size(); ++tick)
      if (!same_bits(forces[tick], forces[first]))
        invariant.violated("at " + show(position) + " mm, tick " +
                           std::to_string(tick - first + kSettling + trial.settling() + 1) +
                           " of a rest: " + show(forces[first]) + " N became " + show(forces[tick]) +
                           " N: a hand at rest would feel " + newtons(forces[tick] - forces[first]));
  }
  return invariant;
}

}  // namespace forceshade::conformance
