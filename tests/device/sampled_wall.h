// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stiffness at which sampling and encoders make a virtual spring lively, found by simulating it.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "device/simulated/simulated.h"

namespace forceshade::device {

// A mass on a rail, seen through an encoder and pushed by a held force: the plant of Abbott and Okamura (2005).
struct SampledWall {
  double mass = 0.05;     // kg
  double damping = 0.5;   // b: N·s/m
  double coulomb = 0.05;  // f_c: N
  double quantum = 3e-5;  // Δ: m; 0: continuous
  double period = 1e-3;   // T: s
  bool latency = false;   // of one sample
};

// An arm so long that its tip's circle is a straight line, with all but its first joint fixed and a motor without limits.
inline constexpr double kLength = 1000;  // m
inline constexpr double kVast = 1e15;

inline Model rail(const SampledWall& wall) {
  const double inertia = wall.mass * kLength * kLength;
  return {.name = "rail",
          .sheet = {},
          .arm = {kLength, kLength, {0, kLength, -kLength}, {inertia, 0, 0, 0, inertia, inertia}, 0, 0},
          .motor = {.torque_constant = 1,
                    .continuous = kVast,
                    .stall = kVast,
                    .rotor_inertia = 0,
                    .winding_time = 1,
                    .housing_time = 1,
                    .winding_resistance = 1,
                    .housing_resistance = 1,
                    .amplifier_bits = 0},
          .gears = {1, 1, 1},
          .quantum = {wall.quantum / kLength, 0, 0},
          .coulomb = {wall.coulomb * kLength, kVast, kVast},
          .viscous = {wall.damping * kLength * kLength, 0, 0}};
}

class RunOnRail {
 public:
  RunOnRail(const SampledWall& wall, double stiffness, double start, double push)
      : wall_(wall),
        stiffness_(stiffness),
        push_(push),
        device_(rail(wall), std::nullopt, {.latency = wall.latency, .start = {start / kLength, 0, 0}}) {
    device_.start(1 / wall.period);
  }

  void tick() {
    const ReadResult read = device_.read();
    const double x = static_cast<double>(std::get<Reading>(read).position.x()) * kMillimetre;
    device_.command({static_cast<float>(push_ - stiffness_ * x), 0, 0});
  }

  double velocity() const { return device_.motion().velocity[0] * kLength; }
  double energy() const {
    const double x = device_.motion().angles[0] * kLength;
    return (wall_.mass * velocity() * velocity() + stiffness_ * x * x) / 2;
  }

 private:
  SampledWall wall_;
  double stiffness_, push_;
  Simulated device_;
};

// Twenty oscillations, far larger than what friction and encoder see.
inline bool loses_energy(const SampledWall& wall, double stiffness) {
  constexpr double kFar = 200;  // times the amplitude at which friction takes as much as damping, and a quantum
  const double pulsation = std::sqrt(stiffness / wall.mass);
  const double amplitude =
      std::max({1e-3, kFar * wall.quantum, kFar * wall.coulomb / (std::max(wall.damping, 1e-9) * pulsation)});
  const int half = static_cast<int>(std::ceil(10 * 2 * std::numbers::pi / pulsation / wall.period));
  RunOnRail run(wall, stiffness, amplitude, 0);
  const auto energy_of_half = [&] {
    double sum = 0;
    for (int k = 0; k < half; ++k) {
      run.tick();
      sum += run.energy();
    }
    return sum;
  };
  const double first = energy_of_half();
  return energy_of_half() < first;
}

inline bool comes_to_rest(const SampledWall& wall, double stiffness) {
  if (wall.quantum == 0) return true;
  constexpr int kTicks = 1000, kQuietTicks = 50;
  RunOnRail run(wall, stiffness, 3 * wall.quantum, stiffness * wall.quantum / 2);
  int at_rest = 0;
  for (int k = 0; k < kTicks && at_rest < kQuietTicks; ++k) {
    run.tick();
    at_rest = run.velocity() == 0 && k > 0 ? at_rest + 1 : 0;
  }
  return at_rest == kQuietTicks;
}

// Runs the simulated device under the force -K x of a spring of `stiffness` K N/m, twice: from far away, where only damping
// matters, it has to lose energy; and between two encoder counts, with a hand pushing so that the force of neither is
// balanced, it has to come to rest.
inline bool is_quiet(const SampledWall& wall, double stiffness) {
  return comes_to_rest(wall, stiffness) && loses_energy(wall, stiffness);
}

// The largest quiet stiffness, N/m, to half a per cent.
inline double largest_quiet_stiffness(const SampledWall& wall) {
  double quiet = 1, lively = 1e6;  // N/m
  while (lively > 1.005 * quiet) {
    const double middle = std::sqrt(quiet * lively);
    (is_quiet(wall, middle) ? quiet : lively) = middle;
  }
  return std::sqrt(quiet * lively);
}

// min(2b/T, 2f_c/Δ), N/m.
inline double passive_stiffness(const SampledWall& wall) noexcept {
  const double by_damping = 2 * wall.damping / wall.period;
  return wall.quantum > 0 ? std::min(by_damping, 2 * wall.coulomb / wall.quantum) : by_damping;
}

}  // namespace forceshade::device
