// SPDX-License-Identifier: BSD-3-Clause
// A driver that says anything at all of its device: right, nonsense, an error, or nothing. The device is refused in words; or
// it is driven with no more force than with the strictest answers that make sense, and words about every limit that is missing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "forceshade/device.h"
#include "tests/world/phantom_fixture.h"

namespace forceshade::world {
namespace {

// The same in each run, but where the environment says another.
unsigned seed() {
  const char* given = std::getenv("FORCESHADE_TEST_SEED");
  return given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : 1;
}

// For the trace of a failure, which every log of it has.
std::string words_of(unsigned seed, const std::string& drawn) {
  return "FORCESHADE_TEST_SEED=" + std::to_string(seed) + ": " + drawn;
}

struct Capability {
  const char* what;
  Answer Orders::*order;
  const char* words;  // if it is missing and the device is driven all the same; null: nothing depends on it
};

// As hdInitDevice's caller reads them, and in frames.
const std::vector<Capability> kOfTheDevice{{"peak force", &Orders::peak_force, nullptr},
                                           {"continuous force", &Orders::continuous_force, "continuous force: "},
                                           {"workspace", &Orders::workspace, "workspace: "},
                                           {"velocity limit", &Orders::velocity_limit, "highest velocity: "},
                                           {"impulse", &Orders::impulse_limit, "change of force"},
                                           {"update rate", &Orders::update_rate, nullptr},
                                           {"input degrees", &Orders::input_degrees, nullptr}};
const std::vector<Capability> kOfFrames{{"temperature", &Orders::temperature, "motor temperatures"},
                                        {"encoders", &Orders::encoders, nullptr},
                                        {"joint angles", &Orders::joint_angles, nullptr},
                                        {"instantaneous rate", &Orders::instantaneous_rate, nullptr}};

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}

  // One in `right` is wrong, the others right.
  void draw(Orders& orders, const std::vector<Capability>& capabilities, int right) {
    for (const Capability& capability : capabilities) {
      const int kind = wrong(right);
      orders.*capability.order = kAnswers[static_cast<std::size_t>(kind)];
      drawn += std::string(drawn.empty() ? "" : ", ") + capability.what + " " + kNames[static_cast<std::size_t>(kind)];
    }
  }

  std::string drawn;  // in words

 private:
  static inline const std::vector<Answer> kAnswers{Answer(),
                                                   0.0,
                                                   -1.0,
                                                   std::nan(""),
                                                   HUGE_VAL,
                                                   1e300,
                                                   Answer::fails(hdapi::kInvalidEnum),
                                                   Answer::fails(hdapi::kDeviceFault),
                                                   Answer::nothing()};
  static inline const std::vector<const char*> kNames{"right", "0",       "-1",    "NaN",        "infinite",
                                                      "1e300", "unknown", "error", "not written"};

  int wrong(int right) {
    if (std::uniform_int_distribution<>(1, right)(random_) > 1) return 0;
    return std::uniform_int_distribution<>(1, static_cast<int>(kAnswers.size()) - 1)(random_);
  }

  std::mt19937 random_;
};

bool is_right(const Orders& orders, const Capability& capability) {
  return (orders.*capability.order).how == Answer::How::right;
}

IN_WORLD(whatever_its_driver_says_is_refused_or_has_no_wider_limits_and_says_which_are_missing) {
  int refused = 0, accepted = 0;
  for (unsigned i = 0, first = seed(); i < 200; ++i) {
    Draws draws(first + i);
    Orders orders;
    draws.draw(orders, kOfTheDevice, 3);
    SCOPED_TRACE(words_of(first, draws.drawn));
    tell(orders);
    Attends listener;
    try {
      Phantom device = opened(kPatient, listener);
      const Capabilities can = device.capabilities();
      ++accepted;
      EXPECT_TRUE(is_right(orders, kOfTheDevice[0])) << "no peak force";
      EXPECT_FLOAT_EQ(can.peak_force, 0.95F * 8.5F);
      EXPECT_TRUE(can.continuous_force > 0 && can.continuous_force <= 1.4F) << can.continuous_force;
      EXPECT_TRUE((can.workspace_low.array() >= Eigen::Array3f(-190, -137, -95)).all()) << can.workspace_low;
      EXPECT_TRUE((can.workspace_high.array() <= Eigen::Array3f(191, 130, 96)).all()) << can.workspace_high;
      EXPECT_TRUE((can.workspace_high.array() > can.workspace_low.array() + 10).all()) << "so that there is some force";
      // The supervisor's own limits hold if they are missing.
      EXPECT_EQ(std::isfinite(can.highest_speed), is_right(orders, kOfTheDevice[3]));
      EXPECT_EQ(std::isfinite(can.highest_slew), is_right(orders, kOfTheDevice[4]));
      EXPECT_GT(can.highest_rate, 0);
    } catch (const DeviceError& error) {
      ++refused;
      expect_words(error.what(), {"the PHANToM's highest force: expected"});
      continue;
    }
    for (const Capability& capability : kOfTheDevice) {
      if (!capability.words) continue;
      EXPECT_EQ(listener.heard.find(capability.words) == std::string::npos, is_right(orders, capability))
          << capability.what << "\n"
          << listener.heard;
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(accepted, 50);
}

// A hand presses 1 mm into a wall that would answer with more than the device's highest force.
TEST(hostile_phantom, whatever_its_driver_says_breaks_no_rule_and_ends_in_words) {
  Plan plan;
  plan.stiffness = 8;
  double most = 0;
  for (unsigned i = 0, first = seed(); i < 200; ++i) {
    Draws draws(first + i);
    OpenPhantom open{.options = {.start = 1s}};
    if (i > 0) draws.draw(open.orders, kOfTheDevice, 4);
    if (i > 0) draws.draw(open.orders, kOfFrames, 3);
    open.orders.peak_force = 3.0;  // else nothing more would be tried
    SCOPED_TRACE(words_of(first, draws.drawn));
    const Outcome outcome = session(plan, open);
    for (const Violation& violation : outcome.violations) ADD_FAILURE() << "rule " << violation.rule << ": " << violation.words;
    most = std::max(most, outcome.peak);
    if (i == 0) {
      EXPECT_GT(outcome.peak, 1) << outcome.words();
    }
    const std::string& heard = OpenPhantom::attends().heard;
    for (const Capability& capability : kOfTheDevice)
      if (capability.words && !is_right(open.orders, capability)) expect_words(heard, {capability.words});
    // A temperature that is one too high leaves no force; any other that is wrong ends the run, or is reported.
    const Capability& temperature = kOfFrames[0];
    if (outcome.result.end_reason != EndReason::time_up || is_right(open.orders, temperature)) continue;
    const Answer& given = open.orders.temperature;
    const bool is_one = given.how == Answer::How::value && given.value >= 0 && std::isfinite(given.value);
    EXPECT_TRUE(is_one || heard.find(temperature.words) != std::string::npos) << heard;
    if (given.value > 1) {
      EXPECT_EQ(outcome.peak, 0);
    }
  }
  std::printf("  %.3f N at most\n", most);
}

}  // namespace
}  // namespace forceshade::world
