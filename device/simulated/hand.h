// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand on the stylus: where it means to go, how it trembles, and how it gives way.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace forceshade::device {

// Fu and Cavusoglu (2012), the middle of what they found for a stylus grip: the fingers' flesh against the hand's mass, the
// mass against the arm, whose far end is where the hand means to be. N/m, N·s/m, kg.
struct Grip {
  double flesh_stiffness = 575, flesh_damping = 1.3;
  double mass = 0.21;
  double arm_stiffness = 175, arm_damping = 11;
};

// A target in the laws' frame.
struct Target {
  Eigen::Vector3d position{0, 0, 0};  // mm
  Eigen::Vector3d velocity{0, 0, 0};  // mm/s
};

// A path through timed points, at rest before the first and after the last.
class Intention {
 public:
  struct Point {
    double time;               // s
    Eigen::Vector3d position;  // mm
  };
  // Between points: as a hand reaches for each and rests there (Flash and Hogan 1985), or straight, for dense recordings.
  enum class Between { minimum_jerk, straight };

  // At least one point, times never decreasing.
  Intention(std::vector<Point> points, Between between);

  Target at(double time) const noexcept;
  double end() const noexcept { return points_.back().time; }

 private:
  std::vector<Point> points_;
  Between between_;
};

// Down beside a bump of 25.4 mm and to and fro across it, 3 mm below the plane it stands on, for ten minutes.
Intention strokes();

// Physiological tremor, 8 to 12 Hz: tones drawn from the seed, so that the same seed shakes the same hand on any machine.
class Tremor {
 public:
  Tremor(std::uint64_t seed, double rms);  // mm along each axis

  Target at(double time) const noexcept;

 private:
  struct Tone {
    double pulsation, phase, size;  // rad/s, rad, mm
  };
  static constexpr std::size_t kTones = 4;
  std::array<std::array<Tone, kTones>, 3> tones_;
};

}  // namespace forceshade::device
