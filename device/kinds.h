// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The kinds of device that there are: open_device(), its error message, `device`, the help of --device and the completion
// take them from this one list. A new kind is its own files and its entry in kinds.cpp.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/check.h"
#include "forceshade/device.h"

namespace forceshade::device {

struct Kind {
  std::string_view name;  // the beginning of a device's name: "replay"
  // The rest of the name, as users write it: ":FILE.csv", or "[:NAME]" where it may be left out; empty where nothing does.
  std::string_view rest;
  std::string_view what;  // "a recorded hand, whatever the force"
  // rest: what follows the colon; empty where nothing does.
  std::unique_ptr<Device> (*open)(const std::string& rest, Attendant& attendant, Forces forces);

  // The checks of such a device before it is opened, for `device check`; null: none.
  std::vector<Check> (*checks)(const std::string& rest) = nullptr;

  bool is_simulated = false;  // a model of an arm that could be taken for a real one
  bool is_untried = false;    // a driver that nobody has tried on hardware

  std::string form() const { return std::string(name) + std::string(rest); }
  std::string words() const { return std::string(what) + (is_untried ? " (never tried on hardware)" : ""); }
};

std::span<const Kind> kinds();

// Those of the kind of this device, "phantom:Left arm" for instance; none where there is no such kind.
std::vector<Check> checks_before_opening(const std::string& name);

// True of the name of a simulated device.
bool is_simulated(const std::string& name);

// True of the name of a device whose driver nobody has tried on hardware.
bool is_untried(const std::string& name);

}  // namespace forceshade::device
