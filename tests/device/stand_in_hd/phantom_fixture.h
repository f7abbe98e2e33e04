// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A Phantom over the stand-in, for tests.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "device/phantom/phantom.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/wait_until.h"
#include "tests/support/words.h"

namespace forceshade::device {
using namespace std::chrono_literals;
using stand_in_hd::Orders;
using stand_in_hd::seen;
using stand_in_hd::tell;
using tests::expect_words;
using tests::wait_until;
using Clock = std::chrono::steady_clock;

// As long as CTest lets a test run, and any rate: however late either thread is, what a test waits for comes.
inline constexpr Phantom::Options kPatient{
    .watchdog_timeout = 10min, .open = 10min, .start = 10min, .calibration = 10min, .rate_tolerance = 1};

// Keeps the words that it is told, and does what the test orders.
class Listener final : public Attendant {
 public:
  void report(const std::string& words) noexcept override {
    heard += words + "\n";
    if (on_words) on_words(words);
  }
  bool did(const std::string& words) noexcept override {
    asked.push_back(words);
    return does;
  }
  bool has_left() const noexcept override { return leaves; }

  std::string heard;
  std::vector<std::string> asked;
  bool does = false, leaves = false;
  std::function<void(const std::string&)> on_words;
};

// Every test leaves the stand-in without a breach of discipline, closed and without force.
class phantom : public testing::Test {
 protected:
  void SetUp() override {
    setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
    stand_in_hd::reset();
  }
  void TearDown() override {
    const auto after = seen();
    for (const std::string& breach : after.breaches) ADD_FAILURE() << breach;
    EXPECT_FALSE(after.initialised || after.scheduler || after.output);
    EXPECT_TRUE(stand_in_hd::arm().force.isZero(0));
  }
};

}  // namespace forceshade::device
