// SPDX-License-Identifier: BSD-3-Clause
// The watch of a device without force: its measurements and the words that report them.

#include "device/quiet_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "device/check.h"
#include "device/simulated/model.h"
#include "forceshade/device.h"

namespace forceshade::device {
namespace {

const std::atomic<bool> kNever{false};
constexpr double kRate = 1000;

// Gives scripted readings, and notes what is commanded.
class Scripted final : public Device {
 public:
  Scripted(Capabilities capabilities, std::function<ReadResult(std::size_t)> reading)
      : capabilities_(capabilities), reading_(std::move(reading)) {}

  Capabilities capabilities() const noexcept override { return capabilities_; }
  std::optional<Fault> start(double) noexcept override { return fault_; }
  ReadResult read() noexcept override { return reading_(readings_++); }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override {
    ++waits;
    return deadline;
  }
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    commanded = force;
    most = std::max(most, force.norm());
    return refusal_;
  }
  State state() const noexcept override { return state_; }

  Eigen::Vector3f commanded{0, 0, 0};
  float most = 0;
  int waits = 0;
  std::optional<Fault> fault_, refusal_;
  State state_;

 private:
  Capabilities capabilities_;
  std::function<ReadResult(std::size_t)> reading_;
  std::size_t readings_ = 0;
};

double at(std::size_t k) {
  return static_cast<double>(k) / kRate;
}

Reading steady(std::size_t k) {
  return {.time = at(k)};
}

// Its frames set the pace, so that the tests take no time.
const Capabilities kDevice{.model = "Touch", .paces = true, .buttons = 4};

Observed observed(const std::function<ReadResult(std::size_t)>& reading, double seconds = 0.2) {
  Scripted device(kDevice, reading);
  const Observed seen = observe_without_force(device, kRate, seconds, kNever);
  EXPECT_EQ(device.most, 0);
  EXPECT_GT(device.waits, 0);
  return seen;
}

Check check(const std::string& name, const Observed& seen, const Capabilities& capabilities = kDevice, double rate = kRate) {
  for (const Check& one : check_readings(seen, capabilities, rate))
    if (one.name == name) return one;
  ADD_FAILURE() << "no check " << name;
  return {};
}

void expect(const Check& check, Grade grade, const std::string& words) {
  EXPECT_EQ(name_of(check.grade), name_of(grade)) << check.words;
  EXPECT_NE(check.words.find(words), std::string::npos) << words << '\n' << check.words;
}

TEST(quiet_watch, measures_the_rate_and_the_gaps_by_the_devices_clock) {
  const Observed even = observed(steady);
  EXPECT_EQ(even.readings, 201U);
  EXPECT_NEAR(even.seconds, 0.2, 1e-12);
  EXPECT_NEAR(even.rate, 1000, 1e-6);
  EXPECT_NEAR(even.jitter, 0, 1e-6);
  EXPECT_NEAR(even.longest_gap, 1, 1e-6);
  expect(check("update rate", even), Grade::ok, "1000.0 readings a second");

  // Every other reading half a millisecond late: gaps of 1.5 and 0.5 ms.
  const Observed uneven = observed([](std::size_t k) { return Reading{.time = at(k) + (k % 2 == 1 ? 0.0005 : 0)}; });
  EXPECT_NEAR(uneven.rate, 1000, 1e-6);
  EXPECT_NEAR(uneven.jitter, 0.5, 1e-6);
  EXPECT_NEAR(uneven.longest_gap, 1.5, 1e-6);
}

TEST(quiet_watch, counts_a_reading_that_is_read_twice_once) {
  const Observed slow = observed([](std::size_t k) { return Reading{.time = at(2 * (k / 2))}; });
  EXPECT_EQ(slow.readings, 101U);
  EXPECT_NEAR(slow.rate, 500, 1e-6);
  expect(check("update rate", slow), Grade::wrong, "expected 1000 within 5 %");
  expect(check("update rate", slow, kDevice, 500), Grade::ok, "500.0 readings");
}

TEST(quiet_watch, finds_a_gap_after_which_a_run_is_stopped) {
  const auto with_gap = [](double gap) {
    return observed([gap](std::size_t k) { return Reading{.time = at(k) + (k > 500 ? gap : 0)}; }, 1);
  };
  expect(check("update rate", with_gap(0.018)), Grade::ok, "longest gap 19.000 ms");
  expect(check("update rate", with_gap(0.020)), Grade::wrong, "after 20 ms");
}

TEST(quiet_watch, finds_a_device_that_stands_still) {
  const Observed frozen = observed([](std::size_t) { return Reading{}; });
  EXPECT_EQ(frozen.rate, 0);
  expect(check("update rate", frozen), Grade::wrong, "does not answer");
}

TEST(quiet_watch, shows_the_drivers_own_count_of_the_rate) {
  Observed seen = observed(steady);
  EXPECT_EQ(check("update rate", seen).words.find("driver counts"), std::string::npos);
  seen.state.update_rate = 1003;
  expect(check("update rate", seen), Grade::ok, "the driver counts 1003 a second");
}

TEST(quiet_watch, measures_the_noise_of_an_arm_at_rest_only) {
  // By ±0.1 mm along y, from tick to tick.
  const auto shaking = [](float size) {
    return observed([size](std::size_t k) { return Reading{.position = {7, k % 2 == 0 ? size : -size, -3}, .time = at(k)}; });
  };
  const Observed quiet = shaking(0.1F);
  EXPECT_NEAR(quiet.noise.y(), 0.1, 1e-4);
  EXPECT_NEAR(quiet.extent.y(), 0.2, 1e-6);
  EXPECT_EQ(quiet.noise.x(), 0);
  expect(check("noise at rest", quiet), Grade::ok, "peak to peak (0.0000, 0.2000, 0.0000) mm");
  expect(check("noise at rest", shaking(0.26F)), Grade::unknown, "the arm moved by (0.00, 0.52, 0.00) mm");
}

TEST(quiet_watch, sees_encoders_at_rest_moving_and_stuck) {
  const auto counting = [](std::int64_t step, float speed) {
    return observed([=](std::size_t k) {
      const auto i = static_cast<std::int64_t>(k);
      return Reading{
          .position = {speed * static_cast<float>(k), 0, 0}, .time = at(k), .encoder = {{0, step * i, -2 * step * i}}};
    });
  };
  expect(check("encoders", counting(0, 0)), Grade::ok, "at rest");
  expect(check("encoders", counting(1, 0.1F)), Grade::ok, "moving: over 0, 200 and 400 counts");
  expect(check("encoders", counting(0, 0.1F)), Grade::wrong, "the position moved and no count changed");
  expect(check("encoders", observed(steady)), Grade::unknown, "shows none");
  const float nan = std::nanf("");
  expect(check("encoders", observed([=](std::size_t k) {
                 return Reading{.position = {0, nan, 0}, .time = at(k)};
               })),
         Grade::wrong, "not a number");
}

// Moves every joint.
Joints angles(std::size_t k) {
  const double t = at(k);
  return {0.3 * std::sin(9 * t), 0.2 + 0.1 * std::sin(7 * t), 0.1 * std::cos(5 * t)};
}

Observed with_joints(const Model& model, double turret, double away) {
  return observed([&model, turret, away](std::size_t k) {
    const Joints q = angles(k);
    const Eigen::Vector3d tip = turned_to_law(model.arm.forward(q)) / kMillimetre + Eigen::Vector3d(away, 0, 0);
    return Reading{.position = tip.cast<float>(), .time = at(k), .joints = {{turret * q[0], q[1], q[2]}}};
  });
}

TEST(quiet_watch, compares_positions_with_our_kinematics_of_the_joint_angles) {
  expect(check("kinematics", with_joints(omni(), 1, 0)), Grade::ok, "0.000 mm from");
  expect(check("kinematics", with_joints(omni(), -1, 0)), Grade::ok, "the turret's angle counted to the left");
  expect(check("kinematics", with_joints(omni(), 1, 4.9)), Grade::ok, "4.9");
  expect(check("kinematics", with_joints(omni(), 1, 5.1)), Grade::wrong, "calibrate");
  expect(check("kinematics", with_joints(premium_1_5(), 1, 0)), Grade::wrong, "set up for this model");
  expect(check("kinematics", observed(steady)), Grade::unknown, "no joint angles");
  // One angle that is no number is found out, wherever it comes.
  for (const std::size_t when : {std::size_t{0}, std::size_t{20}}) {
    const Observed seen = observed([when](std::size_t k) {
      const Joints q = angles(k);
      const Eigen::Vector3d tip = turned_to_law(omni().arm.forward(q)) / kMillimetre;
      return Reading{.position = tip.cast<float>(), .time = at(k), .joints = {{q[0], k == when ? std::nan("") : q[1], q[2]}}};
    });
    expect(check("kinematics", seen), Grade::wrong, "is not a number");
  }
  expect(check("kinematics", with_joints(omni(), 1, 0), {.model = "Phantom Desktop"}), Grade::unknown, "\"Phantom Desktop\"");
}

TEST(quiet_watch, finds_models_by_what_drivers_call_them) {
  for (const auto& [name, expected] : {std::pair{"PHANTOM Omni", "omni"},
                                       {"Geomagic Touch", "omni"},
                                       {"Touch USB", "omni"},
                                       {"Geomagic Touch X", "none"},
                                       {"PHANTOM Premium 1.5", "premium-1.5"},
                                       {"PHANTOM Premium 1.0", "premium-1.0"},
                                       {"PHANTOM Premium 3.0", "none"},
                                       {"premium-1.5", "premium-1.5"},
                                       {"premium-1.0", "premium-1.0"},
                                       {"omni", "omni"}}) {
    const auto model = model_named(name);
    EXPECT_EQ(model ? model->name : "none", expected) << name;
  }
}

TEST(quiet_watch, shows_the_buttons_that_were_pressed_and_released) {
  const Observed seen = observed([](std::size_t k) {
    const unsigned held = 1U, pressed = k > 50 ? 2U : 0U, both = k > 90 && k < 100 ? 8U : 0U;
    return Reading{.time = at(k), .buttons = static_cast<std::uint16_t>(held | pressed | both)};
  });
  expect(check("buttons", seen), Grade::ok, "pressed: 1, 3; released: 3");
  expect(check("buttons", observed(steady)), Grade::ok, "none was pressed");
  expect(check("buttons", seen, {.model = "x", .buttons = 0}), Grade::unknown, "has none");
}

TEST(quiet_watch, ends_with_the_words_of_a_fault) {
  const auto lost = [](std::size_t k) -> ReadResult {
    if (k == 20) return Fault{"the cable is out"};
    return Reading{.time = at(k)};
  };
  EXPECT_EQ(observed(lost).readings, 20U);
  expect(check("readings", observed(lost)), Grade::wrong, "the cable is out");
  Scripted refuses(kDevice, lost);
  refuses.fault_ = Fault{"no power"};
  expect(check("readings", observe_without_force(refuses, kRate, 0.1, kNever)), Grade::wrong, "no power");
  // The zero at the end is refused; what went wrong before it is said instead.
  for (const auto& [cable_is_out, words] : {std::pair{false, "no zero was sent"}, {true, "the cable is out"}}) {
    Scripted closed(kDevice, [&, is_fault = cable_is_out](std::size_t k) -> ReadResult {
      if (k < 20) return Reading{.time = at(k)};
      closed.refusal_ = Fault{"no zero was sent"};
      return is_fault ? ReadResult(Fault{"the cable is out"}) : EndOfData{};
    });
    expect(check("readings", observe_without_force(closed, kRate, 0.1, kNever)), Grade::wrong, words);
  }
  const Observed over = observed([](std::size_t) -> ReadResult { return EndOfData{}; });
  expect(check("readings", over), Grade::wrong, "gave none");
}

TEST(quiet_watch, says_that_a_device_is_not_calibrated) {
  Scripted device(kDevice, steady);
  expect(check("calibration", observe_without_force(device, kRate, 0.1, kNever)), Grade::ok, "is calibrated");
  device.state_.calibrated = false;
  expect(check("calibration", observe_without_force(device, kRate, 0.1, kNever)), Grade::wrong, "not calibrated");
}

TEST(quiet_watch, stops_when_the_flag_is_set) {
  const std::atomic<bool> at_once{true};
  Scripted device(kDevice, steady);
  EXPECT_EQ(observe_without_force(device, kRate, 5, at_once).readings, 0U);
}

// A law may want any force: no more than the peak reaches the device.
TEST(limited, lets_no_more_than_its_peak_pass) {
  auto owned =
      std::make_unique<Scripted>(Capabilities{.model = "x", .peak_force = 8, .continuous_force = 0.25F, .buttons = 2}, steady);
  Scripted& device = *owned;
  Limited limited(std::move(owned), 0.5F);
  EXPECT_EQ(limited.capabilities().peak_force, 0.5F);
  EXPECT_EQ(limited.capabilities().continuous_force, 0.25F);
  EXPECT_EQ(limited.capabilities().buttons, 2);
  const Limited lower(std::make_unique<Scripted>(Capabilities{.peak_force = 8, .continuous_force = 2}, steady), 0.5F);
  EXPECT_EQ(lower.capabilities().continuous_force, 0.5F) << "no more than the peak for ever";
  EXPECT_EQ(limited.command({0.25F, 0, 0.375F}), std::nullopt);
  EXPECT_EQ(device.commanded, Eigen::Vector3f(0.25F, 0, 0.375F));
  limited.command({3, 0, 4});
  EXPECT_LE(device.commanded.norm(), 0.5F);
  EXPECT_GT(device.commanded.norm(), 0.4999F);
  EXPECT_NEAR(device.commanded.x() / device.commanded.z(), 0.75, 1e-6);
  limited.command({std::nanf(""), 0, 0});
  EXPECT_TRUE(std::isnan(device.commanded.x()));
}

}  // namespace
}  // namespace forceshade::device
