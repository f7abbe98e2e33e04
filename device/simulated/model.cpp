// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/model.h"

#include <numbers>
#include <string>

#include "text/letters.h"

namespace forceshade::device {
namespace {

constexpr double kGravity = 9.80665;     // m/s²
constexpr double kCountsPerTurn = 4096;  // of the motor: 1024 lines, four edges each

// Maxon RE25, as a measured Premium has them. The amplifier's bits are assumed.
constexpr Motor kRe25{.torque_constant = 0.0234,
                      .continuous = 0.0286,
                      .stall = 0.129,
                      .rotor_inertia = 10.3e-7,
                      .winding_time = 12,
                      .housing_time = 612,
                      .winding_resistance = 3.1,
                      .housing_resistance = 14,
                      .amplifier_bits = 12};

Eigen::Vector3d squared(const Eigen::Vector3d& x) {
  return x.cwiseProduct(x);
}

void add_rotors(Arm& arm, const Motor& motor, const Eigen::Vector3d& gears) {
  const Eigen::Vector3d at_joint = motor.rotor_inertia * squared(gears);
  arm.inertia.turn += at_joint[0];
  arm.inertia.upper += at_joint[1];
  arm.inertia.fore += at_joint[2];
}

// Cavusoglu, Feygin and Tendick (2002): a the forearm, c the rod that drives it, be and df the links that carry the motors.
Arm premium_arm() {
  constexpr double l1 = 0.215, l2 = 0.170, l3 = 0.0325, l5 = -0.0368, l6 = 0.0527;  // m
  constexpr double ma = 0.0202, mc = 0.0249, mbe = 0.2359, mdf = 0.1906;            // kg
  // kg·m²
  constexpr double ax = 0.4864e-4, ay = 0.001843e-4, az = 0.4864e-4, cx = 0.959e-4, cy = 0.959e-4, cz = 0.0051e-4;
  constexpr double bex = 11.09e-4, bey = 10.06e-4, bez = 0.591e-4, dfx = 7.11e-4, dfy = 0.629e-4, dfz = 6.246e-4;
  constexpr double base = 11.87e-4;
  return {.upper_length = l1,
          .fore_length = l2,
          .shoulder = {0, l2, -l1},
          .inertia = {.turn = (4 * (ay + az + bey + bez + cy + cz + dfy + dfz) + 8 * base + 4 * l1 * l1 * ma + l2 * l2 * ma +
                               l1 * l1 * mc + 4 * l3 * l3 * mc) /
                              8,
                      .turn_upper = (4 * (bey - bez + cy - cz) + l1 * l1 * (4 * ma + mc)) / 8,
                      .turn_fore = (4 * (ay - az + dfy - dfz) - l2 * l2 * ma - 4 * l3 * l3 * mc) / 8,
                      .coupling = l1 * (l2 * ma + l3 * mc),
                      .upper = bex + cx + l1 * l1 * ma + l1 * l1 * mc / 4,
                      .fore = ax + dfx + l2 * l2 * ma / 4 + l3 * l3 * mc},
          .upper_weight = kGravity / 2 * (2 * l1 * ma + 2 * l5 * mbe + l1 * mc),
          .fore_weight = kGravity / 2 * (l2 * ma + 2 * l3 * mc - 2 * l6 * mdf)};
}

// To assume when only the sheet's apparent mass is known: half of it is a mass at the tip, half is the joints' own inertia.
Inertia assumed_inertia(double apparent, double l1, double l2) {
  const double m = apparent / 2;
  return {.turn = m * (l1 * l1 + l2 * l2) / 2 + m * l1 * l1,
          .turn_upper = m * l1 * l1 / 2,
          .turn_fore = -m * l2 * l2 / 2,
          .coupling = 2 * m * l1 * l2,
          .upper = 2 * m * l1 * l1,
          .fore = 2 * m * l2 * l2};
}

// Force per torque at the reset pose, where the Jacobian is diagonal.
Eigen::Vector3d levers(const Arm& arm) {
  return {arm.upper_length, arm.upper_length, arm.fore_length};
}

}  // namespace

Model premium_1_5() noexcept {
  Model model{.name = "premium-1.5",
              .sheet = {{381, 191, 267}, 0.03, 8.5, 1.4, 0.04, 0.075},
              .arm = premium_arm(),
              .motor = kRe25,
              .gears = {13.3, 11.2, 11.2},
              .quantum = {},
              .coulomb = {},
              .viscous = Joints::Constant(5e-4)};
  model.quantum = 2 * std::numbers::pi / kCountsPerTurn * model.gears.cwiseInverse();
  model.coulomb = model.sheet.friction * levers(model.arm);
  add_rotors(model.arm, model.motor, model.gears);
  return model;
}

// Its numbers are not published. Its sheet has 2/3 of the 1.5's workspace and otherwise the same rows, so it is taken for a 1.5
// with all lengths and gears at 2/3 and the same masses, which is the same at the tip.
Model premium_1_0() noexcept {
  constexpr double kScale = 2.0 / 3;
  Model model = premium_1_5();
  model.name = "premium-1.0";
  model.sheet.workspace = {254, 127, 178};
  Arm& arm = model.arm;
  for (double* x : {&arm.upper_length, &arm.fore_length, &arm.upper_weight, &arm.fore_weight}) *x *= kScale;
  arm.shoulder *= kScale;
  Inertia& i = arm.inertia;
  for (double* x : {&i.turn, &i.turn_upper, &i.turn_fore, &i.coupling, &i.upper, &i.fore}) *x *= kScale * kScale;
  model.gears *= kScale;
  model.quantum /= kScale;
  model.coulomb *= kScale;
  model.viscous *= kScale * kScale;
  return model;
}

// Lengths by Jarillo-Silva (2009). All else from the sheet: its apparent mass, which springs balance, its
// forces and its resolution at the reset pose, behind motors that heat up as the Premium's do.
Model omni() noexcept {
  constexpr double l1 = 0.135, l2 = 0.135;  // m
  const Sheet sheet{{160, 70, 120}, 0.055, 3.3, 0.88, 0.26, 0.045};
  Motor motor = kRe25;
  motor.continuous = motor.stall * sheet.continuous_force / sheet.peak_force;
  motor.rotor_inertia = 0;  // in the apparent mass
  const Arm arm{l1, l2, {0, 0.025, -0.170}, assumed_inertia(sheet.apparent_mass, l1, l2), 0, 0};
  return {.name = "omni",
          .sheet = sheet,
          .arm = arm,
          .motor = motor,
          .gears = sheet.peak_force * levers(arm) / motor.stall,
          .quantum = sheet.resolution * kMillimetre * levers(arm).cwiseInverse(),
          .coulomb = sheet.friction * levers(arm),
          .viscous = Joints::Constant(5e-4)};
}

std::optional<Model> model_named(std::string_view drivers_name) {
  const std::string name = small_letters(drivers_name);
  const auto has = [&](const char* words) { return name.find(words) != std::string::npos; };
  if (has("touch x")) return std::nullopt;
  if (has("omni") || has("touch")) return omni();
  if (has("premium") && has("1.5")) return premium_1_5();
  if (has("premium") && has("1.0")) return premium_1_0();
  return std::nullopt;
}

Model counterbalanced(Model model) noexcept {
  model.arm.upper_weight = model.arm.fore_weight = 0;
  return model;
}

}  // namespace forceshade::device
