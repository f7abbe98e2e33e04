// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --origin and --turn: where the law or height map lies in the device's workspace.

#include <CLI/CLI.hpp>
#include <string>

#include "forceshade/servo_loop.h"

namespace forceshade::apps {

class PlacementOptions {
 public:
  explicit PlacementOptions(CLI::App& command);

  // Throws Error.
  device::Placement placement() const;

 private:
  std::string origin_, turn_;
};

}  // namespace forceshade::apps
