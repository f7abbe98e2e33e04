// SPDX-License-Identifier: BSD-3-Clause
// Whatever else a device may do, or not do.

#include <cfenv>
#include <cmath>

#include "tests/device/faults/press.h"

namespace forceshade::faults {
namespace {

using device::Capabilities;
using device::EndOfData;
using device::Reading;
using device::ReadResult;
using device::State;
using Since = Wrong::Since;
using Force = Eigen::Vector3f;

constexpr device::Fault kBroken{"the amplifier is off"}, kBrokenLater{"a later fault"};

Fault device_fault(std::string what, std::string reaction, std::optional<double> to_zero, Wrong wrong, Scene scene = {}) {
  return {.kind = Kind::device,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = to_zero,
          .run = [=](const Bench& bench) { return press(wrong, bench, scene); }};
}

// Before the first tick: no force ever.
Fault at_start(Fault fault) {
  fault.under_force = false;
  return fault;
}

Fault incapable(std::string what, std::string reaction, std::function<void(Capabilities&)> alter) {
  return at_start(device_fault(std::move(what), std::move(reaction), 0, {.tick = 0, .capabilities = std::move(alter)}));
}

std::function<void(State&, Since)> temperature(float value) {
  return [=](State& state, Since) { state.temperature = value; };
}

}  // namespace

std::vector<Fault> device_faults() {
  const float nan = std::nanf("");
  const auto upward = [](ReadResult&, Since) { std::fesetround(FE_UPWARD); };
  return {
      device_fault("reading fails", "device fault: the amplifier is off", 0,
                   {.read = [](ReadResult& result, Since) { result = kBroken; }}),
      device_fault("a command is refused", "device fault: the amplifier is off", 1,
                   {.command = [](Force&, Since) { return kBroken; }}),
      device_fault("a command is refused, and then zero, too", "device fault: the amplifier is off", 1,
                   {.command = [](Force&, Since since) { return since == 0 ? kBroken : kBrokenLater; }}),
      at_start(device_fault("the device does not start", "device fault: the amplifier is off", 0,
                            {.tick = 0, .start = [] { return kBroken; }})),
      device_fault("calibration is lost", "trip: uncalibrated", 0,
                   {.state = [](State& state, Since) { state.calibrated = false; }}),
      at_start(device_fault("never calibrated", "trip: uncalibrated", 0,
                            {.tick = 0, .state = [](State& state, Since) { state.calibrated = false; }})),
      device_fault("forces are switched off, and on again 0.1 s later", "limited: gentle start, dead-man switch", 0,
                   {.state = [](State& state, Since since) { state.forces_on = since >= 100; }}),
      device_fault("the dead-man button is let go", "limited: dead-man switch", 0,
                   {.read = reading([](Reading& r, Since) { r.buttons = 2; })}, {.dead_man_button = 0}),
      at_start(device_fault("the dead-man button is never pressed", "limited: dead-man switch", 0,
                            {.tick = 0, .read = reading([](Reading& r, Since) { r.buttons = 2; })}, {.dead_man_button = 0})),
      device_fault("motors at their highest temperature", "limited: warm motors", std::nullopt, {.state = temperature(1)},
                   {.law = LawId::wall, .depth = 20}),
      device_fault("motors warmer than allowed", "limited: warm motors", 0, {.state = temperature(1.1F)}),
      device_fault("temperature is NaN", "limited: warm motors", 0, {.state = temperature(nan)}),
      device_fault("the device's clock goes backwards", "goes on, same forces", std::nullopt,
                   {.read = reading([](Reading& r, Since) { r.time = 5 - r.time; })}),
      device_fault("the device's clock is NaN", "goes on, same forces", std::nullopt,
                   {.read = reading([](Reading& r, Since) { r.time = std::nan(""); })}),
      device_fault("the device's clock leaps an hour ahead, and the position by 150 mm", "trip: jump", 0,
                   {.read = reading([](Reading& r, Since) {
                      r.time += 3600;
                      r.position.x() += 150;
                    })}),
      device_fault("gimbal angles are NaN", "goes on, same forces", std::nullopt,
                   {.read = reading([=](Reading& r, Since) { r.gimbal = Force::Constant(nan); })}),
      device_fault("the data ends in contact", "ends: end of data", 0,
                   {.read = [](ReadResult& result, Since) { result = EndOfData{}; }}),
      device_fault("commands are taken and not obeyed", "goes on", std::nullopt,
                   {.command =
                        [](Force& force, Since) {
                          force.setZero();
                          return std::nullopt;
                        }},
                   {.law = LawId::wall}),
      device_fault("the last force is held, whatever is commanded", "goes on", std::nullopt,
                   {.command =
                        [last = Force(0, 0, 0)](Force& force, Since since) mutable {
                          if (since == 0) last = force;
                          force = last;
                          return std::nullopt;
                        }},
                   {.law = LawId::wall}),
      device_fault("reading changes the rounding mode", "device fault: rounding other than to nearest", 0, {.read = upward}),
      at_start(device_fault("starting the device changes the rounding mode", "device fault: rounding other than to nearest", 0,
                            {.tick = 0,
                             .start =
                                 [] {
                                   std::fesetround(FE_UPWARD);
                                   return std::optional<device::Fault>();
                                 }})),
      at_start(device_fault("a law of 1000 N/mm", "limited: peak force, slew", std::nullopt, {.tick = 0}, {.stiffness = 1000})),
      incapable("the highest force is NaN", "refused: the device's peak force", [=](Capabilities& c) { c.peak_force = nan; }),
      incapable("the continuous force is NaN", "refused: the device's continuous force",
                [=](Capabilities& c) { c.continuous_force = nan; }),
      incapable("the resolution is NaN", "refused: the device's resolution", [=](Capabilities& c) { c.resolution = nan; }),
      incapable("the workspace is NaN", "refused: the device's workspace",
                [=](Capabilities& c) { c.workspace_high.setConstant(nan); }),
  };
}

}  // namespace forceshade::faults
