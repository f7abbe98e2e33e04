// SPDX-License-Identifier: BSD-3-Clause
// The words of a certificate's page: each number in its place, and captions that say what the figures show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "forceshade/identity.h"
#include "report/html.h"
#include "report/report.h"
#include "tests/certificate/made_certificate.h"
#include "tests/report/page_of_every_law.h"
#include "tests/support/has.h"

namespace forceshade::properties {
namespace {

using tests::certificate_of_every_law;
using tests::has;
using tests::page;
using tests::result_of;

// A page's words, | where a cell ends, a line for each row, heading and paragraph; no thin spaces, ; for a new line in a cell.
std::string words_of(const std::string& html) {
  std::string words;
  for (std::size_t at = html.find("<body>"); at < html.size();) {
    if (html[at] != '<') {
      const std::size_t end = std::min(html.find('<', at), html.size());
      if (html.compare(at, end - at, "\n") != 0) words += html.substr(at, end - at);
      at = end;
      continue;
    }
    const std::size_t end = html.find('>', at) + 1;
    const std::string tag = html.substr(at, end - at);
    if (tag.starts_with("<small")) words += " / ";
    if (tag == "<br>") words += "; ";
    if (tag == "</th>" || tag == "</td>") words += '|';
    for (const char* line : {"</tr>", "</p>", "</h1>", "</h2>", "</h3>", "</pre>", "</summary>"})
      if (tag == line) words += '\n';
    at = end;
  }
  const std::string thin = "\u202F";
  for (std::size_t at; (at = words.find(thin)) != std::string::npos;) words.replace(at, thin.size(), " ");
  return words;
}

// The certificate of a law that failed, of one with too little evidence and of a map, with sweeps: each number another one.
TEST(report, has_each_number_in_its_place) {
  Certificate certificate = tests::made_certificate_with_sweeps();
  SubjectResult &failed = certificate.subjects[0], &few = certificate.subjects[1], &map = certificate.subjects[2];
  failed.mismatches = 4;
  failed.counterexamples = {"at 1", "at 2"};
  failed.spread.mismatches = 3;
  failed.spread.counterexamples = {"with K = 3"};
  failed.points_by_stage = {{"binary64", 5}, {"double-double", 6}, {"wide", 7}};
  failed.properties = {{"equivalence", 11, true, ""},
                       {"continuity", 12, false, "a jump"},
                       {"unit normals", 13, true, ""},
                       {"passivity", 1, true, ""}};
  failed.jumps = {"x = 0", "|x| = w/2"};
  failed.energy = {{0.25, {0.1, 0.2}, 0.15, 0.16}, {0.5, {0.25, 0.26234}, 0.2551, 0.2499}};
  failed.subject_file = "law = \"bump-2p\"";
  static_cast<Findings&>(few) = tests::made_findings(2000);
  few.conservative = true;
  few.jumps.clear();
  few.closest_call = {};
  few.seeds = {3};
  map.unit_directions = false;
  map.energy.clear();
  few.points_by_instruction_set.erase("avx2");
  certificate.sweeps.results[1].mismatches = 1;
  certificate.sweeps.counterexamples = {"at 3"};
  const std::string words = words_of(to_html(certificate, Pictures::none));
  const std::string kappa = "3 × 10−7 ulp / x = 1.5; ";
  for (const std::string& part : std::vector<std::string>{
           "forceshade 0.1.0: certificate of the fast path\nFailed\n"
           "Among 2 000 to 1 000 000 points per subject, and of 500 to 250 000 per subject with other parameters, 7 answers of "
           "the fast path differ from the exact force rounded to binary32 (nearest, ties to even).\n"
           "A counterexample was found to: continuity of bump-2p.\n"
           "Exhaustive sweeps over 3 000 inputs found 1 wrong answer.\nIt opens no device.\n",
           "\nsubject|standing|parameters|points|mismatches|binary64|double-double|wide|equivalence|continuity|unit normals|"
           "passivity|closest call|\n"
           "bump-2p|failed|R = 15.24 mm; w = 25.4 mm; K = 0.5 N/mm|1 000 000 / and 250 000|4 / and 3|5|6|7|held / 11 cases|"
           "failed / 12 cases|held / 13 cases|held / 1 case|" +
               kappa + "z = -0.25|\n" +
               "cylinder|too little to drive|R = 15.24 mm; w = 25.4 mm; K = 0.5 N/mm|2 000 / and 500|0 / and 0|668|666|666|"
               "held / 2 000 cases|held / 2 000 cases|held / 2 000 cases|held / 200 cases|none seen|\n"
               "hill.toml|held|height-map; K = 0.5 N/mm|200 000 / and 50 000|0 / and 0|66 668|66 666|66 666|"
               "held / 2 000 cases|held / 2 000 cases|held / 2 000 cases|held / 200 cases|" +
               kappa + "y = 0.25; z = -0.25|\n",
           "\nThe height maps\nhill.toml|gaussian: x_mm 0, y_mm 0, height_mm 3, sigma_mm 5; SHA-256 of its numbers " +
               std::string(64, 'c') + "|\n",
           "\nThe subjects, as files for --subject\nbump-2p\nlaw = &quot;bump-2p&quot;\n",
           "\nWhat kind of force each subject is\nsubject|continuous|unit direction|conservative|most energy per loop|\n"
           "bump-2p|no / jumps on x = 0, |x| = w/2|yes|no|0.26234 mJ / 0.5 mm deep; fast path 0.2499 mJ|\n"
           "cylinder|yes|yes|yes|0|\nhill.toml|no / jumps on |x| = w/2|no|no|not measured|\n",
           "\nExhaustive sweeps\nlaw|swept|radii, mm|sweeps|inputs|mismatches|\n"
           "bump-2p|the surface at every x of the bump|15.24|1|1 000|0|\nwall|every z, on a chosen x|any|1|2 000|1|\n",
           "every instruction set of the machine: 2.5 s.\n",
           "\nCounterexamples\nbump-2p: first 2 of 4 wrong answers\nat 1\nat 2\n"
           "bump-2p: with other parameters, first 1 of 3 wrong answers\nwith K = 3\nbump-2p: continuity\na jump\n"
           "Exhaustive sweeps\nat 3\n",
           "\nThe build that was checked\nversion|0.1.0|\nrevision|c0ffee|\ncompiler|GNU 12.2.0|\n"
           "flags|-O3 -ffp-contract=off|\ninstruction set|avx2 is the widest of the machine|\ncompared at the points|scalar|\n"
           "library digest|" +
               std::string(64, 'a') +
               "|\nprocessor|a processor|\ndate|2026-01-31T23:59:59Z|\nseed|3 and 7|\ntime taken|1.5 s|\n"})
    EXPECT_TRUE(has(words, part)) << part << "\nin\n" << words;
}

// The points of one subject among several count, whichever it is.
TEST(report, says_that_points_were_compared_where_one_subject_has_some) {
  for (const std::size_t with : {0, 1, 2}) {
    Certificate certificate = tests::made_certificate_with_sweeps();
    for (std::size_t i = 0; i < certificate.subjects.size(); ++i) {
      SubjectResult& its = certificate.subjects[i];
      its.mismatches = its.spread.mismatches = 0;
      its.points = i == with ? 700 : 0;
      its.spread.points = i == with ? 50 : 0;
    }
    const std::string words = words_of(to_html(certificate, Pictures::none));
    EXPECT_TRUE(has(words, "At every one of 0 to 700 points per subject, and of 0 to 50 per subject with other parameters, "))
        << with << words;
  }
}

TEST(report, says_how_far_sweeps_went_and_what_they_swept) {
  Certificate certificate = tests::made_certificate_with_sweeps();
  certificate.sweeps.results.push_back({{LawId::bump_2p, {20.32F, 25.4F, 0.5F}, SweepKind::height, 0}, 50, 0});
  certificate.sweeps.results.push_back({{LawId::bump_3p, {15.24F, 25.4F, 0.5F}, SweepKind::direction, -1}, 5, 0});
  certificate.sweeps.results.push_back({{LawId::bump_3p, {15.24F, 25.4F, 0.5F}, SweepKind::line, -2}, 6, 2});
  certificate.sweeps.end = certificate.sweeps.units();
  const std::string words = words_of(to_html(certificate, Pictures::none));
  EXPECT_TRUE(has(words, "As far as they went, exhaustive sweeps over 3 061 inputs found 2 wrong answers.")) << words;
  EXPECT_TRUE(has(words, "\nbump-2p|the surface at every x of the bump|15.24, 20.32|2|1 050|0|\n")) << words;
  EXPECT_TRUE(has(words, "\nbump-3p|every x of the bump, on z = −1 mm|15.24|1|5|0|\n")) << words;
  EXPECT_TRUE(has(words, "\nbump-3p|every x, on a chosen z|15.24|1|6|2|\n")) << words;
  certificate.subjects.clear();
  EXPECT_FALSE(has(words_of(to_html(certificate, Pictures::none)), "No law was checked."));
}

// The fast path may give less energy than the exact law, or more.
TEST(report, says_the_largest_difference_of_energies_on_either_side) {
  Certificate certificate = tests::certificate_of_every_law();
  certificate.subjects = {tests::result_of(certificate, LawId::bump_2p)};
  for (LoopEnergy& loop : certificate.subjects.front().energy) loop.measured_mJ = loop.witness_mJ * (1 - 3e-6);
  EXPECT_TRUE(has(words_of(to_html(certificate)), "they differ by at most 3 parts per million"));
}

// The captions of the figures, with numbers that are computed here in another way.
TEST(report, says_in_captions_what_the_figures_show) {
  const std::string words = words_of(page());
  for (const char* part :
       {"depth of the hand below the nominal surface: 0.5 mm 1 mm 2 mm", ", and all panels share their axes of force.",
        "polygons push sideways in steps", "Force shading makes Fx one straight ramp", "The bump-cylinder is two objects",
        "they differ by at most 1 parts per million", "energy grows with the square of the depth",
        "nearly in proportion to the depth",
        "The conservative laws (wall, cylinder, bump-cylinder, bump-1p) give none; the most that any of their loops gave or "
        "took is 1 × 10−18 mJ."})
    EXPECT_TRUE(has(words, part)) << part;
  // The flat top of three polygons: the chord of a third of the angle, and its height.
  const double R = 15.24, alpha = std::asin(12.7 / R), d = R * std::cos(alpha);
  EXPECT_TRUE(
      has(words, "for R = 15.24 mm and w = 25.4 mm: the cylinder rises h = " + html_number(R - d, 5) + " mm above the plane"));
  EXPECT_TRUE(has(words, "a flat top w′ = " + html_number(2 * R * std::sin(alpha / 3), 5) + " mm")) << words;
  EXPECT_TRUE(has(words, "at h′ = " + html_number(R * std::cos(alpha / 3) - d, 5) + " mm"));
  // The cells of 64 x 48 that lie in contact, of nine laws; where a cell's middle is on a surface to rounding either may be.
  int cells = 0;
  for (const LawName& law : kLaws) {
    const bool is_bump = has_bump_geometry(law.id);
    const double reach = is_bump ? 0.65 * 25.4 : 9.7, low = is_bump ? -0.21 * 25.4 : -4.7,
                 high = is_bump ? R - d + 0.06 * 25.4 : 1.3, corner = R * std::sin(alpha / 3),
                 top = R * std::cos(alpha / 3) - d;
    for (int i = 0; i < 64 * 48; ++i) {
      const double x = std::fabs(reach * ((i % 64 + 0.5) / 32 - 1)), z = low + (high - low) * (i / 64 + 0.5) / 48;
      const bool is_round = law.id == LawId::cylinder || law.id == LawId::bump_cylinder;
      const bool has_two = law.id == LawId::bump_2p || law.id == LawId::bump_2p_shaded;
      const bool has_three = law.id == LawId::bump_3p || law.id == LawId::bump_3p_shaded;
      const double surface = is_round    ? (x < R ? std::sqrt(R * R - x * x) - d : -d)
                             : x > 12.7  ? 0
                             : has_two   ? (R - d) * (1 - x / 12.7)
                             : has_three ? std::min(top, top * (12.7 - x) / (12.7 - corner))
                                         : 0;
      // The cylinder alone ends below; beside the bump-cylinder is the plane.
      const bool is_in_cylinder = std::hypot(x, z + d) < R;
      cells += law.id == LawId::cylinder        ? is_in_cylinder
               : law.id == LawId::bump_cylinder ? is_in_cylinder || z < 0
                                                : z < surface;
    }
  }
  EXPECT_TRUE(has(words, "binary32 result, at " + words_of("<body>" + grouped(static_cast<std::uint64_t>(cells))) +
                             " positions in contact"))
      << cells;
  EXPECT_TRUE(has(words, "No error at all here, because each product fits into a binary32: wall, bump-1p."));
  Certificate certificate = certificate_of_every_law();
  result_of(certificate, LawId::bump_2p).identity = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.75F});
  result_of(certificate, LawId::bump_2p).energy[0].measured_mJ = -1;
  const std::string others = words_of(to_html(certificate));
  EXPECT_TRUE(has(others, "; each panel has its own axes."));
  EXPECT_TRUE(has(others, "A loop that gave none, or took energy, has no place on a logarithmic axis and is not shown."));
  EXPECT_FALSE(has(words, "has no place on a logarithmic axis"));
}

TEST(html, writes_numbers_and_text_as_a_page_needs_them) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1\u202F000");
  EXPECT_EQ(grouped(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(html_number(0.25, 3), "0.25");
  EXPECT_EQ(html_number(3.125e-9, 2), "3.1\u202F×\u202F10<sup>−9</sup>");
  EXPECT_EQ(html_number(2e30, 2), "2\u202F×\u202F10<sup>30</sup>");
  EXPECT_EQ(escaped("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(cell("a", "b"), "<td data-label=\"a\">b</td>");
  EXPECT_EQ(cell("a", "b", "number"), "<td data-label=\"a\" class=\"number\">b</td>");
}

}  // namespace
}  // namespace forceshade::properties
