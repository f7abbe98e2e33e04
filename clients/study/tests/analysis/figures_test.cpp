// SPDX-License-Identifier: BSD-3-Clause
// The commands of each figure as a whole, with every number of the data another one, so that none can stand in another's place.

#include "study/analysis/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "study/analysis/analysis.h"

namespace forceshade::analysis {
namespace {

using experiments::InitialRadius;

constexpr const char* kPlain =
    "set border 3 lc rgb '#777777'\nset tics nomirror out scale 0.5 textcolor rgb '#333333'\nset format '%g'\nunset key\n";
constexpr const char* kLegend =
    "set key at screen 0.02, screen 1 left top vertical maxrows 1 Left reverse samplen 1.2 width 1 font ',10'\n";

std::string axes(const char* across, const char* up) {
  return std::string("set xlabel '") + across + "' offset 0, 0.5 font ',10' textcolor rgb '#333333'\nset ylabel '" + up +
         "' offset 2, 0 font ',10' textcolor rgb '#333333'\nset xtics offset 0, 0.3 font ',9'\nset ytics offset 0.5, 0 font "
         "',9'\n";
}

std::string panel(const char* left, const char* right, const char* top, const char* bottom, const std::string& title) {
  return std::string("set lmargin at screen ") + left + "\nset rmargin at screen " + right + "\nset tmargin at screen " + top +
         "\nset bmargin at screen " + bottom + "\nset title '" + title + "' noenhanced font ',11' offset 0, -0.4\n";
}

// Two panels of 320 px beside each other below a legend of 34 px: 640 by 314 px. The margins by hand: left 64/640 and 384/640,
// right 308/640 and 628/640, top 1 - 68/314, bottom 1 - 262/314.
std::string left_panel(const std::string& title) {
  return panel("0.1", "0.48125", "0.78343949", "0.165605096", title);
}
std::string right_panel(const std::string& title) {
  return panel("0.6", "0.98125", "0.78343949", "0.165605096", title) + "unset key\n";
}

experiments::MatchingResult trial(const char* participant, InitialRadius initial, double reference, double final,
                                  int satisfaction) {
  experiments::MatchingResult one;
  one.participant = participant;
  one.vision = true;
  one.stimulus = "bump-cylinder";
  one.initial = initial;
  one.reference_radius = reference;
  one.final_radius = final;
  one.satisfaction = satisfaction;
  return one;
}

// A's three trials and B's one, and two of other conditions, which no panel shows.
experiments::Results some_results() {
  experiments::Results results;
  results.matching = {trial("A", InitialRadius::small, 600, 540, 7), trial("A", InitialRadius::large, 1000, 1100, 9),
                      trial("A", InitialRadius::small, 600, 560, 4), trial("B", InitialRadius::same, 1000, 990, 9),
                      trial("A", InitialRadius::same, 600, 2000, 1), trial("A", InitialRadius::same, 600, 3000, 2)};
  results.matching[4].vision = false;
  results.matching[5].stimulus = "bump-2p";
  return results;
}

MatchingTable some_table() {
  const MatchingRow a{
      "A", 3, {{{0.5, {0.25, 0.75}}, {6, {}}, {6.7, {}}, {8, {}}}}, {0.5, 300}, {{600, 550, 2.5}, {1000, 1100, 4.25}}};
  const MatchingRow all{kOverall, 4, {{{1.5, {}}, {7, {}}, {7.2, {}}, {9, {}}}}, {}, {{600, 551, 3.5}, {1000, 1045, 5.75}}};
  return {"bump-cylinder", true, {a, all}};
}

// Across: 600 to 1000 with a tenth of 400 on both sides, and marks beside each other by a 55th of 480. Up: 540 to 1100 with a
// 25th of 560, and at the top 0.09 of 604.8 more.
TEST(figures, of_final_radii_are_drawn_by_these_commands) {
  const properties::Picture picture = scatter(some_results(), some_table());
  EXPECT_EQ(picture.frame.width, 640);
  EXPECT_EQ(picture.frame.height, 314);
  EXPECT_EQ(picture.frame.id, "matching-bump-cylinder-vision");
  EXPECT_EQ(picture.frame.description, "Final against reference radius: Circular cylinder, with vision");
  const auto plot = [](const std::string& i, const std::string& line) {
    return "set xtics (600, 1000)\nplot x with lines lw 1 dt (4,4) lc rgb '#999999' title 'equal radii', $trials" + i +
           "_0 using 1:2 with points pt 6 ps 0.5 lw 1 lc rgb '#0072b2' title 'began small', $trials" + i +
           "_1 using 1:2 with points pt 2 ps 0.5 lw 1 lc rgb '#444444' title 'began the same', $trials" + i +
           "_2 using 1:2 with points pt 1 ps 0.5 lw 1 lc rgb '#d55e00' title 'began large', " + line +
           " with lines lw 1.8 lc rgb '#111111' title 'least squares'\n";
  };
  const auto label = [](const char* number, const char* percent, const char* at) {
    return std::string("set label ") + number + " '" + percent + " %' at first " + at +
           ", graph 0.965 center font ',8' textcolor rgb '#333333'\n";
  };
  const std::string expected =
      std::string(kPlain) + "set multiplot\n" + kLegend + axes("reference radius (mil)", "final radius (mil)") +
      "set xrange [560:1040]\nset yrange [517.6:1176.832]\n" + left_panel("A: slope 0.50 (0.25 to 0.75)") +
      "$trials0_0 << EOD\n591.272727 540\n591.272727 560\nEOD\n$trials0_1 << EOD\nNaN NaN\nEOD\n"
      "$trials0_2 << EOD\n1008.72727 1100\nEOD\nunset label\n" +
      label("1", "2.5", "600") + label("2", "4.2", "1000") + plot("0", "300 + 0.5*x") + right_panel("overall: slope 1.50") +
      "$trials1_0 << EOD\n591.272727 540\n591.272727 560\nEOD\n$trials1_1 << EOD\n1000 990\nEOD\n"
      "$trials1_2 << EOD\n1008.72727 1100\nEOD\nunset label\n" +
      label("1", "3.5", "600") + label("2", "5.8", "1000") + plot("1", "NaN") + "unset multiplot\n";
  EXPECT_EQ(picture.commands, expected);
}

// The area of a point is the number of its answers: of the most frequent one the size is 2.2, here of one answer everywhere in
// A's panel, and of two answers 9 at 1000 in that of all, beside which a single answer has 2.2 / sqrt(2).
TEST(figures, of_satisfaction_are_drawn_by_these_commands) {
  const properties::Picture picture = satisfaction(some_results(), some_table());
  EXPECT_EQ(picture.frame.width, 640);
  EXPECT_EQ(picture.frame.height, 314);
  EXPECT_EQ(picture.frame.id, "satisfaction-bump-cylinder-vision");
  EXPECT_EQ(picture.frame.description, "Satisfaction against reference radius: Circular cylinder, with vision");
  const auto plot = [](const std::string& i) {
    return "set xtics (600, 1000)\nplot $answers" + i +
           " using 1:2:3 with points pt 7 ps variable lc rgb '#9ecae1' title 'answers: the area is their number', $means" + i +
           " using 1:2 with linespoints pt 5 ps 0.6 lw 1.6 lc rgb '#111111' title 'mean'\n";
  };
  const std::string expected =
      std::string(kPlain) + "set multiplot\n" + kLegend + axes("reference radius (mil)", "satisfaction index") +
      "set xrange [560:1040]\nset yrange [0.3:10.7]\nset ytics 1, 1, 10\n" + left_panel("A: mean 6.7") +
      "$answers0 << EOD\n600 4 2.2\n600 7 2.2\n1000 9 2.2\nEOD\n$means0 << EOD\n600 5.5\n1000 9\nEOD\n" + plot("0") +
      right_panel("overall: mean 7.2") +
      "$answers1 << EOD\n600 4 1.55563492\n600 7 1.55563492\n1000 9 2.2\nEOD\n$means1 << EOD\n600 5.5\n1000 9\nEOD\n" +
      plot("1") + "unset multiplot\n";
  EXPECT_EQ(picture.commands, expected);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

// The curve has 201 places between 0 and 100 with a 25th of that on both sides: the middle one is 50, the first -4. The
// logistic function is 0.2 + 0.7 / (1 + exp((angle - 40) / 5)), half way at the threshold; the normal one at one scale below
// the threshold 0.2 + 0.7 * 0.8413447.
TEST(figures, of_psychometric_functions_are_drawn_by_these_commands) {
  const PsychometricEstimate p{.participant = "P's",
                               .points = {{0, 9, 10}, {100, 1, 4}},
                               .fit = {{40, 5, 0.2, 0.1}, -1, 2, false},
                               .threshold = {-50, 60},
                               .scale = {1, 2},
                               .guess = {0.1, 0.3},
                               .lapse = {0.05, 0.15},
                               .p_bootstrap = 0.5,
                               .p_chi_square = 0.6};
  PsychometricEstimate unknown = p;
  unknown.participant = "Q";
  unknown.threshold = {};
  unknown.fit.parameters.threshold = 200;
  const properties::Picture picture = psychometric_figure({p, unknown}, {Shape::logistic});
  EXPECT_EQ(picture.frame.width, 640);
  EXPECT_EQ(picture.frame.id, "psychometric");
  EXPECT_EQ(picture.frame.description, "Answer 4 against the angle of each polygon");
  const std::vector<std::string> lines = lines_of(picture.commands);
  const auto at = [&](const std::string& line) {
    return static_cast<std::size_t>(std::ranges::find(lines, line) - lines.begin());
  };
  const std::size_t curve = at("$curve0 << EOD");
  ASSERT_LT(curve + 202, lines.size());
  EXPECT_EQ(lines[curve + 1].substr(0, 3), "-4 ");
  EXPECT_EQ(lines[curve + 101].substr(0, 3), "50 ");
  EXPECT_EQ(lines[curve + 101], "50 28.3442045");  // 100 * (0.2 + 0.7 / (1 + exp(2)))
  EXPECT_EQ(lines[curve + 201].substr(0, 4), "104 ");
  EXPECT_EQ(lines[curve + 202], "EOD");
  std::string rest;  // all but the curves
  bool is_curve = false;
  for (const std::string& line : lines) {
    if (!is_curve) rest += line + '\n';
    is_curve = line.starts_with("$curve") || (is_curve && line != "EOD");
  }
  const auto plot = [](const std::string& i) {
    return "plot $curve" + i + " using 1:2 with lines lw 1.8 lc rgb '#111111' title 'fit', $answers" + i +
           " using 1:2 with points pt 7 ps 0.7 lc rgb '#d55e00' title 'answer 4', NaN with lines lw 1.2 dt (4,4) lc rgb "
           "'#0072b2' title 'θ-critical, its interval shaded'\n";
  };
  const auto arrow = [](const std::string& place) {
    return "set arrow 1 from " + place + ", graph 0 to " + place + ", graph 1 nohead lw 1.2 dt (4,4) lc rgb '#0072b2'\n";
  };
  EXPECT_EQ(rest, std::string(kPlain) + "set multiplot\n" + kLegend +
                      axes("angle that each polygon subtends (°)", "answer 4 (%)") +
                      "set xrange [-4:104]\nset yrange [-3:103]\nset ytics 20\n" + left_panel("P''s: 40.0° (-50.0 to 60.0)") +
                      "$answers0 << EOD\n0 90\n100 25\nEOD\n$curve0 << EOD\nunset object\nunset arrow\n" +
                      "set object 1 rectangle from -4, graph 0 to 60, graph 1 behind fillcolor rgb '#dbe7f2' fillstyle solid "
                      "noborder\n" +
                      arrow("40") + plot("0") + right_panel("Q: 200.0° (-)") +
                      "$answers1 << EOD\n0 90\n100 25\nEOD\n$curve1 << EOD\nunset object\nunset arrow\n" + arrow("104") +
                      plot("1") + "unset multiplot\n");
  const std::string gaussian = psychometric_figure({p}, {Shape::gaussian}).commands;
  EXPECT_NE(gaussian.find("\n35.96 "), std::string::npos);
  EXPECT_NE(gaussian.find("\n50 21.5925092\n"), std::string::npos);  // 100 * (0.2 + 0.7 * 0.02275013), two scales above
}

// Four panels are two rows of three, 1200 by 594 px: the fourth is below the first. The longest has three changes.
TEST(figures, of_radii_step_by_step_are_drawn_by_these_commands) {
  const properties::Picture picture = radius_profiles({{"one", 1000, {{0, 600}, {2, 650}, {3.5, 700}}},
                                                       {"two", 620, {{0, 500}}},
                                                       {"none", 640, {}},
                                                       {"four", 660, {{0, 610}}}});
  EXPECT_EQ(picture.frame.width, 1200);
  EXPECT_EQ(picture.frame.height, 594);
  EXPECT_EQ(picture.frame.id, "radius-profiles");
  EXPECT_EQ(picture.frame.description, "The matching radius, step by step");
  const auto plot = [](const char* reference, const std::string& i) {
    return std::string("plot ") + reference + " with lines lw 1 dt (4,4) lc rgb '#999999' title 'reference radius', $changes" +
           i + " using 1:2 with linespoints pt 7 ps 0.35 lw 1.2 lc rgb '#0072b2' title 'matching radius'\n";
  };
  // left (64, 464, 864)/1200, right (388, 788, 1188)/1200; top 1 - 68/594 and 1 - 348/594, bottom 1 - 262/594 and 1 - 542/594
  EXPECT_EQ(picture.commands, std::string(kPlain) + "set multiplot\n" + kLegend + axes("step", "radius (mil)") +
                                  "set xrange [0:3]\nset yrange [470:1030]\n" +
                                  panel("0.0533333333", "0.323333333", "0.885521886", "0.558922559", "one") +
                                  "$changes0 << EOD\n0 600\n1 650\n2 700\nEOD\n" + plot("1000", "0") +
                                  panel("0.386666667", "0.656666667", "0.885521886", "0.558922559", "two") +
                                  "unset key\n$changes1 << EOD\n0 500\nEOD\n" + plot("620", "1") +
                                  panel("0.72", "0.99", "0.885521886", "0.558922559", "none") +
                                  "unset key\n$changes2 << EOD\nNaN NaN\nEOD\n" + plot("640", "2") +
                                  panel("0.0533333333", "0.323333333", "0.414141414", "0.0875420875", "four") +
                                  "unset key\n$changes3 << EOD\n0 610\nEOD\n" + plot("660", "3") + "unset multiplot\n");
}

// 824 px across are 41.6 mm, so 1 mm is 19.8077 px; 5.2 mm up are 103 px, and with the margins 213 px. A twentieth of a
// millimetre would be less than the least height, 170 px, and 100 mm more than the most, 900 px.
TEST(figures, of_positions_are_as_long_up_as_across) {
  const properties::Picture picture = position_profile({"P1's", {{-20, -1}, {10, 2}}, {{-15, 0}, {20, 3}, {18, 2.5}}});
  EXPECT_EQ(picture.frame.width, 900);
  EXPECT_EQ(picture.frame.height, 213);
  EXPECT_EQ(picture.frame.id, "position-profile");
  EXPECT_EQ(picture.frame.description, "The stylus over the nominal geometry");
  const std::vector<std::string> lines = lines_of(picture.commands);
  ASSERT_GT(lines.size(), 16U);
  const std::size_t size = std::string(kPlain).size();
  EXPECT_EQ(picture.commands.substr(0, size), kPlain);
  std::string expected = "$positions << EOD\n-20 -1\n10 2\nEOD\n$surface << EOD\n-15 0\n20 3\n18 2.5\nEOD\n";
  EXPECT_EQ(picture.commands.substr(size, expected.size()), expected);
  const auto number_after = [&](const std::string& words) {
    const std::size_t found = picture.commands.find(words);
    return found == std::string::npos ? kUndefined : std::stod(picture.commands.substr(found + words.size()));
  };
  const double height = 110 + 824 / 41.6 * 5.2;
  EXPECT_NEAR(number_after("set lmargin at screen "), 60.0 / 900, 1e-8);
  EXPECT_NEAR(number_after("set rmargin at screen "), 1 - 16.0 / 900, 1e-8);
  EXPECT_NEAR(number_after("set tmargin at screen "), 1 - 60 / height, 1e-8);
  EXPECT_NEAR(number_after("set bmargin at screen "), 50 / height, 1e-8);
  // Seven ticks at most, 14 px each, over 5.2 mm.
  expected =
      "set title 'P1''s' noenhanced font ',11'\nset key at screen 0.98, screen 0.99 right top vertical maxrows 1 Left reverse "
      "samplen 1.2 font ',10'\n" +
      axes("x (mm)", "z (mm)") +
      "set xrange [-20.8:20.8]\nset yrange [-1.6:3.6]\nset ytics 1\nplot $surface with lines lw 1.6 lc rgb '#111111' title "
      "'nominal geometry', $positions with points pt 7 ps 0.22 lc rgb '#0072b2' title 'stylus'\n";
  EXPECT_EQ(picture.commands.substr(picture.commands.find("set title")), expected);
  EXPECT_EQ(position_profile({"flat", {{-20, 0}, {20, 0.05}}, {}}).frame.height, 170);
  EXPECT_EQ(position_profile({"tall", {{-20, 0}, {20, 100}}, {}}).frame.height, 900);
  const std::string empty = position_profile({"empty", {}, {}}).commands;
  EXPECT_NE(empty.find("$positions << EOD\nNaN NaN\nEOD\n$surface << EOD\nNaN NaN\nEOD\n"), std::string::npos);
  EXPECT_NE(empty.find("set xrange [-1:1]\nset yrange [-1:1]\n"), std::string::npos);
}

// All values the same: one to both sides.
TEST(figures, of_one_radius_have_room_around_it) {
  const std::string commands = radius_profiles({{"one", 600, {{0, 600}}}}).commands;
  EXPECT_NE(commands.find("set xrange [0:1]\nset yrange [599:601]\n"), std::string::npos) << commands;
}

TEST(figures, of_a_condition_have_a_name_that_a_file_can_have) {
  EXPECT_EQ(condition_name("Own bump/2_A-z09", true), "Own_bump_2_A-z09-vision");
  EXPECT_EQ(condition_name("azAZ09{}@[`:", false), "azAZ09______-no-vision");
}

}  // namespace
}  // namespace forceshade::analysis
