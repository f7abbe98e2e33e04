// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Somebody who drives a device with the mouse, in the command's window on a display in memory.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "display.h"
#include "screenshots.h"
#include "study/window/composition.h"
#include "tests/device/faults/command.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::window {

using faults::Command;
using faults::Words;
using namespace std::chrono_literals;

inline constexpr int kWindowLeft = 160, kWindowTop = 100;  // a window of 1280 x 800 in the middle of 1600 x 1000
inline constexpr Size kWindow{1280, 800};

class Driver {
 public:
  explicit Driver(Words subject, const Words& more = {}) {
    Words arguments{"drive", "--device", "mouse", "--uncertified", "--json", "run.json"};
    arguments.insert(arguments.end(), subject.begin(), subject.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    command_.emplace(folder_, arguments);
    tests::wait_until([&] { return is_on_display() || !command_->is_running(); }, 20ms);
    EXPECT_TRUE(is_on_display()) << command_->end();
  }

  const tests::TemporaryDirectory& folder() const { return folder_; }

  static Image window() {
    const Image all = display_image();
    Image window{1280, 800, {}};
    for (int y = 0; y < window.height; ++y)
      window.bytes.insert(window.bytes.end(), all.at(kWindowLeft, kWindowTop + y),
                          all.at(kWindowLeft, kWindowTop + y) + 3 * window.width);
    return window;
  }

  static void point(Point pixel) {
    ASSERT_EQ(by_hand("mousemove " + std::to_string(kWindowLeft + std::lround(pixel.x)) + ' ' +
                      std::to_string(kWindowTop + std::lround(pixel.y)))
                  .get(),
              0);
  }

  std::string press(const std::string& key) {
    EXPECT_EQ(by_hand("key " + key).get(), 0);
    return end();
  }
  std::string end() {
    tests::wait_until([&] { return !command_->is_running(); }, 20ms);
    const std::string end = command_->end();
    command_.reset();
    return end;
  }

 private:
  const tests::TemporaryDirectory folder_;
  std::optional<Command> command_;
};

class drive_window : public testing::Test {
 protected:
  void SetUp() override {
    if (!Canvas::is_available()) GTEST_SKIP() << "this build has no window";
  }
};

}  // namespace forceshade::window
