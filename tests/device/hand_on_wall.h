// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand on a virtual wall under the servo loop, supervisor and passivity controller included, in simulated time.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <variant>
#include <vector>

#include "device/simulated/simulated.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

struct HandOnWall {
  Model model = premium_1_5();
  double rate = 1000;      // Hz, of the loop
  float stiffness = 0.5F;  // N/mm
  Passivity passivity = Passivity::damping;
  bool presses = false;  // it rests, meaning to be 6 mm below the surface; else it makes strokes 3 mm below it
  double seconds = 6;
};

// The result. The hand comes down within 1.5 s; it means to stay at its depth from then on.
struct FeltOnWall {
  double energy = 0;  // mJ: the most that the hand and the arm were given, less what was taken from them, at any time
  double swing = 0;   // mm: the farthest that the tip moved along the wall's normal within a tenth of a second, from 1.5 s on
  ServoResult run;
};

inline Operator hand_of(const HandOnWall& wall) {
  constexpr auto kSmoothly = Intention::Between::minimum_jerk;
  const Intention press({{0.4, {-20, 0, 3}}, {0.9, {-20, 0, -6}}}, kSmoothly);
  return {Grip{}, wall.presses ? press : strokes(), Tremor(1, 0.03), false};
}

class WallWatch final : public SampleSink {
 public:
  explicit WallWatch(const HandOnWall& wall)
      : window_(static_cast<std::ptrdiff_t>(std::lround(0.1 * wall.rate))),
        from_(static_cast<std::size_t>(std::lround(1.5 * wall.rate))) {
    heights_.reserve(static_cast<std::size_t>(std::lround(wall.seconds * wall.rate)) + 2);
  }

  void push(const Sample& sample) noexcept override {
    if (sample.status == Sample::kEnd) return;
    energy_ = std::max(energy_, sample.energy);
    heights_.push_back(static_cast<double>(sample.position[2]));
  }
  double energy() const noexcept { return energy_; }
  double swing() const noexcept {
    double swing = 0;
    for (std::size_t i = from_; i < heights_.size(); ++i) {
      const auto begin = heights_.begin() + static_cast<std::ptrdiff_t>(i);
      const auto [low, high] = std::minmax_element(begin, begin + std::min<std::ptrdiff_t>(window_, heights_.end() - begin));
      swing = std::max(swing, *high - *low);
    }
    return swing;
  }

 private:
  std::ptrdiff_t window_;
  std::size_t from_;
  std::vector<double> heights_;  // mm
  double energy_ = 0;
};

inline FeltOnWall felt_on(const HandOnWall& wall) {
  constexpr double kStepRate = 5000;  // Hz: flesh and arm swing at some 20 Hz
  const fast::Law law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = wall.stiffness}));
  Simulated device(wall.model, hand_of(wall), {.step_rate = kStepRate});
  WallWatch watch(wall);
  const std::atomic<bool> never = false;
  FeltOnWall felt;
  felt.run = run_servo_loop(
      device, law,
      {.rate_hz = wall.rate, .max_seconds = wall.seconds, .paced = false, .passivity = wall.passivity, .sinks = {&watch}},
      never);
  felt.energy = watch.energy();
  felt.swing = watch.swing();
  return felt;
}

}  // namespace forceshade::device
