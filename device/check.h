// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The checks of a device before the first force, each in one sentence: the verdicts, without the measuring.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/phantom/driver_folder.h"
#include "device/quiet_watch.h"
#include "forceshade/device.h"

namespace forceshade::device {

// Lacking: a setting of the machine that would help, and that a run does without.
enum class Grade { ok, lacking, wrong, unknown };

std::string_view name_of(Grade grade) noexcept;  // "ok", "lacking", "wrong", "cannot be checked"

struct Check {
  std::string name;
  Grade grade;
  std::string words;
};

// `name`: the device's, empty for the default one.
Check check_name(const DriverFolder& folder, const std::string& name);

Check check_nodes(const std::vector<DeviceNode>& nodes);

// Both: of a PHANToM of this name before it is opened, which says why where its library cannot be loaded.
std::vector<Check> phantom_checks(const std::string& name);

// Model, serial number, driver and firmware.
Check check_identity(const Capabilities& capabilities);

// Calibration, update rate, encoders, kinematics, buttons, noise. `rate` is what the device was started with, in Hz.
std::vector<Check> check_readings(const Observed& seen, const Capabilities& capabilities, double rate);

// Above this, in mm along an axis, an arm is not at rest, and its noise cannot be measured.
inline constexpr double kAtRest = 0.5;

// mm: two sources of an Omni's link lengths differ by 1.65 mm a link, which a position may differ by in sum and more; a pose
// that is not calibrated, or the wrong model, is tens of mm away.
inline constexpr double kKinematicTolerance = 5;

}  // namespace forceshade::device
