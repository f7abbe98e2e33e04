// SPDX-License-Identifier: BSD-3-Clause
// The window of drive in a simulated world: the servo loop, a simulated arm in a hand that the mouse steers, and the window.
// Each number is the same in every run, to the bit; beside each claim stands what was seen.

#include "apps/drive_window.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <optional>

#include "device/simulated/simulated.h"
#include "forceshade/recording.h"
#include "subjects/read.h"
#include "tests/support/temporary_directory.h"
#include "tests/window/drawn_canvas.h"
#include "tests/window/items.h"
#include "tests/window/screenshots.h"
#include "tests/world/world.h"
#include "window/section.h"

namespace forceshade::apps {
namespace {

using device::EndReason;
using window::Person;
using window::Point;

constexpr window::Size kWindow{1280, 800};

// The god-object's ring.
std::optional<Point> ring_of(const window::Picture& picture) {
  for (const window::Ellipse& ellipse : window::all_of<window::Ellipse>(picture))
    if (ellipse.colour == window::kGodObject) return ellipse.centre;
  return std::nullopt;
}

// A hand with the mouse in the window, above the middle of what it shows.
class Drive : device::Attendant {
 public:
  explicit Drive(const subjects::Options& what)
      : what_(subjects::read_one(what)), cut_(what_, rendering_), steering_({0, cut_.middle_y(), 20}) {}

  window::SectionView view() const { return {cut_.region(), kWindow}; }
  Person& person() { return person_; }

  run::Outcome run(const std::string& record = "", std::optional<double> seconds = {}) {
    const run::Plan plan{.device = "mouse", .digest = {}, .record = record, .servo = {.max_seconds = seconds}};
    world::World world;
    run::Outcome outcome;
    const std::atomic<bool> asked = false;
    const auto end = world.run(
        [&] {
          const auto device = device::open_mouse("premium-1.5", *this);
          DriveWindow window(what_, cut_, {}, steering_, "not certified");
          outcome = window.run(*device, rendering_, plan, asked);
        },
        60 * system::kSecond);
    EXPECT_EQ(end, world::World::End::over);
    EXPECT_FALSE(outcome.result.trip);
    return outcome;
  }

 private:
  device::Steering* steering() noexcept override { return &steering_; }

  const Description what_;
  const Rendering rendering_ = std::get<Rendering>(rendering_of(what_));
  SurfaceCut cut_;
  device::Steering steering_;
  Person person_;
};

// Claim: on a flat surface with force shading the cursor drifts away from the middle, as on a bump.
TEST(drive_window, a_shaded_slope_is_felt_as_a_drift_of_the_cursor) {
  const tests::TemporaryDirectory folder;
  Drive drive({{"law", "bump-1p-shaded"}});
  const auto view = drive.view();
  const Point middle{kWindow.width / 2, view.area().bottom - 0.1 * view.area().height()};
  const double aside = 8 * view.pixels_per_mm();
  const std::array<Point, 2> aims{Point{middle.x + aside, middle.y}, Point{middle.x - aside, middle.y}};
  std::array<Point, 2> cursors;
  Person& person = drive.person();
  person.at(0.5).point(aims[0]).at(3).point(aims[1]).at(6).key("escape");
  person.sees = [&](const window::Picture& picture) {
    if (picture.cursor) cursors[person.frames() < 180 ? 0 : 1] = *picture.cursor;
  };
  const run::Outcome outcome = drive.run(folder.file("run.fsr"));
  window::save(person.image(), "drive");
  EXPECT_EQ(outcome.result.end_reason, EndReason::stopped);
  EXPECT_EQ(person.frames(), 361);
  for (const std::size_t side : {0U, 1U}) {
    const double sign = side == 0 ? 1 : -1, outward = sign * (cursors[side].x - aims[side].x),
                 up = aims[side].y - cursors[side].y;
    std::printf("side %zu: the surface moved the cursor by %.6f pixels outward and %.6f up\n", side, outward, up);
    EXPECT_GT(outward, 20);  // 55.97, 29.66
    EXPECT_GT(up, 40);       // 61.53, 96.97
  }
  recorder::Recording recording(folder.file("run.fsr"));
  EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>{});
  EXPECT_EQ(recording.extent().samples, outcome.result.ticks + 1);
}

// The distance that the ring moves, in mm, while the mouse goes 3 mm along a plane.
double ring_moves(const std::string& friction) {
  Drive drive({{"mesh", FORCESHADE_SOURCE_DIR "/tests/window/plane.off"}, {"unit", "mm"}, {"friction", friction}});
  const auto view = drive.view();
  const Point pointer{kWindow.width / 2, view.area().bottom - 0.15 * view.area().height()};
  std::array<Point, 2> rings;
  Person& person = drive.person();
  person.at(0.5).point(pointer).at(3).point({pointer.x + 3 * view.pixels_per_mm(), pointer.y}).at(6).key("s");
  person.sees = [&](const window::Picture& picture) {
    if (const auto ring = ring_of(picture)) rings[person.frames() < 180 ? 0 : 1] = *ring;
  };
  EXPECT_EQ(drive.run().result.end_reason, EndReason::stopped);
  window::save(person.image(), "drive-friction-" + friction);
  const double moved = (rings[1].x - rings[0].x) / view.pixels_per_mm();
  std::printf("friction %s: the god-object went %.6f mm\n", friction.c_str(), moved);
  return moved;
}

TEST(drive_window, friction_holds_the_god_object_where_it_touched_and_without_it_it_follows_the_mouse) {
  EXPECT_NEAR(ring_moves("0"), 3, 0.1);  // 2.928
  EXPECT_EQ(ring_moves("2"), 0);
}

TEST(drive_window, ends_when_the_window_is_closed_or_the_time_is_up) {
  Drive closed({{"law", "wall"}});
  closed.person().at(1).close();
  EXPECT_EQ(closed.run().result.end_reason, EndReason::stopped);
  EXPECT_EQ(closed.person().frames(), 60);
  Drive timed({{"law", "wall"}});
  const run::Outcome outcome = timed.run("", 1);
  EXPECT_EQ(outcome.result.end_reason, EndReason::time_up);
  EXPECT_EQ(outcome.result.ticks, 1000U);
}

TEST(drive_window, is_damped_as_its_subject_says) {
  Drive drive({{"law", "wall"}, {"damping", "0.002"}, {"damping-filter", "0.25"}});
  EXPECT_EQ(drive.run("", 0.1).result.damping, (damping::Parameters{.rate = 1000, .share = 0.25F, .damping = 0.002F}));
}

TEST(drive_window, arrow_keys_move_the_plane_by_a_millimetre) {
  Drive drive({{"law", "wall"}});
  Person& person = drive.person();
  person.at(0.5).point({640, 300}).at(1).key("up").key("up").key("up").key("down").at(3).key("s");
  drive.run();
  double y = 0;
  for (const window::Text& text : window::all_of<window::Text>(person.picture()))
    std::sscanf(text.words.c_str(), "y = %lf mm", &y);
  EXPECT_NEAR(y, 2, 0.5);  // 1.8: the arm's friction holds the hand back
}

}  // namespace
}  // namespace forceshade::apps
