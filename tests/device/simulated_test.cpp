// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/simulated.h"

#include <gtest/gtest.h>
#include <time.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "files/csv.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "tests/device/each_model.h"
#include "tests/support/kept_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

const Joints kReset{0, 0, 0};

// A counterbalanced Premium 1.5 without friction, and without the steps of its encoders and its amplifier.
Model frictionless() {
  Model model = counterbalanced(premium_1_5());
  model.coulomb.setZero();
  model.viscous.setZero();
  model.quantum.setZero();
  model.motor.amplifier_bits = 0;
  return model;
}

Operator hand_towards(std::vector<Intention::Point> points) {
  return {Grip{}, Intention(std::move(points), Intention::Between::minimum_jerk), Tremor(1, 0), false};
}

Reading read(Device& device) {
  return std::get<Reading>(device.read());
}

TEST(model, resolves_what_its_sheet_says) {
  for_each_model([](const Model& model) {
    const Eigen::Array3d steps = model.arm.jacobian(kReset).colwise().norm().transpose().cwiseProduct(model.quantum);
    const double sheet = model.sheet.resolution * kMillimetre;
    EXPECT_LE(steps.maxCoeff(), sheet * 1.0001);
    EXPECT_GE(steps.minCoeff(), 0.75 * sheet);
  });
}

TEST(model, pushes_as_hard_as_its_sheet_says) {
  for_each_model([](const Model& model) {
    const Eigen::Array3d force_per_torque =
        model.gears.array() / model.arm.jacobian(kReset).colwise().norm().transpose().array();
    const Eigen::Array3d peak = model.motor.stall * force_per_torque, continuous = model.motor.continuous * force_per_torque;
    EXPECT_NEAR(peak.maxCoeff(), model.sheet.peak_force, 0.01 * model.sheet.peak_force);
    EXPECT_GE(peak.minCoeff(), 0.79 * model.sheet.peak_force);
    EXPECT_GE(continuous.minCoeff(), 0.999 * model.sheet.continuous_force);
    EXPECT_LE(continuous.maxCoeff(), 1.35 * model.sheet.continuous_force);
  });
}

TEST(model, has_the_backdrive_friction_of_its_sheet) {
  for_each_model([](const Model& model) {
    const Joints levers = model.arm.jacobian(kReset).colwise().norm();
    EXPECT_LE((model.coulomb.cwiseQuotient(levers).array() - model.sheet.friction).abs().maxCoeff(), 1e-15);
  });
}

// 0.1 N at most is left to the hand by the 1.5's motors, and with springs nothing.
TEST(model, is_balanced_almost_by_its_motors_and_wholly_by_springs) {
  const auto felt = [](const Model& model) {
    return (model.arm.jacobian(kReset).transpose().inverse() * model.arm.gravity(kReset)).norm();
  };
  EXPECT_NEAR(felt(premium_1_5()), 0.076, 0.001);
  EXPECT_EQ(felt(counterbalanced(premium_1_5())), 0);
  EXPECT_EQ(felt(omni()), 0);
}

TEST(simulated, says_what_its_sheet_says) {
  const Capabilities can = Simulated(omni(), std::nullopt).capabilities();
  EXPECT_EQ(can.model, "omni");
  EXPECT_EQ(can.workspace_high, Eigen::Vector3f(80, 35, 60));
  EXPECT_EQ(can.workspace_low, -can.workspace_high);
  EXPECT_EQ(can.peak_force, 3.3F);
  EXPECT_EQ(can.continuous_force, 0.88F);
  EXPECT_EQ(can.resolution, 0.055F);
  EXPECT_EQ(can.friction, 0.26F);
  EXPECT_TRUE(can.latency);
  EXPECT_FALSE(Simulated(omni(), std::nullopt, {.latency = false}).capabilities().latency);
}

TEST(simulated, gives_no_position_and_no_force_before_it_is_started) {
  Simulated device(premium_1_5(), std::nullopt);
  EXPECT_FALSE(device.state().forces_on);
  EXPECT_STREQ(std::get<Fault>(device.read()).words, "the simulated device was not started");
  EXPECT_FALSE(device.start(1000));
  EXPECT_TRUE(device.state().forces_on);
}

TEST(simulated, starts_in_the_hand) {
  for_each_model([](const Model& model) {
    Simulated device(model, hand_towards({{0, {-20, 5, 10}}}));
    ASSERT_FALSE(device.start(1000));
    EXPECT_LE((device.tip() - Eigen::Vector3d(-20, 5, 10)).norm(), 1e-12);
    EXPECT_LE((read(device).position - Eigen::Vector3f(-20, 5, 10)).norm(), model.sheet.resolution);
  });
}

TEST(simulated, refuses_a_hand_that_starts_out_of_reach) {
  Simulated device(premium_1_5(), hand_towards({{0, {500, 0, 0}}}));
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->words, "the simulated hand starts where the arm does not reach");
}

TEST(simulated, sees_its_joints_in_whole_counts) {
  const Model model = premium_1_5();
  Simulated device(model, Operator{Grip{}, strokes(), Tremor(1, 0.03), false});
  device.start(1000);
  double farthest = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const Reading reading = read(device);
    const Eigen::Vector3d seen = reading.position.cast<double>();
    farthest = std::max(farthest, (seen - device.tip()).norm());
    const auto angles = model.arm.inverse(kMillimetre * turned_to_arm(seen));
    ASSERT_TRUE(angles);
    // A binary32 position of 20 mm is 1e-6 mm wide, some thousandths of a count.
    const Eigen::Array3d counts = angles->cwiseQuotient(model.quantum);
    ASSERT_LE((counts - counts.round()).abs().maxCoeff(), 5e-3);
    ASSERT_TRUE(reading.encoder);
    for (int i = 0; i < 3; ++i) ASSERT_EQ((*reading.encoder)[static_cast<std::size_t>(i)], std::llround(counts[i]));
  }
  EXPECT_LE(farthest, model.sheet.resolution);
  EXPECT_GE(farthest, 0.3 * model.sheet.resolution);
}

// One newton from the first reading on: half of F T²/m after the first period that feels it, two of it after the next.
TEST(simulated, feels_a_command_one_sample_late_and_holds_it) {
  for (const bool latency : {false, true}) {
    const Model model = frictionless();
    Simulated device(model, std::nullopt, {.latency = latency});
    device.start(1000);
    std::vector<double> up;
    for (int k = 0; k < 4; ++k) {
      up.push_back(static_cast<double>(read(device).position.z()));
      device.command(k == 0 ? Eigen::Vector3f(0, 0, 1) : Eigen::Vector3f(0, 0, 0));
    }
    const double step = 1e3 * 1e-6 / 2 / apparent_mass(model.arm, kReset)(1, 1);  // mm
    const std::vector<double> after{0, step, 3 * step, 5 * step};
    for (std::size_t k = 0; k < 4; ++k) {
      const double expected = latency ? (k == 0 ? 0 : after[k - 1]) : after[k];
      EXPECT_NEAR(up[k], expected, 1e-3 * step) << k << latency;
    }
  }
}

// One newton up from the first reading on, half of it later; a millijoule is a newton over a millimetre.
TEST(simulated, reports_what_it_sent_and_the_work_that_did) {
  for (const bool latency : {false, true}) {
    Simulated device(frictionless(), std::nullopt, {.latency = latency});
    device.start(1000);
    double before = 0, work = 0;
    for (int k = 0; k < 6; ++k) {
      const Reading reading = read(device);
      ASSERT_TRUE(reading.sent);
      const auto sent_at = [&](int reading_number) {  // the command that answers a reading
        return reading_number < 0 ? 0.0F : reading_number < 3 ? 1.0F : 0.5F;
      };
      const int late = latency ? 1 : 0;
      EXPECT_EQ(reading.sent->acted.z(), sent_at(k - 1 - late)) << k;
      EXPECT_EQ(reading.sent->acting.z(), latency ? sent_at(k - 1) : 0) << k;
      work += static_cast<double>(sent_at(k - 1 - late)) * (static_cast<double>(reading.position.z()) - before);
      before = static_cast<double>(reading.position.z());
      EXPECT_NEAR(reading.sent->work, work, 1e-12) << k;
      device.command({0, 0, sent_at(k)});
    }
    EXPECT_GT(work, 0);
  }
}

TEST(simulated, sends_no_more_than_it_is_allowed) {
  for (const bool latency : {false, true}) {
    Simulated device(frictionless(), std::nullopt, {.latency = latency});
    device.start(1000);
    device.allow({.work = 0.5, .longest_step = 2});
    float most = 0;
    for (int k = 0; k < 400; ++k) {
      const Reading reading = read(device);
      most = std::max(most, reading.sent->acted.z());
      EXPECT_LE(reading.sent->work, 0.5);
      device.command({0, 0, 1});
    }
    EXPECT_NEAR(most, 0.25F, 1e-4F);
  }
}

// The hand's intention goes on between two readings as it does at them: by the slopes of its way and of its tremor, too.
TEST(simulated, hand_goes_the_same_way_at_every_rate) {
  const auto tip_after_a_second_at = [](double rate) -> Eigen::Vector3d {
    Operator hand = hand_towards({{0, {0, 0, 0}}, {0.6, {10, -5, 8}}, {1.4, {0, 0, 0}}});
    hand.tremor = Tremor(1, 0.3);
    Simulated device(frictionless(), hand);
    device.start(rate);
    for (int k = 0; k <= static_cast<int>(rate); ++k) read(device);
    return device.tip();
  };
  const Eigen::Vector3d fine = tip_after_a_second_at(4000);
  for (const double rate : {500.0, 1000.0}) {
    const double difference = (tip_after_a_second_at(rate) - fine).norm();
    EXPECT_LE(difference, 1e-5);
  }
}

TEST(simulated, refuses_a_force_that_is_not_finite_and_holds_none) {
  for (const float wrong : {std::nanf(""), HUGE_VALF}) {
    Simulated device(frictionless(), std::nullopt, {.latency = false});
    device.start(1000);
    device.read();
    EXPECT_FALSE(device.command({0, 0, 1}));
    EXPECT_TRUE(device.command({0, wrong, 1}));
    EXPECT_EQ(read(device).position, Eigen::Vector3f(0, 0, 0));
  }
}

TEST(simulated, tires_when_pushed_at_its_limit) {
  Simulated device(premium_1_5(), hand_towards({{0, {0, 0, 0}}}), {.step_rate = 4000});
  device.start(1000);
  double fresh = 0;
  for (int tick = 0; tick < 60'000; ++tick) {
    read(device);
    device.command({0, 0, 8});
    if (tick == 500) fresh = device.tip().z();
  }
  EXPECT_NEAR(static_cast<double>(device.state().temperature), 1, 0.05);
  EXPECT_LT(device.tip().z(), 0.5 * fresh);
}

TEST(simulated, surface_pushes_the_hand_back) {
  const Model model = counterbalanced(premium_1_5());
  constexpr double kIntended = 3;  // mm below the wall
  Simulated device(model, hand_towards({{0, {0, 0, 5}}, {1, {0, 0, -kIntended}}}));
  const auto wall = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  const std::atomic<bool> never = false;
  const ServoResult run = run_servo_loop(device, wall, {.max_seconds = 4, .paced = false}, never);
  EXPECT_EQ(run.end_reason, EndReason::time_up);
  const double depth = -device.tip().z();
  const Grip grip;
  const double hand = kMillimetre / (1 / grip.flesh_stiffness + 1 / grip.arm_stiffness);  // N/mm
  // In balance but for what friction and one encoder count hide.
  EXPECT_NEAR(0.5 * depth, hand * (kIntended - depth), model.sheet.friction + 0.5 * model.sheet.resolution);
  EXPECT_LT(depth, 0.3 * kIntended);
}

std::vector<Sample> stroked(std::uint64_t seed) {
  Simulated device(premium_1_5(), Operator{Grip{}, strokes(), Tremor(seed, 0.03), false});
  const auto law =
      std::get<fast::Law>(fast::Law::build(LawId::bump_2p_shaded, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F}));
  const std::atomic<bool> never = false;
  tests::KeptSamples kept;
  run_servo_loop(device, law, {.max_seconds = 3, .paced = false, .sinks = {&kept}}, never);
  return kept.samples;
}

TEST(simulated, run_is_repeated_to_the_bit) {
  const auto once = stroked(1), again = stroked(1), other = stroked(2);
  ASSERT_EQ(once.size(), 3001U);
  bool differs = false;
  for (std::size_t k = 0; k < once.size(); ++k) {
    ASSERT_EQ(once[k].position, again[k].position) << k;
    ASSERT_EQ(once[k].encoder, again[k].encoder) << k;
    ASSERT_EQ(once[k].force, again[k].force) << k;
    ASSERT_EQ(once[k].device_time, again[k].device_time);
    differs = differs || once[k].position != other[k].position;
  }
  EXPECT_TRUE(differs);
}

TEST(open_simulated, knows_its_models_and_makes_strokes_without_a_recording) {
  EXPECT_EQ(open_device("simulated")->capabilities().model, "premium-1.5");
  EXPECT_EQ(open_device("simulated:premium-1.0")->capabilities().model, "premium-1.0");
  const auto device = open_device("simulated:omni");
  EXPECT_EQ(device->capabilities().model, "omni");
  device->start(1000);
  EXPECT_LE((read(*device).position - Eigen::Vector3f(-20, 0, 10)).norm(), 0.2F);
  EXPECT_EQ(tests::thrown_by<Error>([&] { open_device("simulated:touch"); }),
            "unknown model \"touch\" to simulate: expected one of premium-1.5, premium-1.0, omni");
}

TEST(open_simulated, has_the_buttons_of_whoever_prepares_it_and_none_without) {
  EXPECT_EQ(open_device("simulated")->capabilities().buttons, 0);
  struct Person : Attendant {
    std::atomic<std::uint16_t> down = 0;
    const std::atomic<std::uint16_t>* buttons() noexcept override { return &down; }
  } person;
  const tests::TemporaryDirectory directory;
  const std::string path = directory.write("hand.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,5\n1,0,0,5\n");
  for (const std::string& name : {std::string("simulated"), "simulated:omni:" + path}) {
    const auto device = open_device(name, person);
    EXPECT_EQ(device->capabilities().buttons, Attendant::kButtons);
    device->start(1000);
    for (const unsigned down : {0U, 1U, 3U, 2U, 0U}) {
      person.down = static_cast<std::uint16_t>(down);
      EXPECT_EQ(read(*device).buttons, down) << name;
    }
  }
}

TEST(open_simulated, takes_a_recording_from_its_first_time_on_for_what_the_hand_means_to_do_and_ends_with_it) {
  const tests::TemporaryDirectory directory;
  const std::string path = directory.write("hand.csv", "t_s,x_mm,y_mm,z_mm\n1000,0,0,5\n1000.5,0,0,5\n1001,10,0,5\n");
  const auto device = open_device("simulated:premium-1.5:" + path);
  device->start(1000);
  ReadResult result = device->read();
  Reading last;
  int readings = 0;
  for (; std::holds_alternative<Reading>(result); result = device->read(), ++readings) last = std::get<Reading>(result);
  EXPECT_TRUE(std::holds_alternative<EndOfData>(result));
  EXPECT_EQ(readings, 1001);
  EXPECT_NEAR(last.position.x(), 10, 3);  // a hand lags behind what it means
  EXPECT_GT(last.position.x(), 5);
  EXPECT_THROW(open_device("simulated:omni:" + directory.file("absent.csv")), Error);
  // A hand that is nowhere is a fault, not a number.
  const auto lost = open_device("simulated:omni:" + directory.write("lost.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,0\n1,nan,0,0\n"));
  lost->start(1000);
  lost->read();
  EXPECT_STREQ(std::get<Fault>(lost->read()).words, "the simulated arm's position is no longer finite");
}

}  // namespace
}  // namespace forceshade::device
