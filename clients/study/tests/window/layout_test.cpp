// SPDX-License-Identifier: BSD-3-Clause
// The participant's picture, without a display: where the cursor is drawn, what is hidden, and that everything fits.

#include "study/window/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

#include "study/window/view.h"
#include "tests/window/even_font.h"
#include "tests/window/items.h"

namespace forceshade::window {
namespace {

constexpr double kMil = 0.0254;

const EvenFont kFont;

TEST(window_cursor, above_the_surface_it_keeps_its_distance) {
  EXPECT_EQ(drawn_cursor({3, 4, 2}, 0, 1.5), (Position{3, 4, 3.5}));
  EXPECT_EQ(drawn_cursor({3, 4, 8}, 6, 3), (Position{3, 4, 5}));
}

// Claim: the picture shows contact exactly where there is contact, whatever was rendered, and never a tip under the surface.
TEST(window_cursor, touches_the_picture_exactly_when_the_hand_touches_the_object) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> heights(-5, 10);
  std::array<int, 2> reached{};
  for (int i = 0; i < 20000; ++i) {
    const double tip = heights(random), felt = i % 16 == 0 ? tip : heights(random), drawn = heights(random);
    const bool is_in_contact = tip <= felt;
    const double z = drawn_cursor({1, 2, tip}, felt, drawn).z;
    EXPECT_GE(z, drawn);
    EXPECT_EQ(z == drawn, is_in_contact) << tip << ' ' << felt << ' ' << drawn;
    ++reached[is_in_contact ? 1 : 0];
  }
  EXPECT_GT(reached[0], 5000);
  EXPECT_GT(reached[1], 5000);
  EXPECT_EQ(drawn_cursor({0, 0, 1}, std::nan(""), 0).z, 1);
}

TEST(window_scene, the_drawn_bumps_have_one_size_and_stand_side_by_side) {
  const Scene scene;
  const double top = kMil * (1000 - std::sqrt(1000.0 * 1000 - 500 * 500));  // of a bump of 1000 mil radius and width
  EXPECT_NEAR(drawn_height(scene, -25.4), top, 1e-12);
  EXPECT_NEAR(drawn_height(scene, 25.4), top, 1e-12);
  for (const double x : {0.0, 12.69, -12.69, 38.11, -38.11, 1e9, std::nan("")}) EXPECT_EQ(drawn_height(scene, x), 0) << x;
  for (double x = 0; x < 40; x += 0.37) EXPECT_EQ(drawn_height(scene, x), drawn_height(scene, -x));
}

TEST(window_scene, the_four_pictures_sample_the_circle_as_the_thesis_does) {
  const double w = 25.4, r = 15.24;
  const auto plane = profile(Shape::plane, w, r, 20), two = profile(Shape::two_polygons, w, r, 20),
             three = profile(Shape::three_polygons, w, r, 20), cylinder = profile(Shape::cylinder, w, r, 20);
  ASSERT_EQ(plane.size(), 2U);
  ASSERT_EQ(two.size(), 5U);
  ASSERT_EQ(three.size(), 6U);
  EXPECT_GT(cylinder.size(), 40U);
  const double d = std::sqrt(r * r - w * w / 4), theta = 2.0 / 3 * std::asin(w / (2 * r));
  EXPECT_NEAR(two[2].x, 0, 1e-12);
  EXPECT_NEAR(two[2].z, r - d, 1e-12);
  EXPECT_NEAR(three[3].x, w / 2 * std::cos(theta) - d * std::sin(theta), 1e-12);  // w'/2 and h' of the thesis (4.4.3)
  EXPECT_NEAR(three[3].z, w / 2 * std::sin(theta) + d * std::cos(theta) - d, 1e-12);
  for (const auto& points : {plane, two, three, cylinder}) {
    EXPECT_EQ(points.front().x, -20);
    EXPECT_EQ(points.back().x, 20);
    for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i - 1].x, points[i].x);
    if (points.size() == 2) continue;
    EXPECT_NEAR(points[1].x, -w / 2, 1e-12);
    EXPECT_EQ(points[1].z, 0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) EXPECT_NEAR(std::hypot(points[i].x, points[i].z + d), r, 1e-9);
  }
}

TEST(window_view, the_mouse_points_where_the_cursor_is_drawn) {
  const View view({}, Size{1280, 800});
  for (const double x : {-40.0, 0.0, 13.5})
    for (const double z : {-3.0, 0.0, 12.25}) {
      const Position back = view.position(view.pixel({x, 0, z}));
      EXPECT_NEAR(back.x, x, 1e-9);
      EXPECT_NEAR(back.z, z, 1e-9);
    }
  EXPECT_GT(view.pixel({1, 0, 0}).x, view.pixel({0, 0, 0}).x);
  EXPECT_LT(view.pixel({0, 0, 1}).y, view.pixel({0, 0, 0}).y);
  EXPECT_LT(view.pixel({0, 1, 0}).y, view.pixel({0, 0, 0}).y);
}

Screen screen_of(ScreenKind kind) {
  Screen screen;
  screen.kind = kind;
  screen.title = "A title";
  screen.text = "Some text.";
  return screen;
}

Scene with_tip(Position tip, double felt = 0) {
  Scene scene;
  scene.tip = tip;
  scene.felt_height = felt;
  return scene;
}

Picture shown(const Screen& screen, const Scene& scene = {}, Size size = {1280, 800}, const Look& look = {}) {
  return picture_of(screen, scene, look, size, kFont);
}

bool says(const Picture& picture, const std::string& words) {
  return std::ranges::any_of(all_of<Text>(picture), [&](const Text& text) { return text.words == words; });
}

TEST(window_layout, the_cursor_rests_on_the_drawn_bump_whatever_radius_is_felt) {
  const Screen screen = screen_of(ScreenKind::matching);
  const Point touching = *shown(screen, with_tip({25.4, 0, -1}, 0)).cursor;
  for (const double felt : {0.0, 1.9, 3.4, 6.8}) {  // of a plane, and of bumps of 1400, 1000 and 600 mil
    const Point cursor = *shown(screen, with_tip({25.4, 0, felt - 0.5}, felt)).cursor;
    EXPECT_EQ(cursor.y, touching.y) << felt;
    EXPECT_EQ(cursor.x, touching.x) << felt;
  }
  const View view({}, Size{1280, 800});
  const Point surface = view.pixel({25.4, 0, drawn_height({}, 25.4)});
  EXPECT_NEAR(touching.x, surface.x, 1e-9);
  EXPECT_NEAR(surface.y - touching.y, 1.3 * view.pixels_per_mm(), 1e-9);  // the ball rests on its lowest point
}

TEST(window_layout, the_cursor_stays_in_sight_wherever_the_hand_is) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const Position tip : {Position{1e9, 0, 0}, Position{-1e9, 99, 1e9}, Position{0, -99, -1e9}, Position{nan, nan, nan},
                             Position{inf, -inf, inf}, Position{-inf, inf, -inf}})
    for (const Size size : {Size{1280, 800}, Size{640, 480}, Size{3840, 1080}, Size{800, 1600}}) {
      const Picture picture = shown(screen_of(ScreenKind::matching), with_tip(tip), size);
      EXPECT_TRUE(picture.scene->contains(*picture.cursor))
          << tip.x << ' ' << tip.z << ": " << picture.cursor->x << ' ' << picture.cursor->y;
    }
}

TEST(window_layout, without_vision_nothing_of_the_scene_is_drawn) {
  Screen screen = screen_of(ScreenKind::matching);
  const auto inside = [&](const Picture& picture) {
    int count = 0;
    for (const Item& item : picture.items)
      std::visit(
          [&](const auto& one) {
            using T = std::decay_t<decltype(one)>;
            if constexpr (std::is_same_v<T, Text>) count += picture.scene->contains(one.at);
            if constexpr (!std::is_same_v<T, Text> && !std::is_same_v<T, Box>) ++count;
          },
          item);
    return count;
  };
  const Picture seen = shown(screen, with_tip({1, 2, 3}));
  EXPECT_GT(inside(seen), 5);
  EXPECT_TRUE(says(seen, "Reference"));
  screen.shows_scene = false;
  const Picture blind = shown(screen, with_tip({1, 2, 3}));
  EXPECT_EQ(inside(blind), 0);
  EXPECT_FALSE(blind.cursor.has_value());
  EXPECT_FALSE(says(blind, "Reference"));
  EXPECT_TRUE(says(blind, "Some text."));
}

// Claim: a picture that follows the radius would show the answer; this one is given no radius, and the height that is felt
// changes nothing but the cursor.
TEST(window_layout, what_is_felt_moves_nothing_but_the_cursor) {
  const Screen screen = screen_of(ScreenKind::matching);
  const Picture low = shown(screen, with_tip({25.4, 0, 5}, 0)), high = shown(screen, with_tip({25.4, 0, 5}, 3));
  ASSERT_EQ(low.items.size(), high.items.size());
  const auto a = all_of<Triangles>(low), b = all_of<Triangles>(high);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(a[i].vertices, b[i].vertices,
                                   [](const Vertex& p, const Vertex& q) { return p.at.x == q.at.x && p.at.y == q.at.y; }));
  EXPECT_GT(high.cursor->y, low.cursor->y);
}

TEST(window_layout, the_answer_that_was_typed_is_marked) {
  for (const ScreenKind kind : {ScreenKind::satisfaction, ScreenKind::classification}) {
    Screen screen = screen_of(kind);
    const auto accents = [&](const std::string& entry) {
      screen.entry = entry;
      const Colour accent{0.129F, 0.369F, 0.569F};
      return std::ranges::count_if(all_of<Box>(shown(screen)), [&](const Box& box) { return box.border == accent; });
    };
    const auto unmarked = accents("");
    EXPECT_EQ(accents("99"), unmarked);
    EXPECT_EQ(accents("3"), unmarked + 1);
    EXPECT_TRUE(says(shown(screen), "3"));
  }
}

TEST(window_layout, a_classification_shows_the_tip_to_those_alone_who_cannot_feel_it) {
  Scene scene = with_tip({5, 0, -1}, 3);
  EXPECT_FALSE(shown(screen_of(ScreenKind::classification), scene).cursor.has_value());
  scene.shows_tip_alone = true;
  const Point in = *shown(screen_of(ScreenKind::classification), scene).cursor;
  scene.tip->z = 0.5;
  EXPECT_LT(shown(screen_of(ScreenKind::classification), scene).cursor->y, in.y);  // in the surface it is no different
  scene.tip = Position{std::nan(""), 1e9, -1e300};
  for (const Size size : {Size{640, 480}, Size{3840, 1080}}) {
    const Point rim = *shown(screen_of(ScreenKind::classification), scene, size).cursor;
    EXPECT_TRUE((Rectangle{0, 0, size.width, size.height}.contains(rim))) << rim.x << ' ' << rim.y;
  }
}

// Claim: no text leaves the window, and no line of it lies on another, whatever the texts, the window and the size of text.
TEST(window_layout, all_text_fits_on_every_screen) {
  std::string paragraph;
  for (int i = 0; i < 30; ++i) paragraph += "A sentence of the instructions, which is of middle length. ";
  paragraph += "\n\n" + std::string(200, 'x');
  int texts = 0;
  for (const ScreenKind kind : {ScreenKind::text, ScreenKind::matching, ScreenKind::satisfaction, ScreenKind::classification,
                                ScreenKind::question, ScreenKind::end})
    for (const Size size : {Size{1280, 800}, Size{640, 480}, Size{1080, 1920}, Size{3840, 1080}})
      for (const double scale : {0.5, 1.0, 3.0})
        for (const std::string& text : {std::string("Short."), paragraph}) {
          Screen screen = screen_of(kind);
          screen.text = text;
          screen.title = kind == ScreenKind::text && text != "Short." ? std::string(90, 'T') : "A title of usual length";
          screen.entry = kind == ScreenKind::question ? paragraph : "10";
          screen.trial = 480;
          screen.trials = 480;
          screen.is_practice = true;
          const Look look{{}, scale};
          const Picture picture = shown(screen, with_tip({0, 0, 1}), size, look);
          const auto lines = all_of<Text>(picture);
          texts += static_cast<int>(lines.size());
          for (std::size_t i = 0; i < lines.size(); ++i) {
            const auto area = [&](const Text& line) {
              return Rectangle{line.at.x, line.at.y + 0.2 * line.size, line.at.x + kFont.width(line.words, line.size),
                               line.at.y + 1.2 * line.size};
            };
            const Rectangle a = area(lines[i]);
            EXPECT_TRUE(a.left >= 0 && a.top >= 0 && a.right <= size.width && a.bottom <= size.height)
                << lines[i].words << " on screen " << static_cast<int>(kind) << " of " << size.width << " x " << size.height
                << " with text_scale " << scale << ": " << a.left << ' ' << a.top << ' ' << a.right << ' ' << a.bottom;
            for (std::size_t k = 0; k < i; ++k) {
              const Rectangle b = area(lines[k]);
              EXPECT_FALSE(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
                  << lines[i].words << " lies on " << lines[k].words << " on screen " << static_cast<int>(kind) << " of "
                  << size.width << " x " << size.height << " with text_scale " << scale;
            }
          }
        }
  EXPECT_GT(texts, 1000);
}

TEST(window_layout, a_long_answer_shows_what_is_being_written) {
  Screen screen = screen_of(ScreenKind::question);
  for (int i = 0; i < 400; ++i) screen.entry += "word ";
  screen.entry += "\nthe end";
  EXPECT_TRUE(says(shown(screen), "the end"));
}

}  // namespace
}  // namespace forceshade::window
