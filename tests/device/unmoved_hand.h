// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand for tests of the passivity controller, which the force does not move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "device/passivity_controller.h"
#include "forceshade/fast.h"
#include "properties/field_properties.h"
#include "tests/device/chatter.h"
#include "tests/support/drawn.h"

namespace forceshade::device {

using Kind = Passivity;
using Position = Eigen::Vector3d;

inline constexpr Parameters kBump{.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F};
inline constexpr double kRounding = 1e-7;  // mJ: what ten minutes' sums may be off by

inline std::string words_of(LawId id) {
  return std::string(name_of(id));
}

inline const char* words_of(Kind kind) {
  return name_of(kind).data();
}

inline fast::Law law_of(LawId id, const Parameters& parameters = kBump) {
  return std::get<fast::Law>(fast::Law::build(id, parameters));
}

// On its own, because g++ 12 at -O3 was seen to leave out the rounding of a number that is widened again.
[[gnu::noinline]] inline Eigen::Vector3f rounded(const Position& position) {
  return position.cast<float>();
}

// A hand that the force does not move, and an account of its own to hold against the controller's. With latency the forces
// pass through a device's frames, one a tick, which clamp them and report.
class Hand {
 public:
  Hand(const fast::Law& law, Kind kind, const PassivitySettings& settings = passivity_settings({}, 1000))
      : controller(settings, kind), settings(settings), law_(law) {}

  void go_to(const Position& position) {
    Reading reading{.position = rounded(position)};
    const Position here = reading.position.cast<double>();
    if (begun_) {
      balance -= acting.cast<long double>().dot(here.cast<long double>() - at.cast<long double>());
      lowest = std::min(lowest, balance);
    }
    begun_ = true;
    at = here;
    if (settings.latency) {
      frames_.arrived(here);
      acting = frames_.send(force.cast<double>());
      reading.sent = frames_.report();
    }
    desired = law_.force(reading.position);
    force = controller.limited(reading, desired);
    frames_.allow(controller.allowance());
    if (!settings.latency) acting = force.cast<double>();
    lengthened |= force.cast<double>().norm() > (1 + 1e-15) * desired.cast<double>().norm();  // two ways to sum
    chatter.next(force, desired);
  }
  // Straight there, in equal steps of at most `step` mm.
  void go_to(const Position& position, double step) {
    const Position from = at;
    const int steps = std::max(1, static_cast<int>(std::ceil((position - from).norm() / step)));
    for (int i = 1; i <= steps; ++i) go_to(from + (position - from) * (static_cast<double>(i) / steps));
  }
  void go_round(const std::vector<properties::PathPoint>& loop, double step) {
    for (const auto& [x, z] : loop) go_to({x, 0, z}, step);
    go_to({loop.front().x, 0, loop.front().z}, step);
  }

  PassivityController controller;
  PassivitySettings settings;
  Position at{0, 0, 0};  // mm
  Eigen::Vector3f desired{0, 0, 0}, force{0, 0, 0};
  Position acting{0, 0, 0};             // N, from this reading to the next
  long double balance = 0, lowest = 0;  // mJ
  bool lengthened = false;              // some force was longer than the desired one
  tests::Chatter chatter;

 private:
  fast::Law law_;
  bool begun_ = false;
  SentForces frames_;
};

// Out at the depth D, up just beyond the edge, back along the surface, down.
inline std::vector<properties::PathPoint> stroke(const Parameters& p, double depth) {
  const double edge = 0.5 * static_cast<double>(p.width) + 0.01;
  return {{0, 0}, {0, -depth}, {edge, -depth}, {edge, 0}};
}

// Cases of a property, property(random), up to the first that fails.
template <class Property>
void expect_for_all(const std::string& what, unsigned seed, std::size_t cases, const Property& property) {
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < tests::drawn(cases) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(what + ", case " + std::to_string(i));
    property(random);
  }
}

inline int drawn_from(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

}  // namespace forceshade::device
