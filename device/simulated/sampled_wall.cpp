// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/sampled_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "device/simulated/simulated.h"

namespace forceshade::device {
namespace {

// An arm so long that its tip's circle is a straight line, with all but its first joint fixed and a motor without limits.
constexpr double kLength = 1000;  // m
constexpr double kVast = 1e15;

Model rail(const SampledWall& wall) {
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

class Run {
 public:
  Run(const SampledWall& wall, double stiffness, double start, double push)
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
bool loses_energy(const SampledWall& wall, double stiffness) {
  constexpr double kFar = 200;  // times the amplitude at which friction takes as much as damping, and a quantum
  const double pulsation = std::sqrt(stiffness / wall.mass);
  const double amplitude =
      std::max({1e-3, kFar * wall.quantum, kFar * wall.coulomb / (std::max(wall.damping, 1e-9) * pulsation)});
  const int half = static_cast<int>(std::ceil(10 * 2 * std::numbers::pi / pulsation / wall.period));
  Run run(wall, stiffness, amplitude, 0);
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

bool comes_to_rest(const SampledWall& wall, double stiffness) {
  if (wall.quantum == 0) return true;
  constexpr int kTicks = 1000, kQuietTicks = 50;
  Run run(wall, stiffness, 3 * wall.quantum, stiffness * wall.quantum / 2);
  int at_rest = 0;
  for (int k = 0; k < kTicks && at_rest < kQuietTicks; ++k) {
    run.tick();
    at_rest = run.velocity() == 0 && k > 0 ? at_rest + 1 : 0;
  }
  return at_rest == kQuietTicks;
}

}  // namespace

bool is_quiet(const SampledWall& wall, double stiffness) {
  return comes_to_rest(wall, stiffness) && loses_energy(wall, stiffness);
}

double largest_quiet_stiffness(const SampledWall& wall) {
  double quiet = 1, lively = 1e6;  // N/m
  while (lively > 1.005 * quiet) {
    const double middle = std::sqrt(quiet * lively);
    (is_quiet(wall, middle) ? quiet : lively) = middle;
  }
  return std::sqrt(quiet * lively);
}

double passive_stiffness(const SampledWall& wall) noexcept {
  const double by_damping = 2 * wall.damping / wall.period;
  return wall.quantum > 0 ? std::min(by_damping, 2 * wall.coulomb / wall.quantum) : by_damping;
}

}  // namespace forceshade::device
