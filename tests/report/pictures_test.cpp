// SPDX-License-Identifier: BSD-3-Clause
// The pictures as files of their own: nothing written in them is cut off, and they say what they show.

#include "certificate/report/pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "certificate/report/mesh_picture.h"
#include "certificate/report/thesis_figures.h"

namespace forceshade::properties {
namespace {

// px in the frame. A character of sans-serif is about 0.6 of its size wide.
struct Text {
  double left, right, top, bottom;
  std::string words;
};

// Without the bytes of images, which a regular expression would take seconds to search.
std::string without_images(const std::string& svg) {
  std::string rest;
  std::size_t begin = 0;
  for (std::size_t image; (image = svg.find("base64,", begin)) != std::string::npos;) {
    rest += svg.substr(begin, image - begin);
    begin = std::min(svg.find_first_of("'\"", image), svg.size());
  }
  return rest + svg.substr(begin);
}

std::vector<Text> texts_of(const std::string& whole) {
  const std::string svg = without_images(whole);
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

// A square wall from which a path of four positions is drawn: through it from above, past its rim and back.
TEST(pictures, of_a_mesh_hold_their_words_whole_and_divide_the_path_into_seen_and_hidden) {
  const mesh::TriangleMesh wall{{{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto touching = [](float z, std::uint32_t k, std::uint32_t l) {
    mesh::Tick tick{mesh::TickStatus::touching, 1, {0, 0, -z}, {}};
    tick.after = {mesh::Place::triangle, mesh::Side::front, {}, {0}, {k, l}};
    return Ticked{{0, -1, z}, tick};
  };
  const auto free = [](const MeshPosition& position) {
    mesh::Tick tick{mesh::TickStatus::free, 1, {}, {}};
    tick.after.place = mesh::Place::free;
    tick.after.position = position;
    return Ticked{position, tick};
  };
  const std::vector<Ticked> path{free({0, -1, 4}),
                                 touching(-2, 1U << 22U, 1U << 22U),
                                 free({9, 0, -2}),
                                 {{NAN, 0, 0}, {mesh::TickStatus::invalid, 0, {}, {}}}};
  const Heading heading{"title 'of' \"it\" {/:Bold x}_y.off",
                        "268435456 triangles; K = 123.45678 N/mm, shading vertex, sides both"};
  const Picture picture = mesh_picture(wall, path, {30, 25}, "wall", heading);
  const std::string svg = svg_file(picture);
  expect_nothing_cut_off(picture, svg);
  for (const char* words : {"sides both", "{/:Bold x}_y", "device", "god-object", "force, at most 2 N",
                            "ticks: 2 free, 1 touching, 1 invalid", "azimuth 30", "2 mm"})
    EXPECT_TRUE(holds(svg, words)) << words;
  const auto rows_of = [&](const std::string& block) {
    const std::size_t begin = picture.commands.find('$' + block + " << EOD\n"), end = picture.commands.find("\nEOD", begin);
    return std::count(picture.commands.begin() + static_cast<std::ptrdiff_t>(begin),
                      picture.commands.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  };
  EXPECT_GT(rows_of("device"), 100) << "above the wall and beside it";
  EXPECT_GT(rows_of("device_hidden"), 20) << "below the wall";
  EXPECT_GT(rows_of("god_object"), 100);
  EXPECT_EQ(rows_of("forces"), 1);

  const std::string alone = svg_file(mesh_picture(wall, {}, {30, 25}, "wall", heading));
  EXPECT_TRUE(holds(alone, "azimuth 30"));
  for (const char* words : {"device", "ticks:", "at most"}) EXPECT_FALSE(holds(alone, words)) << words;
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
