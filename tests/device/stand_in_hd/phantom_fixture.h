// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A Phantom over the stand-in, for tests.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "device/phantom/phantom.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/wait_until.h"
#include "tests/support/words.h"

namespace forceshade::device {
using namespace std::chrono_literals;
using stand_in_hd::seen;
using stand_in_hd::tell;
using tests::expect_words;
using tests::wait_until;

// As long as CTest lets a test run, and any rate: however late either thread is, what a test waits for comes.
inline constexpr Phantom::Options kPatient{
    .watchdog_timeout = 10min, .open = 10min, .start = 10min, .calibration = 10min, .rate_tolerance = 1};

// Every test leaves the stand-in closed and without force.
class phantom : public testing::Test {
 protected:
  void SetUp() override {
    setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
    stand_in_hd::reset();
  }
  void TearDown() override {
    const auto after = seen();
    EXPECT_FALSE(after.initialised || after.scheduler || after.output);
    EXPECT_TRUE(stand_in_hd::arm().force.isZero(0));
  }
};

}  // namespace forceshade::device
