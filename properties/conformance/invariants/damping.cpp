// SPDX-License-Identifier: BSD-3-Clause
// Invariants of damping (docs/damping.md): it lets go, begins and rests without a step, and knows the time between positions.

#include <algorithm>
#include <cmath>

#include "files/csv.h"
#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"
#include "properties/conformance/strokes.h"

namespace forceshade::conformance {
namespace {

using properties::show;

constexpr std::array kSpeeds{1.0F, 10.0F, 100.0F, 1000.0F};  // mm/s
constexpr float kLeastPull = 1e-4F, kLeastStep = 0.01F;      // N, that a hand could notice

const damping::Parameters& parameters_of(const Trial& trial) {
  return *trial.renderer.hello().damping;
}

std::string with_unit(float speed) {
  return shortest(speed) + " mm/s";
}

Eigen::Vector3f direction_of(const Approach& approach) {
  return (approach.contact - approach.air).normalized();
}

// The last ticks of a steady way along an approach that ends at a position.
Path way_to(const Trial& trial, const Approach& approach, const Eigen::Vector3f& end, float speed, int ticks) {
  const Eigen::Vector3f step = speed / parameters_of(trial).rate * direction_of(approach);
  Path path;
  for (int to_go = ticks; to_go > 0; --to_go) path.push_back(trial.renderer.writable(end - static_cast<float>(to_go) * step));
  path.push_back(end);
  return path;
}

Path with_rest(const Trial& trial, Path path) {
  path.resize(path.size() + trial.settling(), path.back());
  return path;
}

// The springs of the definition along a path.
std::vector<reference::Rounded> springs_along(const Trial& trial, const Path& path) {
  const auto session = trial.subject.open_reference();
  std::vector<reference::Rounded> springs;
  for (const Eigen::Vector3f& position : path) springs.push_back(session->step(position));
  return springs;
}

// The invariant with what is looked at for some approaches at each speed.
template <class Look>
Invariant looked_at(const Trial& trial, const std::string& name, const Look& look) {
  Invariant invariant{name};
  const std::span<const Approach> all = trial.first_approaches(5);
  if (all.empty()) invariant.not_applicable = trial.why_no_approach();
  for (const Approach& approach : all)
    for (const float speed : kSpeeds) {
      trial.monitor.at(0.98);
      ++invariant.cases;
      look(invariant, approach, speed);
    }
  return invariant;
}

// The farthest position of an approach that the definition has free, and 1 µm more.
std::optional<Eigen::Vector3f> just_in_contact(const Trial& trial, const Approach& approach) {
  const auto touches = [&](const Eigen::Vector3f& position) {
    return finished(springs_along(trial, {approach.air, position}).back().status) == Status::contact;
  };
  const Eigen::Vector3f way = approach.contact - approach.air;
  float free = 0, contact = 1;
  for (int halving = 0; halving < 24; ++halving) {
    const float middle = (free + contact) / 2;
    (touches(trial.renderer.writable(approach.air + middle * way)) ? contact : free) = middle;
  }
  const Eigen::Vector3f position = trial.renderer.writable(approach.air + contact * way + 1e-3F * direction_of(approach));
  return touches(position) ? std::optional(position) : std::nullopt;
}

}  // namespace

Invariant leaving_does_not_pull(const Trial& trial) {
  return looked_at(trial, "the damper lets go: a hand that leaves is not pulled back",
                   [&](Invariant& invariant, const Approach& approach, float speed) {
                     Path path = with_rest(trial, approach.line(trial.renderer, 20));
                     const Path out = way_to(trial, {approach.contact, approach.air}, approach.air, speed,
                                             std::min(2000, static_cast<int>((approach.contact - approach.air).norm() *
                                                                             parameters_of(trial).rate / speed)));
                     path.insert(path.end(), out.begin(), out.end());
                     const Path forces = trial.renderer.forces_along(path);
                     const auto springs = springs_along(trial, path);
                     for (std::size_t i = path.size() - out.size(); i < path.size(); ++i) {
                       const Eigen::Vector3f& spring = springs[i].force;
                       if (spring.isZero(0) || !(forces[i].dot(spring.normalized()) < -kLeastPull)) continue;
                       invariant.violated("leaving at " + with_unit(speed) + ", at " + show(path[i]) + " mm, the force is " +
                                          show(forces[i]) + " N, and the spring's " + show(spring) +
                                          " N: a hand would stick to the surface");
                     }
                   });
}

// With a limit of what damping adds.
Invariant landing_has_no_step(const Trial& trial) {
  const damping::Parameters& p = parameters_of(trial);
  Invariant unlimited{"a landing begins without a step"};
  unlimited.not_applicable = "it declares no limit of the damped force beside the spring's, and so a step";
  if (std::isinf(p.most)) return unlimited;
  return looked_at(trial, unlimited.name, [&](Invariant& invariant, const Approach& approach, float speed) {
    const auto end = just_in_contact(trial, approach);
    if (!end) return;
    const Path path = way_to(trial, approach, *end, speed, std::min(200, static_cast<int>(3 / p.share) + 1));
    const Eigen::Vector3f force = trial.renderer.forces_along(path).back();
    const float spring = springs_along(trial, path).back().force.norm();
    const float most = p.most * spring + p.drag * speed * std::min(1.0F, p.most * spring * spring / (p.full_at * p.full_at));
    if (!(force.norm() <= most + kLeastStep))
      invariant.violated("at " + with_unit(speed) + " the first force, at " + show(*end) + " mm, is " + show(force) +
                         " N, and the spring's length " + shortest(spring) + " N: a hand would feel a blow");
  });
}

// Whoever claims the definition gives the spring's force then.
Invariant rest_is_without_damping(const Trial& trial) {
  return looked_at(trial, "at rest damping adds nothing, however the hand came",
                   [&](Invariant& invariant, const Approach& approach, float speed) {
                     const Path fast = with_rest(trial, way_to(trial, approach, approach.contact, speed, 20)),
                                slow = with_rest(trial, approach.line(trial.renderer, 200));
                     const Eigen::Vector3f force = trial.renderer.forces_along(fast).back();
                     const Eigen::Vector3f expected = trial.renderer.hello().claims_definition
                                                          ? springs_along(trial, fast).back().force
                                                          : trial.renderer.forces_along(slow).back();
                     if (differ(force, expected))
                       invariant.violated("at rest at " + show(approach.contact) + " mm after " + with_unit(speed) +
                                          " the force is " + show(force) + " N, not " + show(expected) +
                                          " N: a hand at rest would be pushed by its former speed");
                   });
}

Invariant pause_leaves_no_speed(const Trial& trial) {
  const std::string name = "after a pause no speed is left";
  return looked_at(trial, name, [&](Invariant& invariant, const Approach& approach, float speed) {
    Path path = way_to(trial, approach, approach.air, speed, 20), rested{approach.air, approach.contact};
    path.push_back(approach.contact);
    std::vector<std::uint32_t> periods(path.size(), 1);
    periods.back() = kPause;
    const Eigen::Vector3f force = trial.renderer.forces_along(path, periods).back(),
                          expected = trial.renderer.forces_along(with_rest(trial, rested)).back();
    if (differ(force, expected))
      invariant.violated("after " + with_unit(speed) + " and " + std::to_string(kPause) + " periods without a position, at " +
                         show(approach.contact) + " mm, the force is " + show(force) + " N, and at rest there " +
                         show(expected) + " N: a hand would be pushed by a speed that it had before the pause");
  });
}

Invariant missed_positions_are_even(const Trial& trial) {
  constexpr int kTicks = 24;
  constexpr std::uint32_t kEach = 3;  // of which one is read
  const std::string name = "missed positions count as evenly spaced";
  return looked_at(trial, name, [&](Invariant& invariant, const Approach& approach, float speed) {
    const Path all = way_to(trial, approach, approach.contact, speed, kTicks);
    Path some;
    for (std::size_t i = 0; i < all.size(); i += kEach) some.push_back(all[i]);
    const Eigen::Vector3f expected = trial.renderer.forces_along(all).back(),
                          force = trial.renderer.forces_along(some, std::vector(some.size(), kEach)).back();
    // Positions are rounded, so that their speed is not quite even.
    const float rounding =
        parameters_of(trial).larger() * parameters_of(trial).rate * 0x1p-22F * all.front().cwiseAbs().maxCoeff();
    if (differ(force, expected) && !((force - expected).norm() <= rounding))
      invariant.violated("at " + with_unit(speed) + " to " + show(approach.contact) + " mm the force is " + show(force) +
                         " N where one of " + std::to_string(kEach) + " positions is read, and " + show(expected) +
                         " N where all are: a hand would feel each that is missed");
  });
}

// Two ways differ in one position: the speeds at their end differ by the filter's share, twice, of the difference's speed.
Invariant one_position_counts_by_share(const Trial& trial) {
  constexpr int kTicks = 60;
  return looked_at(
      trial, "one position changes damping by the filter's share alone",
      [&](Invariant& invariant, const Approach& approach, float speed) {
        const damping::Parameters& p = parameters_of(trial);
        const Path even = way_to(trial, approach, approach.contact, speed, kTicks);
        Path uneven = even;
        Eigen::Vector3f& other = uneven[kTicks - 1];
        other = trial.renderer.writable(2 * approach.contact - other);
        const float way = (other - even[kTicks - 1]).norm();
        const Eigen::Vector3f force = trial.renderer.forces_along(uneven).back(),
                              expected = trial.renderer.forces_along(even).back();
        const float spring = springs_along(trial, even).back().force.norm();
        const float most =
            p.larger() * p.share * p.share * p.rate * way * (1 + p.drag * speed * spring / (p.full_at * p.full_at));
        if (differ(force, expected) && !((force - expected).norm() <= 1.001F * most + kLeastPull))
          invariant.violated("at " + with_unit(speed) + ", a position " + shortest(way) + " mm off before the last one, at " +
                             show(approach.contact) + " mm, makes the force " + show(force) + " N instead of " +
                             show(expected) + " N: a hand would feel the noise of its encoder");
      });
}

}  // namespace forceshade::conformance
