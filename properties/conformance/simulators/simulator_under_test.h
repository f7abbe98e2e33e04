// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third-party simulator, opened on a scene: forces are applied to the sphere, and it answers with the motion.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/conformance/hello.h"
#include "properties/conformance/simulators/simulation.h"

namespace forceshade::conformance::simulators {

// A simulator's description of itself.
struct SimulatorCapabilities {
  enum class Reports { force, impulse, nothing };
  enum class Constraint { hard, soft, penalty };

  std::string name, version, settings;
  Reports reports = Reports::nothing;
  Constraint constraint = Constraint::hard;
  double smallest_radius = 0;               // m
  std::optional<double> speed_cap = {};     // m/s
  std::optional<std::string> refusal = {};  // why it does not simulate this scene; nothing where it does
  nlohmann::ordered_json declared = {};     // all of them, for JSON
};

struct Contact {
  Eigen::Vector3d normal{0, 0, 0};  // on the sphere, away from the ground
  double force = 0;                 // N; that of an impulse is its mean in the step
};

struct State {
  Eigen::Vector3d position{0, 0, 0}, velocity{0, 0, 0};  // m, m/s
  std::vector<Contact> contacts = {};                    // none of a simulator that reports nothing
};

struct Motion {
  std::vector<State> states = {};           // after each step
  std::optional<std::string> refusal = {};  // in words, of forces that it does not apply; then there are no states
};

// One thread at a time.
class SimulatorUnderTest {
 public:
  virtual ~SimulatorUnderTest() = default;

  virtual const SimulatorCapabilities& capabilities() const = 0;

  // The next steps, with one force (N) for each; is_reset: the scene begins anew with them. Throws files::ProcessFailed; then
  // no further call is of use.
  virtual Motion apply(std::span<const Eigen::Vector3d> forces, bool is_reset) = 0;

  // Nothing will be asked any more. Throws files::ProcessFailed.
  virtual void say_goodbye() = 0;
};

// Throws files::ProcessFailed.
using OpenSimulator = std::function<std::unique_ptr<SimulatorUnderTest>(const Simulation&)>;

}  // namespace forceshade::conformance::simulators
