// SPDX-License-Identifier: BSD-3-Clause
// The pictures as files of their own: nothing written in them is cut off, and they say what they show.

#include "forceshade/report/pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "forceshade/report/thesis_figures.h"

namespace forceshade::properties {
namespace {

// px in the frame. A character of sans-serif is about 0.6 of its size wide.
struct Text {
  double left, right, top, bottom;
  std::string words;
};

std::vector<Text> texts_of(const std::string& svg) {
  const std::regex text(
      "translate\\(([-0-9.]+),([-0-9.]+)\\)\"[^>]*font-size=\"([0-9.]+)\"\\s+text-anchor=\"(\\w+)\">\\s*"
      "<text>(.*)</text>");
  std::vector<Text> all;
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at) {
    const double x = std::stod((*at)[1]), y = std::stod((*at)[2]), size = std::stod((*at)[3]);
    const std::string anchor = (*at)[4], words = std::regex_replace((*at)[5].str(), std::regex("<[^>]*>"), "");
    const auto characters = std::count_if(words.begin(), words.end(), [](char c) { return (c & 0xC0) != 0x80; });
    const double width = 0.6 * size * static_cast<double>(characters);
    const double left = anchor == "start" ? x : anchor == "end" ? x - width : x - width / 2;
    if (characters > 0) all.push_back({left, left + width, y - 0.8 * size, y + 0.2 * size, words});
  }
  return all;
}

void expect_nothing_cut_off(const Picture& picture, const std::string& svg) {
  const std::vector<Text> texts = texts_of(svg);
  EXPECT_GE(texts.size(), 3U) << picture.frame.id;
  for (const Text& text : texts) {
    const std::string what = picture.frame.id + ": \"" + text.words + '"';
    EXPECT_GE(text.left, 0) << what;
    EXPECT_LE(text.right, picture.frame.width) << what;
    EXPECT_GE(text.top, 0) << what;
    EXPECT_LE(text.bottom, picture.frame.height) << what;
    for (const Text& other : texts) {
      const bool overlap = &other != &text && other.left < text.right - 3 && text.left < other.right - 3 &&
                           other.top < text.bottom - 2 && text.top < other.bottom - 2;
      EXPECT_FALSE(overlap) << what << " and \"" << other.words << '"';
    }
  }
}

bool holds(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

void expect_whole(SideView view) {
  view.heading = {"title 'of' \"it\" {/:Bold x}_y", "R = 1234.5678 mm, w = 1234.5678 mm, K = 123.45678 N/mm"};
  const ForceProfile profile(view, view.depths);
  for (const Picture& picture :
       {force_profile(view, profile, profile.side, profile.up), cross_section(view), direction_field(view), energy_map(view)}) {
    const std::string svg = svg_file(picture);
    expect_nothing_cut_off(picture, svg);
    EXPECT_TRUE(holds(svg, "R = 1234.5678 mm")) << picture.frame.id;
    EXPECT_TRUE(holds(svg, "{/:Bold x}_y")) << picture.frame.id;
    EXPECT_TRUE(holds(svg, " mm deep") || holds(svg, "where the force begins")) << picture.frame.id;
  }
}

TEST(pictures, of_laws_hold_their_words_whole) {
  // An ordinary bump, and one whose numbers are small.
  const auto expect = [](LawId law, const Parameters& parameters) { expect_whole(side_view(Drawn(law, parameters))); };
  expect(LawId::bump_3p_shaded, {15.24F, 25.4F, 0.5F});
  expect(LawId::bump_2p, {0.1F, 0.15F, 1000});
}

TEST(pictures, of_a_height_map_hold_their_words_whole) {
  const HeightMap hill{{{height::Gaussian{0, 0, 3, 5}}}};
  expect_whole(side_view(std::get<RenderedHeightMap>(fast_rendering(hill, height::Rendering::force_shaded, 0.5F)), "map",
                         {0, -1234.5F, 1345.6F}));
}

TEST(pictures, of_the_thesis_hold_their_words_whole) {
  for (const ThesisFigure& figure : thesis_figures()) {
    const std::string svg = svg_file(figure.picture);
    expect_nothing_cut_off(figure.picture, svg);
    EXPECT_TRUE(holds(svg, "Figure " + figure.name.substr(std::string("figure-").size()))) << figure.name;
  }
}

// An XML attribute that is given twice makes the whole file unreadable.
TEST(pictures, as_files_name_each_attribute_once) {
  const std::string svg = svg_file(thesis_figures().back().picture);
  const std::string opening = svg.substr(svg.find("<svg"), svg.find('>', svg.find("<svg")) - svg.find("<svg"));
  std::vector<std::string> names;
  const std::regex name("\\s([A-Za-z:-]+)=");
  for (std::sregex_iterator at(opening.begin(), opening.end(), name), end; at != end; ++at) names.push_back((*at)[1]);
  EXPECT_GE(names.size(), 5U) << opening;
  for (const std::string& one : names) EXPECT_EQ(std::count(names.begin(), names.end(), one), 1) << one;
}

}  // namespace
}  // namespace forceshade::properties
