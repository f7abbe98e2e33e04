// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The PHANToMs that can be simulated, by number: what is known of each, and device/simulated/model.md says how surely.

#include <array>
#include <optional>
#include <string_view>

#include "device/simulated/arm.h"
#include "device/simulated/motor.h"

namespace forceshade::device {

// The vendor's data sheet.
struct Sheet {
  Eigen::Vector3d workspace;            // mm: width, depth and height of a box about the origin
  double resolution;                    // mm
  double peak_force, continuous_force;  // N
  double friction;                      // N, felt when backdriving
  double apparent_mass;                 // kg
};

struct Model {
  std::string_view name;
  Sheet sheet;
  Arm arm;  // its inertia with the motors' rotors
  Motor motor;
  Eigen::Vector3d gears;    // motor turns per joint turn
  Eigen::Vector3d quantum;  // rad a count of each joint's encoder; 0: continuous
  Joints coulomb;           // N·m
  Joints viscous;           // N·m·s/rad
};

Model premium_1_5() noexcept;
Model premium_1_0() noexcept;
Model omni() noexcept;

// The same with springs or weights that take gravity off the joints. The Premiums' motors only nearly do.
Model counterbalanced(Model model) noexcept;

inline constexpr std::array kModels{premium_1_5, premium_1_0, omni};

// The one with the kinematics of what a driver calls its device ("PHANTOM Premium 1.5", "Geomagic Touch"), or of that name
// above. A Touch has an Omni's; a Touch X (Desktop) has none here.
std::optional<Model> model_named(std::string_view drivers_name);

}  // namespace forceshade::device
