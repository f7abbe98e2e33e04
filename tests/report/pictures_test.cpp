// SPDX-License-Identifier: BSD-3-Clause
// The pictures as files of their own: nothing written in them is cut off, and they say what they show.

#include "report/pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "report/mesh_picture.h"
#include "report/thesis_figures.h"
#include "tests/support/has.h"

namespace forceshade::properties {
namespace {

using tests::has;

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

void expect_whole(SideView view) {
  view.heading = {"title 'of' \"it\" {/:Bold x}_y", "R = 1234.5678 mm, w = 1234.5678 mm, K = 123.45678 N/mm"};
  const ForceProfile profile(view, view.depths);
  for (const Picture& picture :
       {force_profile(view, profile, profile.side, profile.up), cross_section(view), direction_field(view), energy_map(view)}) {
    const std::string svg = svg_file(picture);
    expect_nothing_cut_off(picture, svg);
    EXPECT_TRUE(has(svg, "R = 1234.5678 mm")) << picture.frame.id;
    EXPECT_TRUE(has(svg, "{/:Bold x}_y")) << picture.frame.id;
    EXPECT_TRUE(has(svg, " mm deep") || has(svg, "where the force begins")) << picture.frame.id;
  }
}

// An ordinary bump, one whose numbers are small, and a height map.
TEST(pictures, of_laws_and_a_height_map_hold_their_words_whole) {
  expect_whole(side_view(Drawn(LawId::bump_3p_shaded, {15.24F, 25.4F, 0.5F})));
  expect_whole(side_view(Drawn(LawId::bump_2p, {0.1F, 0.15F, 1000})));
  const HeightMap hill{{{height::Gaussian{0, 0, 3, 5}}}};
  expect_whole(side_view(std::get<RenderedHeightMap>(fast_rendering(hill, height::Mode::force_shaded, 0.5F)), "map",
                         {0, -1234.5F, 1345.6F}));
}

// A square wall from which a path of four positions is drawn: through it from above, past its rim and back.
TEST(pictures, of_a_mesh_hold_their_words_whole_and_divide_the_path_into_seen_and_hidden) {
  const mesh::TriangleMesh wall{{{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto touching = [](float z, std::uint32_t k, std::uint32_t l) {
    mesh::Tick tick{Status::contact, 1, {0, 0, -z}, {}};
    tick.after = {mesh::Place::triangle, mesh::Side::front, false, {}, {0}, {k, l}};
    return Ticked{{0, -1, z}, tick};
  };
  const auto free = [](const MeshPosition& position) {
    mesh::Tick tick{Status::free, 1, {}, {}};
    tick.after.place = mesh::Place::free;
    tick.after.position = position;
    return Ticked{position, tick};
  };
  const std::vector<Ticked> path{
      free({0, -1, 4}), touching(-2, 1U << 22U, 1U << 22U), free({9, 0, -2}), {{NAN, 0, 0}, {Status::invalid, 0, {}, {}}}};
  const Heading heading{"title 'of' \"it\" {/:Bold x}_y.off",
                        "268435456 triangles; K = 123.45678 N/mm, shading vertex, sides both"};
  const Picture picture = mesh_picture(wall, path, {30, 25}, "wall", heading);
  const std::string svg = svg_file(picture);
  expect_nothing_cut_off(picture, svg);
  for (const char* words : {"sides both", "{/:Bold x}_y", "device", "god-object", "force, at most 2 N",
                            "ticks: 2 free, 1 touching, 1 invalid", "azimuth 30", "2 mm"})
    EXPECT_TRUE(has(svg, words)) << words;
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
  EXPECT_TRUE(has(alone, "azimuth 30"));
  for (const char* words : {"device", "ticks:", "at most"}) EXPECT_FALSE(has(alone, words)) << words;
}

// An XML attribute that is given twice makes the whole file unreadable.
TEST(pictures, of_the_thesis_hold_their_words_whole_and_name_each_attribute_once) {
  for (const ThesisFigure& figure : thesis_figures()) {
    const std::string svg = svg_file(figure.picture);
    expect_nothing_cut_off(figure.picture, svg);
    EXPECT_TRUE(has(svg, "Figure " + figure.name.substr(std::string("figure-").size()))) << figure.name;
    const std::string opening = svg.substr(svg.find("<svg"), svg.find('>', svg.find("<svg")) - svg.find("<svg"));
    std::vector<std::string> names;
    const std::regex name("\\s([A-Za-z:-]+)=");
    for (std::sregex_iterator at(opening.begin(), opening.end(), name), end; at != end; ++at) names.push_back((*at)[1]);
    EXPECT_GE(names.size(), 5U) << opening;
    for (const std::string& one : names) EXPECT_EQ(std::count(names.begin(), names.end(), one), 1) << one;
  }
}

TEST(plot_text, is_read_by_gnuplot_as_it_is_meant) {
  EXPECT_EQ(plotted(0.1), "0.1");
  EXPECT_EQ(plotted(INFINITY), "NaN");
  EXPECT_EQ(plotted(NAN), "NaN");
  EXPECT_EQ(range("y", -1.5, 2), "set yrange [-1.5:2]\n");
  EXPECT_EQ(margins(0.1, 0.9, 0.8, 0.2),
            "set lmargin at screen 0.1\nset rmargin at screen 0.9\nset tmargin at screen 0.8\nset bmargin at screen 0.2\n");
  EXPECT_EQ(quoted("it's\n\tso"), "'it''s  so'");
  EXPECT_EQ(ticks("x", 10, 5), "set xtics 2\n");
  EXPECT_EQ(ticks("x", 10, 10), "set xtics 1\n");
  EXPECT_EQ(ticks("y", 10.1, 10), "set ytics 2\n");
  EXPECT_EQ(ticks("x", 10, 3), "set xtics 5\n");
  EXPECT_EQ(ticks("x", 16, 3), "set xtics 10\n");
  EXPECT_EQ(ticks("x", 0.3, 4), "set xtics 0.1\n");
  EXPECT_EQ(ticks("x", 0, 4), "");
  EXPECT_EQ(legend_line("red", "a line"), "<span class=\"key\"><i style=\"border-color:red\"></i>a line</span>");
  EXPECT_EQ(figure(3, "two", "a title", "", {{"one", "<svg/>"}, {"two", "<svg></svg>"}}, "words"),
            "<figure>\n<h3><span>Figure 3</span> a title</h3>\n<div class=\"panels two\">\n"
            "<div class=\"panel\"><h4>one</h4>\n<svg/></div>\n<div class=\"panel\"><h4>two</h4>\n<svg></svg></div>\n"
            "</div>\n<figcaption>words</figcaption>\n</figure>\n");
  EXPECT_TRUE(has(figure(3, "two", "", "a key", {}, ""), "<p class=\"legend\">a key</p>\n"));
}

// A surface of slope 1/2 under a force of (x, 0, -z), which jumps at 1.
SideView made_view() {
  SideView view{"made", -2, 2, {-3, 2}, {-1.5, 1.5}, {0.25, 0.5, 1}, {}, {}, {}, {}, {}, {}};
  view.across = {{-2, false}, {0, false}, {1, true}, {2, false}};
  view.jumps = {1};
  view.surface = [](double x) { return x / 2; };
  view.stands_for = [](double x) { return x < 0 ? std::nan("") : 3 * x; };
  view.force = [](float x, float z) { return Eigen::Vector3f(x, 0, -z); };
  view.density = [](double x, double z) { return x + 10 * z; };
  return view;
}

TEST(pictures, have_the_numbers_of_the_view) {
  const SideView view = made_view();
  const ForceProfile profile(view, view.depths);
  EXPECT_EQ(profile.block,
            "-2 -2 1.25\n0 0 0.25\n\n1 1 -0.25\n2 2 -0.75\n\n\n-2 -2 1.5\n0 0 0.5\n\n1 1 -0\n2 2 -0.5\n\n\n"
            "-2 -2 2\n0 0 1\n\n1 1 0.5\n2 2 -0\n\n\n");
  EXPECT_EQ(profile.side, 2);
  EXPECT_EQ(profile.up, 2);
  const Picture forces = force_profile(view, profile, 2, 3);
  EXPECT_EQ(forces.frame.id, "force-made");
  EXPECT_EQ(forces.frame.width, 350);
  EXPECT_EQ(forces.frame.height, 27 + 2 * 91 + 35 + 48);
  EXPECT_TRUE(has(forces.commands, "set xrange [-2:2]\nset xtics 1\n"));
  EXPECT_TRUE(has(forces.commands, "set yrange [0:3.24]\nset ytics 1\n")) << forces.commands;
  EXPECT_TRUE(has(forces.commands, "set yrange [-2.16:2.16]\nset ytics 2\n")) << forces.commands;
  EXPECT_TRUE(has(forces.commands,
                  "plot $force index 0 using 1:3 with lines lw 1.8 lc rgb '#85b8dc' title '0.25 mm deep', "
                  "$force index 1 using 1:3 with lines lw 1.8 lc rgb '#2f7ab5' title '0.5 mm deep', $force "
                  "index 2 using 1:3 with lines lw 1.8 lc rgb '#08315c' title '1 mm deep'\n"));
  EXPECT_LT(forces.commands.find("using 1:3"), forces.commands.find("{/:Italic F}_x (N)"));
  EXPECT_GT(forces.commands.find("using 1:2"), forces.commands.find("{/:Italic F}_x (N)"));
  const Picture flat = force_profile(view, profile, 0, 0);
  EXPECT_TRUE(has(flat.commands, "set yrange [0:1.08]\n") && has(flat.commands, "set yrange [-1.08:1.08]\n"));

  // 214 px across are 4 mm, so 3 mm up are 160.5 px.
  const Picture section = cross_section(view);
  EXPECT_EQ(section.frame.id, "surface-made");
  EXPECT_EQ(section.frame.width, 270);
  EXPECT_EQ(section.frame.height, 26 + 47 + 161);
  EXPECT_TRUE(section.commands.starts_with("$surface << EOD\n-2 -1 NaN\n0 0 0\n1 0.5 3\n2 1 6\nEOD\n")) << section.commands;
  EXPECT_TRUE(has(section.commands, "set xrange [-2:2]\nset yrange [-1.5:1.5]\nset xtics 1\nset ytics 1\n"))
      << section.commands;
  EXPECT_TRUE(has(section.commands,
                  "plot $surface using 1:2 with filledcurves y=-1.5 fc rgb '#e3ecf4' notitle, '' using 1:2 "
                  "with lines lw 2 lc rgb '#08315c' title 'where the force begins', '' using 1:3 with lines "
                  "lw 1.4 dt (4,3) lc rgb '#d55e00' title 'the shape it stands for'\n"));
  SideView alone = view;
  alone.stands_for = [](double) { return std::nan(""); };
  EXPECT_FALSE(has(cross_section(alone).commands, "stands for"));

  // The first arrow stands half a step of 4/33 mm from the lower left corner and is 0.85 of a step long.
  const Picture directions = direction_field(view);
  const double step = 4.0 / 33, x = -2 + step / 2, z = -3 + step / 2, size = std::hypot(x, z);
  EXPECT_EQ(directions.frame.id, "directions-made");
  EXPECT_EQ(directions.frame.height, 26 + 47 + 638);  // ceil(510 * 5 / 4)
  std::istringstream in(directions.commands);
  std::string line;
  ASSERT_TRUE(std::getline(in, line) && line == "$arrows << EOD");
  std::array<double, 5> arrow{};
  for (double& number : arrow) ASSERT_TRUE(in >> number);
  const std::array<double, 5> expected{x, z, 0.85 * step * x / size, -0.85 * step * z / size, size};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(arrow[i], expected[i], 1e-6) << i;
  EXPECT_TRUE(has(directions.commands, "$surface << EOD\n-2 -1\n0 0\n1 0.5\n2 1\nEOD\n"));

  // 84 by 42 cells; the first row lies below the surface, and the last beside it above.
  const Picture energy = energy_map(view);
  EXPECT_EQ(energy.frame.id, "energy-made");
  std::istringstream cells(energy.commands);
  ASSERT_TRUE(std::getline(cells, line) && line == "$density << EOD");
  std::vector<std::vector<std::string>> rows;
  while (std::getline(cells, line) && line != "EOD") {
    std::istringstream row(line);
    rows.emplace_back();
    for (std::string word; row >> word;) rows.back().push_back(word);
  }
  ASSERT_EQ(rows.size(), 42U);
  for (std::size_t row = 0; row < 42; ++row) {
    ASSERT_EQ(rows[row].size(), 84U);
    for (std::size_t column = 0; column < 84; ++column) {
      const double at = -2 + 4.0 * (static_cast<double>(column) + 0.5) / 84,
                   up = -3 + 5.0 * (static_cast<double>(row) + 0.5) / 42;
      if (std::fabs(up - at / 2) < 1e-9) continue;
      if (up > at / 2)
        EXPECT_EQ(rows[row][column], "NaN");
      else
        EXPECT_NEAR(std::stod(rows[row][column]), at + 10 * up, 1e-6);
    }
  }
  EXPECT_TRUE(has(energy.commands, "$lines << EOD\n1 -3\n1 0.5\n\nEOD\n")) << "the line on which it jumps";
  EXPECT_TRUE(has(energy.commands, "title 'where it jumps'"));
}

}  // namespace
}  // namespace forceshade::properties
