// SPDX-License-Identifier: BSD-3-Clause
// What somebody feels with the mouse in the real window of forceshade drive: where the cursor and the god-object come to rest.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "mouse_driver.h"
#include "study/window/section.h"

namespace forceshade::window {
namespace {

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

// What the window shows once neither the tip nor the god-object moves by a pixel in half a second; a second after the mouse
// has been moved at the earliest.
Image at_rest() {
  Image last, now = Driver::window();
  std::this_thread::sleep_for(1s);
  tests::wait_until(
      [&] {
        last = std::exchange(now, Driver::window());
        const auto tip = middle_of(now, kCursor), before = middle_of(last, kCursor);
        const auto ring = middle_of(now, kGodObject), ring_before = middle_of(last, kGodObject);
        return tip && before && distance(*tip, *before) < 1 && ring.has_value() == ring_before.has_value() &&
               (!ring || distance(*ring, *ring_before) < 1);
      },
      500ms);
  return now;
}

// Claim: on a flat surface with force shading the cursor drifts away from the middle, as on a bump.
TEST_F(drive_window, a_shaded_slope_is_felt_as_a_drift_of_the_cursor) {
  Driver driver({"--law", "bump-1p-shaded"}, {"--record", "run.fsr"});
  const SectionView view({-1.3 * 25.4, 1.3 * 25.4, 0, 2.6 * 25.4 / 1.9}, kWindow);
  const Point middle{kWindow.width / 2, view.area().bottom - 0.1 * view.area().height()};
  for (const double side : {1.0, -1.0}) {
    const Point pointer{middle.x + side * 8 * view.pixels_per_mm(), middle.y};
    ASSERT_NO_FATAL_FAILURE(Driver::point(pointer));
    const Image image = at_rest();
    const Point tip = middle_of(image, kCursor).value_or(pointer);
    EXPECT_GT(side * (tip.x - pointer.x), 10) << "pixels outwards";
    EXPECT_LT(tip.y, pointer.y - 25) << "pixels up";
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
  const auto before = middle_of(at_rest(), kGodObject);
  ASSERT_NO_FATAL_FAILURE(Driver::point({pointer.x + 3 * view.pixels_per_mm(), pointer.y}));
  const Image image = at_rest();
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

}  // namespace
}  // namespace forceshade::window
