// SPDX-License-Identifier: BSD-3-Clause
// The real window, on a display in memory: that the graphics card draws the pictures, and that keys, mouse and the button to
// close it arrive. It judges frames, however long they take; all else of windows is tested in a simulated world.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "display.h"
#include "screenshots.h"
#include "tests/support/words.h"
#include "tests/window/filled.h"
#include "window/composition.h"
#include "window/section.h"

namespace forceshade::window {
namespace {

class window_smoke : public testing::Test {
 protected:
  void SetUp() override {
    if (!Canvas::is_available()) GTEST_SKIP() << "this build has no window";
  }
};

struct Shown {
  const char* name;
  Drawing drawing;
};

// Half transparent, rounded, framed, blended and thin: what the windows of clients are made of.
Picture of_all_items(Size size, const Measure&) {
  const double x = size.width / 4, y = size.height / 4;
  return {kPaper,
          {Box{{20, 20, x, y}, 0, kPanel, {}, 0}, Box{{x, 20, 2 * x, y}, 12, kAccent, kInk, 3},
           Triangles{{{{20, 2 * y}, kInk}, {{x, 2 * y}, kPaper}, {{x, 3 * y}, kAccent}}},
           Line{{{x, 2 * y}, {2 * x, 3 * y}, {3 * x, 2 * y}}, kMuted, 2}, Ellipse{{3 * x, y}, 60, 60, kCursor},
           Ellipse{{3 * x, y + 40}, 90, 20, {0.1F, 0.14F, 0.18F, 0.35F}},
           Text{{20, 3 * y}, 24, kInk, "Many words: äöü ß, 25.4 mm"}, Text{{2 * x, 3 * y}, 40, kAccent, "And more"}},
          std::nullopt,
          std::nullopt};
}

std::vector<Shown> pictures() {
  const SectionScene section{.region = {-20, 20, 0, 20},
                             .section = {{{-20, {{0, 4}}}, {0, {{0, 8}}}, {20, {{0, 4}}}}, {{{{-20, 4}, {0, 8}}}}, {}},
                             .felt = Felt{{3, 1, 6}, Position{3, 1, 7.4}, {0.3, 0, 1.5}},
                             .title = "A surface",
                             .words = {"Not certified."}};
  return {{"items", of_all_items},
          {"section", [=](Size size, const Measure& measure) { return picture_of(section, size, measure); }}};
}

// Beside text and away from edges, which the card smooths: where all pixels around are of about one colour.
class Settled {
 public:
  Settled(const Image& image, const std::vector<Rectangle>& words) : image_(image), words_(words) {}

  bool is(int x, int y) const {
    const Point at{x + 0.5, y + 0.5};
    if (std::ranges::any_of(words_, [&](const Rectangle& area) { return area.contains(at); })) return false;
    for (int v = std::max(0, y - kNear); v <= std::min(image_.height - 1, y + kNear); ++v)
      for (int u = std::max(0, x - kNear); u <= std::min(image_.width - 1, x + kNear); ++u)
        if (distance(image_.at(x, y), image_.at(u, v)) > 2) return false;
    return true;
  }

  static int distance(const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
  }

 private:
  static constexpr int kNear = 2;
  const Image& image_;
  const std::vector<Rectangle>& words_;
};

TEST_F(window_smoke, every_kind_of_picture_is_drawn_as_it_is_filled_pixel_by_pixel) {
  Canvas canvas{Settings{}};
  for (const Shown& one : pictures()) {
    Picture picture;
    std::vector<Rectangle> words;
    const auto draws = [&](Size size, const Measure& measure) {
      picture = one.drawing(size, measure);
      words.clear();
      for (const Item& item : picture.items)
        if (const auto* text = std::get_if<Text>(&item))
          words.push_back({text->at.x - 2, text->at.y, text->at.x + measure.width(text->words, text->size) + 2,
                           text->at.y + kLineHeight * text->size});
      return picture;
    };
    ASSERT_TRUE(canvas.draw(draws));
    const Image got = canvas.pixels(), expected = filled(picture, canvas.size());
    save(got, std::string("window-") + one.name);
    ASSERT_EQ(got.width, 1280);
    ASSERT_EQ(got.height, 800);
    const Settled settled(expected, words);
    int compared = 0, different = 0, dark = 0;
    for (int y = 0; y < got.height; ++y)
      for (int x = 0; x < got.width; ++x) {
        const std::uint8_t* pixel = got.at(x, y);
        const Point at{x + 0.5, y + 0.5};
        dark += pixel[0] < 90 && std::ranges::any_of(words, [&](const Rectangle& area) { return area.contains(at); });
        if (!settled.is(x, y)) continue;
        ++compared;
        different += Settled::distance(pixel, expected.at(x, y)) > 2;
      }
    std::printf("%s: %d pixels compared, %d different; %d dark ones of text\n", one.name, compared, different, dark);
    EXPECT_EQ(different, 0) << one.name;
    EXPECT_GT(compared, 700'000) << one.name;
    EXPECT_GT(dark, 100) << one.name;
  }
}

Picture nothing(Size, const Measure&) {
  return {};
}

// Frames until so many keys have come.
std::string typed(Canvas& canvas, const std::string& by_whom, std::size_t count) {
  const auto hand = by_hand(by_whom);
  std::string all;
  for (std::size_t found = 0; found < count && canvas.draw(nothing);)
    for (const Key& key : canvas.keys()) {
      all += '<' + key.name + '>';
      ++found;
    }
  return all;
}

TEST_F(window_smoke, keys_and_mouse_arrive_in_their_order) {
  Canvas canvas{Settings{}};
  ASSERT_TRUE(canvas.draw(nothing));
  EXPECT_EQ(typed(canvas, "key --delay 30 j J 5 BackSpace Escape Up Return KP_Enter", 8),
            "<j><J><5><backspace><escape><up><return><return>");
  // The window stands in the middle of the display, 1600 x 1000.
  const auto hand = by_hand("mousemove 360 400");
  const auto is_there = [&] {
    const auto at = canvas.pointer();
    return at && std::lround(at->x) == 200 && std::lround(at->y) == 300;
  };
  while (!is_there()) ASSERT_TRUE(canvas.draw(nothing));
  const auto left = by_hand("mousemove 2 2");
  while (canvas.pointer()) ASSERT_TRUE(canvas.draw(nothing));
}

TEST_F(window_smoke, closing_it_ends_drawing_and_loses_no_key) {
  Canvas canvas{Settings{}};
  ASSERT_TRUE(canvas.draw(nothing));
  EXPECT_EQ(by_hand("key j").get(), 0);
  ASSERT_TRUE(ask_to_close());
  while (canvas.draw(nothing)) continue;
  EXPECT_FALSE(canvas.draw(nothing));
  EXPECT_EQ(canvas.keys().size(), 1U);
}

std::string refusal_of(const Settings& settings) {
  return tests::thrown_by<Error>([&] { const Canvas canvas(settings); });
}

TEST_F(window_smoke, what_cannot_be_shown_is_refused_with_words) {
  Settings settings;
  settings.monitor = 5;
  EXPECT_EQ(refusal_of(settings), "there is no monitor 5; expected 1 to 1");
  settings = {};
  settings.font = FORCESHADE_SOURCE_DIR "/README.md";
  EXPECT_EQ(refusal_of(settings), settings.font + ": expected a font in the format TrueType");
  settings.font = "No Such Family";
  settings.width = 1000;
  Canvas canvas(settings);
  EXPECT_TRUE(canvas.note().starts_with("the font No Such Family is not installed: ")) << canvas.note();
  EXPECT_EQ(canvas.size().width, 1000);
  EXPECT_EQ(refusal_of({}), "a window is open already; expected one at a time");
}

TEST_F(window_smoke, no_window_opens_without_a_display) {
  ::unsetenv("DISPLAY");
  const std::string words = refusal_of({});
  EXPECT_TRUE(words.starts_with("no window can be opened: ")) << words;
  EXPECT_TRUE(words.ends_with("(is there a display?)")) << words;
}

}  // namespace
}  // namespace forceshade::window
