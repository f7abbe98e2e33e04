// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third-party simulator, held against all of its invariants.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/simulators/simulator_under_test.h"

namespace forceshade::conformance::simulators {

struct SimulatorConformance {
  SimulatorCapabilities simulator;
  std::vector<Invariant> invariants = {};
  std::optional<std::string> failure = {};  // that ended the check

  bool held() const;  // every invariant that is applicable, and there was one
};

// Throws Interrupted.
SimulatorConformance conform_simulator(const OpenSimulator& open, const Monitor& monitor = {});

// Lines for a terminal, each ended; and the same for programs.
std::string words_of(const SimulatorConformance& found);
// The JSON is that of docs/conformance-schema.json. version: of this program; command: repeats the run, empty where it is not
// known.
inline constexpr const char* kSimulatorSchema = "forceshade conformance of a simulator 1";
nlohmann::ordered_json json_of(const SimulatorConformance& found, const std::string& version, const std::string& command);

}  // namespace forceshade::conformance::simulators
