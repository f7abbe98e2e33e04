// SPDX-License-Identifier: BSD-3-Clause
// The vendor's own library, where the environment's FORCESHADE_VENDOR_LIBRARY names its file; skipped elsewhere. With
// FORCESHADE_VENDOR_DEVICE=1, a device is attached that it can open; it gets no force. One that calibrates in its reset pose is
// held there.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "device/phantom/hdapi_library.h"
#include "device/phantom/phantom.h"
#include "forceshade/device.h"
#include "system/system.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

constexpr double kRate = 1000;  // Hz

class vendor_library : public testing::Test {
 protected:
  void SetUp() override {
    const char* const path = std::getenv("FORCESHADE_VENDOR_LIBRARY");
    if (!path) GTEST_SKIP() << "FORCESHADE_VENDOR_LIBRARY names no library";
    setenv("FORCESHADE_HD_LIBRARY", path, 1);
  }
  static bool has_device() {
    const char* const value = std::getenv("FORCESHADE_VENDOR_DEVICE");
    return value && value == std::string("1");
  }
};

// Shows what the driver's process says, and has the device calibrated where it is.
class Present final : public Attendant {
 public:
  void report(const std::string& words) noexcept override { std::fprintf(stderr, "%s\n", words.c_str()); }
  bool did(const std::string& words) noexcept override {
    report(words);
    return true;
  }
};

TEST_F(vendor_library, has_every_function_that_is_declared_here) {
  EXPECT_NO_THROW(hdapi::load(hdapi::names_to_try()));
}

TEST_F(vendor_library, has_words_for_every_error_that_is_declared_here) {
  using namespace hdapi;
  const Functions hd = load(names_to_try());
  for (const HDerror error : {kSuccess,
                              kInvalidEnum,
                              kInvalidValue,
                              kInvalidOperation,
                              kInvalidInputType,
                              kBadHandle,
                              kWarmMotors,
                              kExceededForce,
                              kExceededImpulse,
                              kExceededVelocity,
                              kForceError,
                              kDeviceFault,
                              kAlreadyInitiated,
                              kCommunication,
                              kCommunicationConfiguration,
                              kTimer,
                              kIllegalBegin,
                              kIllegalEnd,
                              kFrame,
                              kInvalidPriority,
                              kSchedulerFull,
                              kNoLicence}) {
    const char* const words = hd.hdGetErrorString(error);
    ASSERT_TRUE(words) << error;
    EXPECT_STRNE(words, "") << error;
  }
  EXPECT_EQ(drained(hd).code, kSuccess);
}

TEST_F(vendor_library, without_a_device_is_refused_with_the_drivers_error_and_what_to_check) {
  if (has_device()) GTEST_SKIP() << "there is a device";
  tests::expect_words(tests::thrown_by<DeviceError>([] { const Phantom device(""); }),
                      {"initialising the PHANToM: ", "(error 0x0", "internal ", "the vendor says \""});
}

TEST_F(vendor_library, runs_frames_for_a_second_without_force) {
  if (!has_device()) GTEST_SKIP() << "FORCESHADE_VENDOR_DEVICE is not 1";
  Present present;
  Phantom device("", {.force = false}, present);
  EXPECT_NE(device.capabilities().model, "");
  EXPECT_GT(device.capabilities().peak_force, 0);
  const auto fault = device.start(kRate);
  ASSERT_FALSE(fault) << fault->words;

  double last = -1;
  int frames = 0;
  for (const auto give_up = std::chrono::steady_clock::now() + 20s; last < 1 && std::chrono::steady_clock::now() < give_up;) {
    device.wait_for_frame(system::now() + std::chrono::nanoseconds(10ms).count());
    const ReadResult result = device.read();
    const auto* const reading = std::get_if<Reading>(&result);
    ASSERT_TRUE(reading) << std::get<Fault>(result).words;
    EXPECT_TRUE(reading->position.allFinite());
    EXPECT_TRUE(device.state().calibrated);
    EXPECT_FALSE(device.state().forces_on);
    frames += reading->time > last ? 1 : 0;
    last = reading->time;
  }
  EXPECT_GE(last, 1);
  EXPECT_GT(frames, kRate / 10);  // of the 1000 that there are, on however busy a machine
}

}  // namespace
}  // namespace forceshade::device
