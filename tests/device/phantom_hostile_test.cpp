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
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "tests/device/stand_in_hd/phantom_fixture.h"

namespace forceshade::device {
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
  const char* words;  // where it is missing and the device is driven all the same; null: nothing depends on it
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

TEST_F(phantom, whatever_its_driver_says_is_refused_or_has_no_wider_limits_and_says_which_are_missing) {
  int refused = 0, opened = 0;
  for (unsigned i = 0, first = seed(); i < 200; ++i) {
    Draws draws(first + i);
    Orders orders{.prints = false};
    draws.draw(orders, kOfTheDevice, 3);
    SCOPED_TRACE(words_of(first, draws.drawn));
    tell(orders);
    Listener listener;
    try {
      const Phantom device("", kPatient, listener);
      const Capabilities can = device.capabilities();
      ++opened;
      EXPECT_TRUE(is_right(orders, kOfTheDevice[0])) << "no peak force";
      EXPECT_FLOAT_EQ(can.peak_force, 0.95F * 8.5F);
      EXPECT_TRUE(can.continuous_force > 0 && can.continuous_force <= 1.4F) << can.continuous_force;
      EXPECT_TRUE((can.workspace_low.array() >= Eigen::Array3f(-190, -137, -95)).all()) << can.workspace_low;
      EXPECT_TRUE((can.workspace_high.array() <= Eigen::Array3f(191, 130, 96)).all()) << can.workspace_high;
      EXPECT_TRUE((can.workspace_high.array() > can.workspace_low.array() + 10).all()) << "so that there is some force";
      // Where they are missing, the supervisor's own hold.
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
  EXPECT_GT(opened, 50);
}

struct Pressed {
  double force = 0;   // N: the most that was sent
  std::string words;  // why it was not driven, or stopped
};

// Ends a run that has been in contact for long enough to be pressed home, and whose arm then feels a force, if it feels one in
// 2000 ticks. The hand moves, and the force acts, with the driver's frames, of which a machine may make fewer than ticks, so
// that a run of a fixed length may end before the contact, and one of 200 ticks of contact before the force.
struct UntilPressed final : SampleSink {
  void push(const Sample& sample) noexcept override {
    if (sample.status == static_cast<std::uint8_t>(Status::contact) && ++contacts % 200 == 0)
      stop = contacts >= 2000 || !stand_in_hd::arm().force.isZero();
  }
  int contacts = 0;
  std::atomic<bool> stop = false;
};

// A hand presses 2 mm into a wall that answers with 16 N. A device that counts its frames wrong is never ready.
Pressed pressed(const Orders& orders, Listener& listener) {
  Phantom::Options options = kPatient;
  if (orders.instantaneous_rate.how == Answer::How::value) options.start = 4s;
  tell(orders);
  const std::size_t before = seen().frames.size();
  Pressed outcome;
  try {
    const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 8}));
    Phantom device("", options, listener);
    UntilPressed until;
    const ServoResult run =
        run_servo_loop(device, law, {.max_seconds = 600, .watchdog_timeout = 10, .sinks = {&until}}, until.stop);
    outcome.words = run.end_reason == EndReason::tripped ? std::string(name_of(run.trip->rule)) : run.fault;
  } catch (const DeviceError& error) {
    outcome.words = error.what();
  }
  const auto frames = seen().frames;
  for (std::size_t k = before; k < frames.size(); ++k) outcome.force = std::max(outcome.force, frames[k].force.norm());
  return outcome;
}

TEST_F(phantom, is_pressed_also_by_few_frames) {
  Listener nobody;
  const Pressed slow = pressed({.instantaneous_rate = 1000, .frame_hz = 300, .press = true}, nobody);
  EXPECT_GT(slow.force, 1) << slow.words;
}

TEST_F(phantom, whatever_its_driver_says_gives_no_more_force_than_with_the_strictest_answers) {
  Listener nobody;
  const Pressed right = pressed({.press = true}, nobody);
  EXPECT_GT(right.force, 1) << right.words;
  const double most = 0.95 * 8.5 * (1 + 1e-6);
  EXPECT_LE(right.force, most);
  for (unsigned i = 0, first = seed(); i < 6; ++i) {
    Draws draws(first + i);
    Orders orders{.press = true};
    draws.draw(orders, kOfTheDevice, 4);
    draws.draw(orders, kOfFrames, 3);
    orders.peak_force = {};  // else nothing more would be tried
    SCOPED_TRACE(words_of(first, draws.drawn));
    Listener listener;
    const Pressed outcome = pressed(orders, listener);
    EXPECT_LE(outcome.force, most);
    EXPECT_TRUE(outcome.force > 0 || !outcome.words.empty() || orders.temperature.value > 1) << "no force, and no words";
    for (const Capability& capability : kOfTheDevice)
      if (capability.words && !is_right(orders, capability)) expect_words(listener.heard, {capability.words});
    // A temperature that is one too high leaves no force; any other that is wrong ends the run, or is said.
    const Capability& temperature = kOfFrames[0];
    if (outcome.words.empty() && !is_right(orders, temperature)) {
      const Answer& given = orders.temperature;
      const bool is_one = given.how == Answer::How::value && given.value >= 0 && std::isfinite(given.value);
      EXPECT_TRUE(is_one || listener.heard.find(temperature.words) != std::string::npos) << listener.heard;
      if (given.value > 1) {
        EXPECT_EQ(outcome.force, 0);
      }
    }
  }
}

}  // namespace
}  // namespace forceshade::device
