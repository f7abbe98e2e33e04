// SPDX-License-Identifier: BSD-3-Clause
// forceshade drive --device mouse in its real window: the command, its servo loop, and a mouse and keys on a display in memory.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

#include "display.h"
#include "screenshots.h"
#include "study/window/composition.h"
#include "study/window/section.h"
#include "tests/device/faults/command.h"
#include "tests/support/comes_true.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::window {
namespace {

using faults::Command;
using faults::Words;
using namespace std::chrono_literals;

constexpr int kWindowLeft = 160, kWindowTop = 100;  // a window of 1280 x 800 in the middle of 1600 x 1000
constexpr Size kWindow{1280, 800};

// What the window shows of something that has one colour: the middle between its ends.
std::optional<Point> middle_of(const Image& image, Colour colour) {
  int left = image.width, right = -1, top = image.height, bottom = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      const auto is_near = [](int a, float b) { return std::fabs(static_cast<float>(a) - 255 * b) < 2.5F; };
      if (!is_near(pixel[0], colour.red) || !is_near(pixel[1], colour.green) || !is_near(pixel[2], colour.blue)) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  return right < 0 ? std::nullopt : std::optional(Point{(left + right) / 2.0, (top + bottom) / 2.0});
}

double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// Somebody who drives a device with the mouse.
class Driver {
 public:
  explicit Driver(Words subject, const Words& more = {}) {
    Words arguments{"drive", "--device", "mouse", "--uncertified", "--watchdog-timeout", "10", "--json", "run.json"};
    arguments.insert(arguments.end(), subject.begin(), subject.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    command_.emplace(folder_, arguments);
    EXPECT_TRUE(tests::comes_true([&] { return is_on_display() || !command_->is_running(); }, 60s, 20ms));
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

  // What the window shows once neither the tip nor the god-object moves by a pixel in half a second; a second after the mouse
  // has been moved at the earliest.
  static Image at_rest() {
    Image last, now = window();
    std::this_thread::sleep_for(1s);
    EXPECT_TRUE(tests::comes_true(
        [&] {
          last = std::exchange(now, window());
          const auto tip = middle_of(now, kCursor), before = middle_of(last, kCursor);
          const auto ring = middle_of(now, kGodObject), ring_before = middle_of(last, kGodObject);
          return tip && before && distance(*tip, *before) < 1 && ring.has_value() == ring_before.has_value() &&
                 (!ring || distance(*ring, *ring_before) < 1);
        },
        60s, 500ms));
    return now;
  }

  std::string press(const std::string& key) {
    EXPECT_EQ(by_hand("key " + key).get(), 0);
    return end();
  }
  std::string end() {
    EXPECT_TRUE(tests::comes_true([&] { return !command_->is_running(); }, 60s, 20ms));
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

// Claim: on a flat surface with force shading the cursor drifts away from the middle, as on a bump.
TEST_F(drive_window, a_shaded_slope_is_felt_as_a_drift_of_the_cursor) {
  Driver driver({"--law", "bump-1p-shaded"}, {"--record", "run.fsr"});
  const SectionView view({-1.3 * 25.4, 1.3 * 25.4, 0, 2.6 * 25.4 / 1.9}, kWindow);
  const Point middle{kWindow.width / 2, view.area().bottom - 0.1 * view.area().height()};
  for (const double side : {1.0, -1.0}) {
    const Point pointer{middle.x + side * 8 * view.pixels_per_mm(), middle.y};
    ASSERT_NO_FATAL_FAILURE(Driver::point(pointer));
    // On a machine that does other work the window may stand still for a while, so it is looked at until both are seen.
    Image image;
    Point tip;
    EXPECT_TRUE(tests::comes_true(
        [&] {
          image = Driver::at_rest();
          tip = middle_of(image, kCursor).value_or(pointer);
          return side * (tip.x - pointer.x) > 10 && tip.y < pointer.y - 25;
        },
        60s, 500ms))
        << "on the side " << side << " the surface moved the cursor by " << tip.x - pointer.x << ", " << tip.y - pointer.y
        << " pixels, not outwards by 10 and up by 25";
    if (side < 0) save(image, "drive");
  }
  const std::string end = driver.press("Escape");
  EXPECT_TRUE(end.starts_with("exit 0: ")) << end;
  EXPECT_NE(driver.folder().read("run.json").find("\"stopped\""), std::string::npos) << driver.folder().read("run.json");
  EXPECT_GT(driver.folder().read("run.fsr").size(), 1000U);
}

// How far the ring moves, in mm, while the mouse goes 3 mm along a plane.
void expect_ring_to_move(const std::string& friction, double least, double most) {
  Driver driver({"--mesh", FORCESHADE_SOURCE_DIR "/tests/window/plane.off", "--unit", "mm", "--friction", friction});
  // The plane is 80 mm wide: the region is 100 mm wide.
  const SectionView view({-50, 50, 0, 100 / 1.9}, kWindow);
  const Point pointer{kWindow.width / 2, view.area().bottom - 0.15 * view.area().height()};
  ASSERT_NO_FATAL_FAILURE(Driver::point(pointer));
  const auto before = middle_of(Driver::at_rest(), kGodObject);
  ASSERT_NO_FATAL_FAILURE(Driver::point({pointer.x + 3 * view.pixels_per_mm(), pointer.y}));
  const Image image = Driver::at_rest();
  save(image, "drive-friction-" + friction);
  const auto after = middle_of(image, kGodObject);
  ASSERT_TRUE(before && after) << "no god-object is drawn";
  const double moved = (after->x - before->x) / view.pixels_per_mm();
  std::printf("friction %s: the god-object went %.2f mm\n", friction.c_str(), moved);
  EXPECT_GE(moved, least);
  EXPECT_LE(moved, most);
  const std::string end = driver.press("s");
  EXPECT_TRUE(end.starts_with("exit 0: ")) << end;
}

TEST_F(drive_window, without_friction_the_god_object_follows_the_mouse) {
  expect_ring_to_move("0", 2, 3.3);
}

TEST_F(drive_window, with_friction_the_god_object_sticks_where_it_touched) {
  expect_ring_to_move("2", -0.2, 0.2);
}

TEST_F(drive_window, ends_when_the_window_is_closed_or_the_time_is_up) {
  Driver closed({"--law", "wall"});
  EXPECT_TRUE(ask_to_close());
  EXPECT_TRUE(closed.end().starts_with("exit 0: "));
  Driver timed({"--law", "wall"}, {"--seconds", "1"});
  EXPECT_TRUE(timed.end().starts_with("exit 0: "));
  EXPECT_NE(timed.folder().read("run.json").find("\"time up\""), std::string::npos) << timed.folder().read("run.json");
}

TEST_F(drive_window, is_refused_without_a_display_before_anything_is_recorded) {
  const tests::TemporaryDirectory folder;
  Command command(folder, {"drive", "--law", "wall", "--device", "mouse", "--uncertified", "--record", "run.fsr"},
                  {"DISPLAY=", "WAYLAND_DISPLAY="});
  const std::string end = command.end();
  EXPECT_TRUE(end.starts_with("exit 2: ")) << end;
  EXPECT_NE(end.find("no window can be opened: "), std::string::npos) << end;
  EXPECT_NE(end.find("(is there a display?)"), std::string::npos) << end;
  EXPECT_EQ(folder.entries(), 1) << "expected nothing but the output";
}

}  // namespace
}  // namespace forceshade::window
