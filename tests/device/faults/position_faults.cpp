// SPDX-License-Identifier: BSD-3-Clause
// Positions that are wrong.

#include <cmath>

#include "tests/device/faults/press.h"

namespace forceshade::faults {
namespace {

using device::Reading;
using Since = Wrong::Since;

Fault position(std::string what, std::string reaction, double to_zero, std::function<void(Reading&, Since)> alter,
               std::size_t tick = kResting, Scene scene = {}) {
  return {.kind = Kind::device,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = to_zero,
          .run = [=](const Bench& bench) { return press({.tick = tick, .read = reading(alter)}, bench, scene); }};
}

Fault goes_on(Fault fault) {
  fault.to_zero.reset();
  return fault;
}

// What was read when it began to be so, for ever.
std::function<void(Reading&, Since)> frozen() {
  return [last = Eigen::Vector3f(0, 0, 0)](Reading& reading, Since since) mutable {
    if (since == 0) last = reading.position;
    reading.position = last;
  };
}

std::function<void(Reading&, Since)> drifting(const Eigen::Vector3f& a_tick) {
  return [=](Reading& reading, Since since) { reading.position += a_tick * static_cast<float>(since + 1); };
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
      // The margin of the workspace ends 143.5 mm down. The arm goes the other way: 8.5 N move hand and flesh by 64 mm.
      position("position drifts into the surface at 0.5 m/s", "limited: peak force, slew, workspace", 2 * (143.5 + 64),
               drifting({0, 0, -0.5F})),
      // From x = -30 mm to 200.5 mm.
      position("position drifts out of the workspace at 0.5 m/s", "limited: workspace", 461, drifting({0.5F, 0, 0})),
      position("encoders freeze in a stroke", "trip: frozen encoder", 20, frozen(), kStroking),
      // With at least 2 N from the law, the ramp at 1/500 a tick, and 20 ticks for the hand to move.
      position("encoders freeze while the force grows", "trip: frozen encoder", 125 + 20, frozen(), kGrowing, {.depth = 20}),
      goes_on(position("encoders freeze under a resting hand", "goes on", 0, frozen())),
      goes_on(position("every other reading is the one before", "goes on", 0,
                       [last = Eigen::Vector3f(0, 0, 0)](Reading& r, Since since) mutable {
                         if (since % 2 == 0) last = r.position;
                         r.position = last;
                       })),
      // Half of the arm's swing on the hand's flesh: 80 g on 575 N/m.
      position("the hand is torn away", "trip: velocity", 37, [](Reading&, Since) {}, kResting, {.torn = 0.7}),
  };
}

}  // namespace forceshade::faults
