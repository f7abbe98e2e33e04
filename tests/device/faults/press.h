// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of the servo loop at 1 kHz with all there is around it: a simulated Premium 1.5 in a hand that presses and strokes,
// supervisor, passivity controller, recorder; and something that goes wrong from a given tick on.

#include <cstddef>
#include <functional>
#include <optional>

#include "forceshade/device.h"
#include "forceshade/recording.h"
#include "tests/device/faults/fault.h"

namespace forceshade::faults {

// The hand comes down in the first 0.3 s, has the whole force from 0.55 s on, and strokes at 150 mm/s from 0.8 s to 1.2 s.
inline constexpr std::size_t kGrowing = 350, kResting = 700, kStroking = 900, kEnd = 1200;  // ticks

// A fault, as changes of what the device gives and gets. `since` counts ticks from the fault on.
struct Wrong {
  using Since = std::size_t;
  std::size_t tick = kResting;
  std::function<void(device::Capabilities&)> capabilities = {};
  std::function<std::optional<device::Fault>()> start = {};
  std::function<void(device::ReadResult&, Since)> read = {};
  std::function<void(device::State&, Since)> state = {};
  std::function<std::optional<device::Fault>(Eigen::Vector3f&, Since)> command = {};  // the force as the arm gets it
};

// Alters what is read, where something is read.
std::function<void(device::ReadResult&, Wrong::Since)> reading(std::function<void(device::Reading&, Wrong::Since)> alter);

struct Scene {
  LawId law = LawId::bump_1p_shaded;
  float stiffness = 0.5F;           // N/mm
  double depth = 6;                 // mm, where the hand means to be under the surface
  std::optional<double> torn = {};  // s, when it is torn sideways by 120 mm within 10 ms
  std::optional<int> dead_man_button = {};
  recorder::Recorder::Options recorder = {};
  const std::atomic<bool>* stop = nullptr;
  std::function<void()> before = {};                      // the run starts
  std::function<void(const std::string&)> at_fault = {};  // given the recording's path, in the tick where it goes wrong
};

Outcome press(const Wrong& wrong, const Bench& bench, const Scene& scene = {});

}  // namespace forceshade::faults
