// SPDX-License-Identifier: BSD-3-Clause
// Faults of a device, ticks that come late, and arithmetic that is not what the proofs assume.

#include <atomic>
#include <cfenv>
#include <cmath>

#include "tests/device/faults/press.h"
#include "tests/world/world.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

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

Fault device_fault(std::string what, std::string reaction, std::optional<std::size_t> to_zero, Wrong wrong, Scene scene = {}) {
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

Fault position(std::string what, std::string reaction, std::optional<std::size_t> to_zero,
               std::function<void(Reading&, Since)> alter, std::size_t tick = kResting, Scene scene = {}) {
  return device_fault(std::move(what), std::move(reaction), to_zero, {.tick = tick, .read = reading(std::move(alter))},
                      std::move(scene));
}

// Gives for ever what was read when it began.
std::function<void(Reading&, Since)> frozen() {
  return [last = Eigen::Vector3f(0, 0, 0)](Reading& reading, Since since) mutable {
    if (since == 0) last = reading.position;
    reading.position = last;
  };
}

std::function<void(Reading&, Since)> drifting(const Eigen::Vector3f& a_tick) {
  return [=](Reading& reading, Since since) { reading.position += a_tick * static_cast<float>(since + 1); };
}

// Lets so many ms pass, by the tick, as a tick's force is commanded.
Fault late(std::string what, std::string reaction, std::optional<std::size_t> to_zero, std::function<double(Since)> ms) {
  Fault fault = device_fault(std::move(what), std::move(reaction), to_zero,
                             {.tick = kGrowing, .command = [ms = std::move(ms)](Force&, Since since) {
                                world::current()->pass(ms(since));
                                return std::optional<device::Fault>();
                              }});
  fault.kind = Kind::timing;
  return fault;
}

std::function<double(Since)> once(double ms) {
  return [=](Since since) { return since == 0 ? ms : 0; };
}

Fault odd_arithmetic(std::string what, std::string reaction, std::function<void()> set) {
  Fault fault = at_start(device_fault(std::move(what), std::move(reaction), 0, {.tick = 0}, {.before = std::move(set)}));
  fault.kind = Kind::timing;
  return fault;
}

// The loop is asked to stop while it reads: that tick has its force, and the next is the end.
Fault told_to_stop() {
  return {.kind = Kind::device,
          .what = "told to stop in contact",
          .reaction = "ends: stopped",
          .to_zero = 1,
          .run = [](const Bench& bench) {
            std::atomic<bool> stop = false;
            return press({.read = [&](ReadResult&, Since) { stop = true; }}, bench, {.stop = &stop});
          }};
}

std::function<void(State&, Since)> temperature(float value) {
  return [=](State& state, Since) { state.temperature = value; };
}

}  // namespace

std::vector<Fault> position_faults() {
  const float nan = std::nanf("");
  return {
      position("position is NaN", "trip: invalid position", 0, [=](Reading& r, Since) { r.position.setConstant(nan); }),
      position("position is infinite", "trip: invalid position", 0,
               [](Reading& r, Since) { r.position.setConstant(HUGE_VALF); }),
      position("one axis is NaN", "trip: invalid position", 0, [=](Reading& r, Since) { r.position.y() = nan; }),
      position("position is NaN for one tick", "trip: invalid position", 0,
               [=](Reading& r, Since since) {
                 if (since == 0) r.position.setConstant(nan);
               }),
      position("position is outside the law's domain", "trip: invalid position", 0,
               [](Reading& r, Since) { r.position.x() = 2e4F; }),
      position("position jumps by 10 mm", "trip: jump", 0, [](Reading& r, Since) { r.position.x() += 10; }),
      position("position jumps by 10 mm and back", "trip: jump", 0,
               [](Reading& r, Since since) { r.position.x() += since == 0 ? 10.0F : 0.0F; }),
      position("position jumps by 2 mm, as when encoder counts are lost", "trip: velocity", 0,
               [](Reading& r, Since) { r.position.z() -= 2; }),
      position("position drifts at 2 m/s", "trip: velocity", 0, drifting({2, 0, 0})),
      position("position flickers by 1.5 mm", "trip: velocity", 0,
               [](Reading& r, Since since) { r.position.z() += since % 2 == 0 ? 1.5F : 0.0F; }),
      // 2 (143.5 + 64): the margin of the workspace ends 143.5 mm down, and the arm goes the other way, where 8.5 N move hand
      // and flesh by 64 mm.
      position("position drifts into the surface at 0.5 m/s", "limited: peak force, slew, workspace", 415,
               drifting({0, 0, -0.5F})),
      // From x = -30 mm to 200.5 mm.
      position("position drifts out of the workspace at 0.5 m/s", "limited: workspace", 461, drifting({0.5F, 0, 0})),
      position("encoders freeze in a stroke", "trip: frozen encoder", 20, frozen(), kStroking),
      // With at least 2 N from the law, the ramp at 1/500 a tick, and 20 ticks for the hand to move.
      position("encoders freeze while the force grows", "trip: frozen encoder", 125 + 20, frozen(), kGrowing, {.depth = 20}),
      position("encoders freeze under a resting hand", "goes on", std::nullopt, frozen()),
      position("every other reading is the one before", "goes on", std::nullopt,
               [last = Eigen::Vector3f(0, 0, 0)](Reading& r, Since since) mutable {
                 if (since % 2 == 0) last = r.position;
                 r.position = last;
               }),
      // Half of the arm's swing on the hand's flesh: 80 g on 575 N/m.
      position("the hand is torn away", "trip: velocity", 37, [](Reading&, Since) {}, kResting, {.torn = 0.7})};
}

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
        told_to_stop(),
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
        at_start(device_fault("starting the device changes the rounding mode", "device fault: rounding other than to nearest",
                              0,
                              {.tick = 0,
                               .start =
                                   [] {
                                     std::fesetround(FE_UPWARD);
                                     return std::optional<device::Fault>();
                                   }})),
        at_start(
            device_fault("a law of 1000 N/mm", "limited: peak force, slew", std::nullopt, {.tick = 0}, {.stiffness = 1000})),
        incapable("the highest force is NaN", "refused: the device's peak force", [=](Capabilities& c) { c.peak_force = nan; }),
        incapable("the continuous force is NaN", "refused: the device's continuous force",
                  [=](Capabilities& c) { c.continuous_force = nan; }),
        incapable("the resolution is NaN", "refused: the device's resolution", [=](Capabilities& c) { c.resolution = nan; }),
        incapable("the workspace is NaN", "refused: the device's workspace",
                  [=](Capabilities& c) { c.workspace_high.setConstant(nan); }),
        late("one tick is 2 ms late", "limited: missed deadlines", std::nullopt, once(3)),
        late("ticks are late for 5 ms", "limited: missed deadlines", std::nullopt, once(6.5)),
        // The stall, and no more.
        late("the loop stalls for 30 ms", "trip: watchdog", 1, once(31)),
        // The first, 3 ticks held, and the ramp.
        late("every tick is 2 ms late", "trip: missed deadlines", 1 + 3 + 20, [](Since since) { return since == 0 ? 3 : 1; }),
        // 10 ticks until they are a period late, 3 held, and the ramp.
        late("every tick takes 1.1 ms", "trip: missed deadlines", 10 + 1 + 3 + 20, [](Since) { return 1.1; }),
        late("signals cut the sleep short", "goes on, same forces", std::nullopt,
             [](Since) {
               world::current()->interrupt(5);
               return 0;
             }),
        odd_arithmetic("rounding upward before the start", "refused: rounding other than to nearest",
                       [] { std::fesetround(FE_UPWARD); }),
#if defined(__SSE2__)
        odd_arithmetic("subnormals flushed before the start", "refused: flushed subnormals",
                       [] { _mm_setcsr(_mm_getcsr() | 0x8040U); }),
#endif
  };
}

}  // namespace forceshade::faults
