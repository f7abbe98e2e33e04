// SPDX-License-Identifier: BSD-3-Clause
// The picture in the window of drive and its lines of text, without a display.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/window/even_font.h"
#include "tests/window/items.h"
#include "window/composition.h"
#include "window/section.h"

namespace forceshade::window {
namespace {

constexpr Size kWindow{1280, 800};

const EvenFont kFont;

SectionScene plane_felt(const Felt& felt) {
  SectionScene scene;
  scene.region = {-38, 38, -14, 26};
  scene.section.columns = {{-38, {{-14, 0}}}, {38, {{-14, 0}}}};
  scene.section.border = {{{{-38, 0}, {38, 0}}}};
  scene.felt = felt;
  scene.title = "wall";
  scene.words = {"certified", "keys"};
  return scene;
}

Picture picture(const SectionScene& scene) {
  return picture_of(scene, kWindow, kFont);
}

// The point of the arrow's head; none where no arrow is drawn.
std::optional<Point> arrow_head(const Picture& picture) {
  for (const Triangles& triangles : all_of<Triangles>(picture))
    if (triangles.vertices.size() == 3 && triangles.vertices[0].colour == kAccent) return triangles.vertices[0].at;
  return std::nullopt;
}

TEST(window_section, shows_the_whole_region_in_its_shape_and_finds_the_place_of_a_pixel) {
  for (const Region& region : {Region{-38, 38, -14, 26}, Region{-5, 5, -50, 50}, Region{100, 900, -1, 1}}) {
    const SectionView view(region, kWindow);
    const Point low = view.pixel(region.left, region.bottom), high = view.pixel(region.right, region.top);
    EXPECT_NEAR((high.x - low.x) / (low.y - high.y), (region.right - region.left) / (region.top - region.bottom), 1e-9);
    EXPECT_GE(low.x, 0);
    EXPECT_LE(high.x, kWindow.width);
    const ProfilePoint back = view.position(view.pixel(region.left + 1, region.top - 2));
    EXPECT_NEAR(back.x, region.left + 1, 1e-9);
    EXPECT_NEAR(back.z, region.top - 2, 1e-9);
  }
}

TEST(window_section, draws_the_tip_where_it_is_and_an_arrow_as_long_as_the_force) {
  const SectionScene scene = plane_felt({.tip = {3, 1, -2}, .force = {0.6, 5, 0.8}});
  const Picture drawn = picture(scene);
  const SectionView view(scene.region, kWindow);
  const Point tip = view.pixel(3, -2);
  ASSERT_TRUE(drawn.cursor);
  EXPECT_NEAR(drawn.cursor->x, tip.x, 1e-9);
  EXPECT_NEAR(drawn.cursor->y, tip.y, 1e-9);
  const auto head = arrow_head(drawn);
  ASSERT_TRUE(head);
  EXPECT_NEAR(head->x - tip.x, 0.6 * arrow_scale(kWindow), 1e-9);
  EXPECT_NEAR(head->y - tip.y, -0.8 * arrow_scale(kWindow), 1e-9);
}

TEST(window_section, draws_no_arrow_without_a_force_and_none_longer_than_that_of_4_N) {
  EXPECT_FALSE(arrow_head(picture(plane_felt({.tip = {0, 0, 5}}))));
  const auto head = arrow_head(picture(plane_felt({.tip = {0, 0, -9}, .force = {0, 0, 40}})));
  ASSERT_TRUE(head);
  const Point tip = SectionView(plane_felt({}).region, kWindow).pixel(0, -9);
  EXPECT_NEAR(tip.y - head->y, kLongestArrow * arrow_scale(kWindow), 1e-9);
}

TEST(window_section, ties_the_god_object_to_the_tip) {
  const Felt felt{.tip = {4, 0, -3}, .god_object = Position{2, 0, 0}, .force = {-0.2, 0, 0.3}};
  const Picture drawn = picture(plane_felt(felt));
  const Point rest = SectionView(plane_felt({}).region, kWindow).pixel(2, 0);
  int rings = 0;
  for (const Ellipse& ellipse : all_of<Ellipse>(drawn))
    rings += ellipse.colour == kGodObject && std::fabs(ellipse.centre.x - rest.x) < 1e-9 &&
             std::fabs(ellipse.centre.y - rest.y) < 1e-9;
  EXPECT_EQ(rings, 1);
  for (const Ellipse& ellipse : all_of<Ellipse>(picture(plane_felt({.tip = {4, 0, -3}}))))
    EXPECT_NE(ellipse.colour, kGodObject);
}

TEST(window_section, dashes_the_shape_that_is_felt) {
  SectionScene scene = plane_felt({});
  for (int x = -20; x < 20; ++x) scene.section.felt.push_back({{{1.0 * x, 5}, {x + 1.0, 5}}});
  const SectionView view(scene.region, kWindow);
  double drawn = 0;
  int dashes = 0;
  double end = -1;
  for (const Line& line : all_of<Line>(picture(scene))) {
    if (line.colour != kFeltShape) continue;
    EXPECT_NEAR(line.points[0].y, view.pixel(0, 5).y, 1e-9);
    drawn += line.points[1].x - line.points[0].x;
    dashes += line.points[0].x > end + 1e-9;
    end = line.points[1].x;
  }
  EXPECT_NEAR(drawn / (40 * view.pixels_per_mm()), 0.5, 0.1);
  EXPECT_GT(dashes, 10);
}

TEST(window_section, crosses_the_intended_place_and_ties_it_to_the_tip) {
  SectionScene scene = plane_felt({.tip = {3, 1, -2}});
  const auto lines_to = [&](Point place) {
    int lines = 0;
    for (const Line& line : all_of<Line>(picture(scene))) {
      const Point middle{(line.points[0].x + line.points[1].x) / 2, (line.points[0].y + line.points[1].y) / 2};
      lines += line.colour == kIntended && (std::hypot(middle.x - place.x, middle.y - place.y) < 1e-9 ||
                                            std::hypot(line.points[0].x - place.x, line.points[0].y - place.y) < 1e-9);
    }
    return lines;
  };
  const Point place = SectionView(scene.region, kWindow).pixel(5, -6);
  EXPECT_EQ(lines_to(place), 0);
  scene.intended = {5, -6};
  EXPECT_EQ(lines_to(place), 3);  // a cross, and the line
}

TEST(window_section, keeps_words_and_tip_in_the_window_whatever_they_are) {
  SectionScene scene = plane_felt({.tip = {NAN, NAN, -HUGE_VAL}, .god_object = Position{1e9, 0, 1e9}});
  scene.title = std::string(300, 'x');
  scene.words = {std::string(2000, 'w') + " and more", "keys"};
  const Picture drawn = picture(scene);
  for (const Text& text : all_of<Text>(drawn)) {
    EXPECT_GE(text.at.x, 0) << text.words;
    EXPECT_LE(text.at.x + kFont.width(text.words, text.size), kWindow.width) << text.words;
    EXPECT_LE(text.at.y + text.size, kWindow.height) << text.words;
  }
  const Rectangle area = SectionView(scene.region, kWindow).area();
  for (const Ellipse& ellipse : all_of<Ellipse>(drawn)) EXPECT_TRUE(area.contains(ellipse.centre));
}

TEST(window_text, lines_break_at_spaces_and_within_long_words_alone) {
  const auto lines = [](std::string_view text, int characters) { return wrapped(text, 5.0 * characters, 10, kFont); };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines("", 5), Lines{""});
  EXPECT_EQ(lines("one two", 7), Lines{"one two"});
  EXPECT_EQ(lines("one two", 6), (Lines{"one", "two"}));
  EXPECT_EQ(lines("one  two   ", 4), (Lines{"one", "two"}));
  EXPECT_EQ(lines("a\n\nb", 6), (Lines{"a", "", "b"}));
  EXPECT_EQ(lines("abcdefgh ij", 3), (Lines{"abc", "def", "gh", "ij"}));
  EXPECT_EQ(lines("äöüß", 3), (Lines{"äöü", "ß"}));
  EXPECT_EQ(lines("日本語", 0), (Lines{"日", "本", "語"}));
  EXPECT_EQ(lines("  1 a", 6), Lines{"  1 a"});
}

TEST(window_text, nothing_but_spaces_is_lost_in_lines) {
  std::mt19937 random(2);
  int broken = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text, joined, expected;
    for (auto k = random() % 60; k > 0; --k) text += " a\nbcdé \xFFzz"[random() % 12];
    const auto all = wrapped(text, 5.0 * static_cast<double>(random() % 12), 10, kFont);
    for (const std::string& line : all) joined += line;
    const auto keep = [](const std::string& from, std::string& to) {
      for (const char c : from)
        if (c != ' ' && c != '\n') to += c;
    };
    std::string kept;
    keep(text, expected);
    keep(joined, kept);
    EXPECT_EQ(kept, expected);
    broken += all.size() > 1;
  }
  EXPECT_GT(broken, 1000);
}

TEST(window_text, utf8_goes_to_code_points_and_back) {
  for (const char32_t point : {0x24U, 0x7FU, 0x80U, 0x7FFU, 0x800U, 0xFFFDU, 0x10000U, 0x10FFFFU})
    EXPECT_EQ(code_points(utf8(point)), std::u32string(1, point));
  for (const char32_t point : {0xD800U, 0xDFFFU, 0x110000U}) EXPECT_EQ(utf8(point), "");
  EXPECT_EQ(utf8(U'€'), "€");
  EXPECT_EQ(code_points("a\xFF"
                        "ß"),
            U"aß");
}

}  // namespace
}  // namespace forceshade::window
