// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recordings that are made of a law's exact forces, and what they were made with.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "forceshade/subjects.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::tests {

constexpr std::size_t kMadeSamples = 600;

inline Description described(const LawName& law, float stiffness) {
  return {std::string(law.name), DescribedLaw{law.id, {15.24F, 25.4F, stiffness}}};
}

struct Making {
  std::size_t samples = kMadeSamples;
  double rate = 1000;                                // Hz
  double noise = 0;                                  // N, the standard deviation of each component of the force
  double correlation = 0;                            // of the noise of a sample and the next
  double position_noise = 0;                         // mm, the same of each component of the position
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // N
  double lag = 0;                                    // s
};

struct Made {
  conformance::Measurements measured;
  conformance::Placement truth;
};

// A hand that strokes over the bump and its edges, in and out of contact; the frame is turned at random, and shifted by up to
// 100 mm.
inline Made recorded(const Description& description, std::uint64_t seed, const Making& making) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  const Eigen::Matrix3d from =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
  const Eigen::Vector3d origin(number(-100, 100), number(-100, 100), number(-100, 100));
  const auto wave = [&](double size, double hertz) {
    return [size, turns = 2 * std::numbers::pi * hertz * number(0.7, 1.4), begin = number(0, 6)](double time) {
      return size * std::sin(turns * time + begin);
    };
  };
  const auto far_x = wave(14, 3), near_x = wave(2, 7), far_y = wave(10, 2), far_z = wave(3, 5), near_z = wave(1.5, 11);
  const auto hand = [&](double time) {
    const double x = far_x(time) + near_x(time);
    return Eigen::Vector3f(Eigen::Vector3d(x, far_y(time), 2.5 + far_z(time) + near_z(time) - 0.015 * x * x).cast<float>());
  };
  const auto session = properties::subject_of(description)->renderer().open();
  Made made{{"made.csv", {}}, {from.transpose(), -from.transpose() * origin, making.offset, making.lag}};
  Eigen::Vector3d noise = making.noise * vector();
  for (std::size_t i = 0; i < making.samples; ++i) {
    const double time = static_cast<double>(i) / making.rate;
    const Eigen::Vector3d force = session->step(hand(time - making.lag)).force.cast<double>();
    const Eigen::Vector3d position = hand(time).cast<double>() + making.position_noise * vector();
    made.measured.samples.push_back(
        {time, from * position + origin, from * force + making.offset + noise, i + 2, i == 0 ? 0 : 1 / making.rate});
    noise = making.correlation * noise + std::sqrt(1 - making.correlation * making.correlation) * making.noise * vector();
  }
  return made;
}

}  // namespace forceshade::tests
