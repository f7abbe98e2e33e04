// SPDX-License-Identifier: BSD-3-Clause
// Between its first reading and its last command the servo loop allocates nothing, and neither do the devices.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

#include "device/phantom/phantom.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "system/system.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/allocations.h"

namespace forceshade::device {
namespace {

class Watching : public Still {
 public:
  std::size_t allocations_between_first_read_and_last_command() const { return at_last_command_ - at_first_read_; }

 protected:
  ReadResult at(std::size_t reading) noexcept override {
    if (reading == 0) at_first_read_ = tests::allocations();
    if (reading == 500) return EndOfData{};
    return here();
  }
  std::optional<Fault> on_command() noexcept override {
    at_last_command_ = tests::allocations();
    return std::nullopt;
  }

 private:
  std::size_t at_first_read_ = 0;
  std::size_t at_last_command_ = 0;
};

TEST(servo_loop, allocates_nothing_after_the_first_reading) {
  for (const LawName& name : kLaws) {
    Watching device;
    const ServoOptions options{.rate_hz = kHighestRateHz};
    const Kept result(device, law_of(name.id, 0.5F), options);
    EXPECT_EQ(result.ticks, 500U);
    EXPECT_EQ(device.allocations_between_first_read_and_last_command(), 0U) << name.name;
  }
}

TEST(servo_loop, allocates_nothing_after_the_first_reading_of_a_height_map) {
  height::Grid grid{64, 64, 0.25F, height::Edge::tile, height::Interpolant::cubic_spline, {}};
  for (std::uint32_t i = 0; i < 64 * 64; ++i) grid.values.push_back(0.1F * static_cast<float>(i % 7));
  const auto texture = std::make_shared<const height::Grid>(std::move(grid));
  // One part alone has a path of its own; the apex of the cone, where the device stays, needs more than the first stage.
  for (const HeightMap& map : {HeightMap{{{texture}}}, HeightMap{{{texture}, {height::Cone{3, 4, 1, 2}}}},
                               HeightMap{{{height::Gaussian{3, 4, 1, 2}}, {height::Grating{0.1F, 3, 0, 0}}}}})
    for (const auto& [rendering, name] : height::kModes) {
      Watching device;
      const Kept result(device, std::get<fast::HeightMapField>(fast::HeightMapField::build(map, rendering, 0.5F)),
                        {.rate_hz = kHighestRateHz});
      EXPECT_EQ(result.ticks, 500U);
      EXPECT_GT(result.peak_force_N, 0) << name;
      EXPECT_EQ(device.allocations_between_first_read_and_last_command(), 0U) << name;
    }
}

TEST(servo_loop, simulated_device_allocates_nothing_once_started) {
  const auto device = open_device("simulated");
  device->start(1000);
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 2000; ++tick) {
    device->read();
    device->command({0, 0, 0.1F});
  }
  EXPECT_EQ(tests::allocations(), before);
}

// Neither while it runs nor when it fails.
TEST(servo_loop, phantom_allocates_nothing_once_started) {
  setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  stand_in_hd::reset();
  Phantom device("", {.watchdog_timeout = std::chrono::seconds(20), .start = std::chrono::seconds(20), .rate_tolerance = 1});
  ASSERT_FALSE(device.start(1000));
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 200; ++tick) {
    device.wait_for_frame(system::now() + 20 * system::kSecond);
    device.read();
    device.allow({.work = 1, .longest_step = 1});
    device.command({0, 0, 0.1F});
  }
  EXPECT_EQ(tests::allocations(), before);
  stand_in_hd::tell({.begin = hdapi::kCommunication});
  const std::size_t told = tests::allocations();
  while (!std::holds_alternative<Fault>(device.read())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(tests::allocations(), told);
}

TEST(servo_loop, allocation_by_a_device_is_seen) {
  struct Allocating final : Watching {
    ReadResult at(std::size_t reading) noexcept override {
      kept.push_back(std::make_unique<int>(1));
      return Watching::at(reading);
    }
    std::vector<std::unique_ptr<int>> kept;
  } device;
  run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_GE(device.allocations_between_first_read_and_last_command(), 499U);
}

}  // namespace
}  // namespace forceshade::device
