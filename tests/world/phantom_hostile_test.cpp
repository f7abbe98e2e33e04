// SPDX-License-Identifier: BSD-3-Clause
// A driver that says anything at all of its device: right, nonsense, an error, or nothing. It is driven under every rule, with
// words about each limit that is missing. That no limit is wider then is phantom_limits_test's.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// A hand presses 1 mm into a wall that would answer with more than the device's highest force.
TEST(hostile_phantom, whatever_its_driver_says_breaks_no_rule_and_ends_in_words) {
  Plan plan;
  plan.stiffness = 8;
  for (unsigned i = 0, first = seed(); i < 200; ++i) {
    Draws draws(first + i);
    OpenPhantom open{.options = {.start = 1s}};
    if (i > 0) draws.draw(open.orders, kOfTheDevice, 4);
    if (i > 0) draws.draw(open.orders, kOfFrames, 3);
    open.orders.peak_force = 3.0;  // else nothing more would be tried
    SCOPED_TRACE("FORCESHADE_TEST_SEED=" + std::to_string(first) + ": " + draws.drawn);
    const Outcome outcome = session(plan, open);
    for (const Violation& violation : outcome.violations) ADD_FAILURE() << "rule " << violation.rule << ": " << violation.words;
    if (i == 0) {
      EXPECT_GT(outcome.peak, 1) << outcome.words();
    }
    const std::string& heard = OpenPhantom::attends().heard;
    const auto is_right = [&](const Capability& its) { return (open.orders.*its.order).how == Answer::How::right; };
    for (const Capability& capability : kOfTheDevice)
      if (capability.words && !is_right(capability)) expect_words(heard, {capability.words});
    // A temperature that is one too high leaves no force; any other that is wrong ends the run, or is reported.
    const Capability& temperature = kOfFrames[0];
    if (outcome.result.end_reason != EndReason::time_up || is_right(temperature)) continue;
    const Answer& given = open.orders.temperature;
    const bool is_one = given.how == Answer::How::value && given.value >= 0 && std::isfinite(given.value);
    EXPECT_TRUE(is_one || heard.find(temperature.words) != std::string::npos) << heard;
    if (given.value > 1) {
      EXPECT_EQ(outcome.peak, 0);
    }
  }
}

}  // namespace
}  // namespace forceshade::world
