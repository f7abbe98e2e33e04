// SPDX-License-Identifier: BSD-3-Clause
// The window as a participant has it, on a display in memory: keys and mouse through the display, pictures read back.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "display.h"
#include "screenshots.h"
#include "study/window/layout.h"
#include "study/window/view.h"

namespace forceshade::window {
namespace {

using experiments::Action;
using experiments::Press;
using experiments::Screen;
using experiments::ScreenKind;

constexpr const char* kInstructions =
    "You will feel pairs of bumps on a flat plane. In each pair, make the right bump feel as much like the left one as you "
    "can.\n\n"
    "The left bump is the reference: it does not change. The right bump is yours: press j to make it smaller, and k to make it "
    "bigger. Go back and forth as often as you like.\n\n"
    "When you are sure that you cannot do better, press l. Then enter how alike the two bumps feel, from 1 to 10:\n\n"
    "10  there is no difference between the two bumps\n"
    "  1  the two bumps are completely different";

Scene hand_at(double x, double y, double z, double felt = 0) {
  Scene scene;
  scene.tip = Position{x, y, z};
  scene.felt_height = felt;
  return scene;
}

struct Shown {
  const char* name;
  Screen screen;
  Scene scene;
};

std::vector<Shown> all_screens() {
  const Screen match{ScreenKind::matching,
                     "Make the right bump feel like the left one",
                     "J: smaller   K: bigger   L: as alike as possible",
                     "",
                     true,
                     7,
                     60,
                     false};
  Screen blind = match, practice = match;
  blind.shows_scene = false;
  practice.is_practice = true;
  practice.trial = 1;
  practice.trials = 4;
  const Screen satisfy{
      ScreenKind::satisfaction, "How alike do the two bumps feel?", "Type a number from 1 to 10.", "8", true, 7, 60, false};
  Screen unanswered = satisfy;
  unanswered.entry.clear();
  const Screen classify{ScreenKind::classification,
                        "Which shape did you feel?",
                        "Type the number of the picture that is most like it.",
                        "",
                        true,
                        31,
                        504,
                        false};
  Screen chosen = classify;
  chosen.entry.assign(1, '3');
  Scene by_mouse = hand_at(-8, 0, 2.5);
  by_mouse.shows_tip_alone = true;
  return {
      {"instructions", {ScreenKind::text, "Matching two bumps", kInstructions, "", true, 0, 0, false}, {}},
      {"matching-on-reference", match, hand_at(-25.4, 0, -1.2, 0)},
      {"matching-on-flank", match, hand_at(33, -6, 1.0, 1.5)},
      {"matching-above", practice, hand_at(3, 9, 11)},
      {"matching-without-vision", blind, hand_at(-25.4, 0, -1.2)},
      {"satisfaction", satisfy, {}},
      {"satisfaction-unanswered", unanswered, {}},
      {"classification", classify, {}},
      {"classification-chosen", chosen, {}},
      {"classification-by-mouse", classify, by_mouse},
      {"question",
       {ScreenKind::question, "Question 1 of 4",
        "How did you compare the two bumps? Describe how you moved over them: for instance "
        "over both in one stroke, or first several times over one and then over the other.",
        "Erst langsam über beide Höcker, dann nur über den rechten. Naïve façade, Łódź, Ελληνικά, кириллица.", true, 0, 0,
        false},
       {}},
      {"break",
       {ScreenKind::text, "Time for a break", "You have done 60 of 480 trials. Rest your hand as long as you like.", "", true,
        0, 0, false},
       {}},
      {"end", {ScreenKind::end, "Thank you", "That was all. Please call the experimenter.", "", true, 0, 0, false}, {}},
  };
}

class window_display : public testing::Test {
 protected:
  void SetUp() override {
    if (!Window::is_available()) GTEST_SKIP() << "this build has no window";
  }
};

// How far two colours are apart, in steps of the display.
int distance(const std::uint8_t* pixel, const Colour& colour) {
  const float rgb[3]{colour.red, colour.green, colour.blue};
  int most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(pixel[i] - static_cast<int>(std::lround(255 * rgb[i]))));
  return most;
}

// Pixels within the area of which the predicate holds.
template <class Predicate>
int count(const Image& image, const Rectangle& area, Predicate holds) {
  int found = 0;
  for (int y = static_cast<int>(area.top); y < static_cast<int>(area.bottom); ++y)
    for (int x = static_cast<int>(area.left); x < static_cast<int>(area.right); ++x) found += holds(image.at(x, y));
  return found;
}

bool is_dark(const std::uint8_t* pixel) {
  return pixel[0] < 90 && pixel[1] < 100 && pixel[2] < 120;
}

Rectangle whole(const Image& image) {
  return {0, 0, static_cast<double>(image.width), static_cast<double>(image.height)};
}

// The middle of all that is drawn in the colour of the cursor; nothing where there is none.
std::optional<Point> cursor_in(const Image& image) {
  double x = 0, y = 0, n = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if (distance(image.at(column, row), kCursor) <= 2) {
        x += column + 0.5;
        y += row + 0.5;
        ++n;
      }
  if (n == 0) return std::nullopt;
  return Point{x / n, y / n};
}

Image shown(Window& window, const Screen& screen, const Scene& scene, const std::string& name) {
  EXPECT_TRUE(window.draw(screen, scene));
  const Image image = window.pixels();
  save(image, name);
  return image;
}

TEST_F(window_display, every_kind_of_screen_has_its_text_and_its_picture) {
  Window window({});
  EXPECT_EQ(window.note(), "");
  for (const Shown& one : all_screens()) {
    const Image image = shown(window, one.screen, one.scene, one.name);
    EXPECT_EQ(image.width, 1280);
    EXPECT_EQ(image.height, 800);
    EXPECT_EQ(distance(image.at(3, 3), kPaper), 0) << one.name;
    EXPECT_GT(count(image, whole(image), is_dark), 500) << one.name << " has no text";
    EXPECT_EQ(cursor_in(image).has_value(), one.scene.tip.has_value() && one.screen.shows_scene) << one.name;
  }
}

TEST_F(window_display, the_cursor_is_where_the_hand_is_and_never_in_the_surface) {
  Window window({});
  const Screen match = all_screens()[1].screen;
  const View view({}, Size{1280, 800});
  const auto expect_at = [&](const Position& tip, double felt, const char* name) {
    const auto cursor = cursor_in(shown(window, match, hand_at(tip.x, tip.y, tip.z, felt), name));
    ASSERT_TRUE(cursor.has_value());
    const Point expected = view.pixel(drawn_cursor(tip, felt, drawn_height({}, tip.x)));
    EXPECT_NEAR(cursor->x, expected.x, 0.6) << name;
    EXPECT_NEAR(cursor->y, expected.y - 1.3 * view.pixels_per_mm(), 0.6) << name;
  };
  expect_at({-25.4, 0, -3}, 0, "cursor-in-a-flat-bump");
  expect_at({25.4, 0, 6.2}, 6.8, "cursor-in-a-high-bump");
  expect_at({0, 10, 7}, 0, "cursor-free");
}

TEST_F(window_display, without_vision_the_scene_is_one_colour) {
  Window window({});
  Screen match = all_screens()[1].screen;
  const Rectangle area = scene_area({1280, 800});
  const Image seen = shown(window, match, hand_at(0, 0, 1), "vision");
  match.shows_scene = false;
  const Image blind = shown(window, match, hand_at(0, 0, 1), "no-vision");
  const auto is_other = [](const std::uint8_t* pixel) { return distance(pixel, kPanel) > 0; };
  EXPECT_EQ(count(blind, {area.left + 1, area.top + 1, area.right - 1, area.bottom - 1}, is_other), 0);
  EXPECT_GT(count(seen, area, is_other), 100000);
}

// What comes of keys that are pressed while frames of the screen are drawn.
std::string typed(Window& window, const Screen& screen, const std::string& by_whom, std::size_t presses) {
  EXPECT_TRUE(window.draw(screen, {}));
  const auto hand = by_hand(by_whom);
  std::string all;
  std::size_t found = 0;
  while (found < presses) {
    EXPECT_TRUE(window.draw(screen, {}));
    for (const Press& press : window.presses()) {
      ++found;
      switch (press.action) {
        case Action::smaller: all += "<smaller>"; break;
        case Action::bigger: all += "<bigger>"; break;
        case Action::done: all += "<done>"; break;
        case Action::enter: all += "<enter>"; break;
        case Action::erase: all += "<erase>"; break;
        case Action::type: all += press.typed; break;
      }
    }
  }
  return all;
}

TEST_F(window_display, keys_become_presses_in_their_order) {
  Window window({});
  const auto screens = all_screens();
  const auto on = [&](ScreenKind kind) {
    for (const Shown& one : screens)
      if (one.screen.kind == kind) return one.screen;
    return Screen{};
  };
  EXPECT_EQ(typed(window, on(ScreenKind::matching), "key --delay 30 j k k J x 5 l", 5),
            "<smaller><bigger><bigger><smaller><done>");
  EXPECT_EQ(typed(window, on(ScreenKind::satisfaction), "key --delay 30 j 1 0 BackSpace Return", 4), "10<erase><enter>");
  EXPECT_EQ(typed(window, on(ScreenKind::question), "type --delay 30 'so: jkl 4 bumps, ok'", 19), "so: jkl 4 bumps, ok");
  EXPECT_EQ(typed(window, on(ScreenKind::question), "key KP_Enter", 1), "<enter>");
}

TEST_F(window_display, the_mouse_is_the_hand_in_mm_of_the_scene) {
  Window window({});
  const Screen match = all_screens()[1].screen;
  const View view({}, Size{1280, 800});
  ASSERT_TRUE(window.draw(match, {}));
  for (const Position& aim : {Position{-20, 0, 6}, Position{13, 0, -1}}) {
    const Point pixel = view.pixel(aim);
    // The window stands in the middle of the display, 1600 x 1000.
    const auto moved =
        by_hand("mousemove " + std::to_string(160 + std::lround(pixel.x)) + ' ' + std::to_string(100 + std::lround(pixel.y)));
    std::optional<Position> hand;
    while (!(hand && std::fabs(hand->x - aim.x) < 0.1)) {
      ASSERT_TRUE(window.draw(match, {}));
      hand = window.mouse();
    }
    const double half_pixel = 0.51 / view.pixels_per_mm();
    EXPECT_NEAR(hand->x, aim.x, half_pixel);
    EXPECT_EQ(hand->y, 0);
    EXPECT_NEAR(hand->z, aim.z, 1.2 * half_pixel);
  }
  const auto left = by_hand("mousemove 2 2");
  while (window.mouse().has_value()) ASSERT_TRUE(window.draw(match, {}));
}

TEST_F(window_display, closing_the_window_ends_drawing_and_loses_no_press) {
  Window window({});
  const Screen match = all_screens()[1].screen;
  ASSERT_TRUE(window.draw(match, {}));
  EXPECT_EQ(by_hand("key j").get(), 0);
  ASSERT_TRUE(ask_to_close());
  while (window.draw(match, {})) {
  }
  EXPECT_FALSE(window.draw(match, {}));
  ASSERT_EQ(window.presses().size(), 1U);
}

TEST_F(window_display, one_window_at_a_time_and_another_after_it) {
  {
    Window first({});
    EXPECT_THROW(Window second({}), Error);
    EXPECT_TRUE(first.draw({}, {}));
  }
  Window third({});
  EXPECT_TRUE(third.draw({}, {}));
}

TEST_F(window_display, settings_change_size_text_and_language) {
  Settings settings;
  settings.width = 1000;
  settings.height = 700;
  settings.text_scale = 1.6;
  settings.font = "DejaVu Serif";
  Window window(settings, {"Durchgang", "Übung", "Vorlage", "Anzugleichen", "ganz verschieden", "kein Unterschied"});
  Screen match = all_screens()[1].screen;
  match.title = "Gleichen Sie den rechten Höcker dem linken an";
  match.text = "J: kleiner   K: größer   L: so gleich wie möglich";
  const Image image = shown(window, match, hand_at(-25.4, 0, 0), "another-language");
  EXPECT_EQ(image.width, 1000);
  EXPECT_EQ(image.height, 700);
  Screen text = all_screens()[0].screen;
  const Image large = shown(window, text, {}, "large-text");
  EXPECT_GT(count(large, whole(large), is_dark), 2000);
}

TEST_F(window_display, what_cannot_be_shown_is_refused_with_words) {
  Settings settings;
  settings.monitor = 5;
  const auto refusal = [&] {
    try {
      Window window(settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(), "there is no monitor 5; expected 1 to 1");
  settings = {};
  settings.font = std::string(FORCESHADE_SOURCE_DIR "/README.md");
  EXPECT_EQ(refusal(), settings.font + ": expected a font in the format TrueType");
  settings.font = "No Such Family";
  Window window(settings);
  EXPECT_TRUE(window.note().starts_with("the font No Such Family is not installed: ")) << window.note();
}

}  // namespace
}  // namespace forceshade::window
