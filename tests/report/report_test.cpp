// SPDX-License-Identifier: BSD-3-Clause
// The page of a certificate: its figures, what it says of what was found, and what it does when gnuplot fails.

#include "report/report.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "forceshade/identity.h"
#include "report/gnuplot.h"
#include "tests/report/page_of_every_law.h"
#include "tests/support/has.h"
#include "tests/support/html.h"
#include "tests/support/words.h"

namespace forceshade::properties {
namespace {

using tests::certificate_of_every_law;
using tests::count;
using tests::has;
using tests::page;
using tests::result_of;

std::string error_of(const Certificate& certificate) {
  return tests::thrown_by<Error>([&] { to_html(certificate); });
}

TEST(report, is_one_page_with_a_picture_for_every_panel_and_says_what_was_found) {
  tests::expect_needs_nothing_from_elsewhere(page());
  tests::expect_every_id_once_and_none_missing(page(), 100);
  EXPECT_LT(page().size(), 3U << 20);
  EXPECT_EQ(count(page(), "<figure>"), 4U);
  EXPECT_EQ(count(page(), "<figcaption>"), 4U);
  // Force and rounding error of nine laws, four surfaces, two of energy.
  EXPECT_EQ(count(page(), "<div class=\"panel\">"), 9U + 4U + 9U + 2U);
  EXPECT_EQ(count(page(), "<svg role=\"img\""), count(page(), "<div class=\"panel\">"));
  EXPECT_EQ(count(page(), "<svg "), count(page(), "</svg>"));
  EXPECT_FALSE(has(page(), "<?xml"));
  EXPECT_TRUE(has(page(), "<title>forceshade certificate: insufficient</title>")) << "2000 points are few";
  EXPECT_TRUE(has(page(), ">Held, too little to drive</p>"));
  EXPECT_TRUE(has(page(),
                  "At every one of 2\u202F000 points per law, each component of the fast path’s force equals the exact "
                  "force rounded to binary32 (nearest, ties to even)."));
  EXPECT_FALSE(has(page(), "Counterexamples"));
  EXPECT_TRUE(has(page(), "never more than half of one"));
  EXPECT_FALSE(has(page(), "The points of a mesh"));
}

TEST(report, escapes_whatever_it_is_given) {
  Certificate certificate = certificate_of_every_law();
  certificate.build.flags = "-DX='<a>'";
  certificate.build.compiler = "<c++>";
  result_of(certificate, LawId::wall).mismatches = 1;
  result_of(certificate, LawId::wall).counterexamples = {"<script>alert(1)</script> & more"};
  result_of(certificate, LawId::cylinder).properties.at(1) = {"continuity<b>", 1, false, "x < y && y > z"};
  const std::string html = to_html(certificate, Pictures::none);
  EXPECT_TRUE(has(html, "&lt;script&gt;alert(1)&lt;/script&gt; &amp; more"));
  EXPECT_TRUE(has(html, "x &lt; y &amp;&amp; y &gt; z"));
  EXPECT_TRUE(has(html, "-DX=&#39;&lt;a&gt;&#39;"));
  EXPECT_TRUE(has(html, "&lt;c++&gt;"));
  for (const char* raw : {"<script>", "<c++>", "<a>", "<b>", "x < y"}) EXPECT_FALSE(has(html, raw)) << raw;
  EXPECT_TRUE(has(html, "1 answer of the fast path differs"));
  for (const char* good : {">Held", "At every one of"}) EXPECT_FALSE(has(html, good)) << good;
}

TEST(report, does_not_call_held_what_was_not_checked) {
  Certificate certificate = certificate_of_every_law();
  result_of(certificate, LawId::bump_2p).properties.pop_back();
  const std::string html = to_html(certificate, Pictures::none);
  EXPECT_TRUE(has(html, "<td data-label=\"passivity\">not checked</td>"));
  EXPECT_TRUE(has(html, "Some properties were not checked."));
  EXPECT_TRUE(has(to_html(Certificate{}, Pictures::none), ">Failed</p>"));
  EXPECT_TRUE(has(to_html(Certificate{}, Pictures::none), "No law was checked."));
}

TEST(report, names_a_mesh_and_says_what_was_checked_of_it) {
  Certificate certificate = certificate_of_every_law();
  certificate.subjects.resize(1);
  SubjectResult& mesh = certificate.subjects.front();
  mesh.identity = {
      kMeshKind, "ball.off", {{"sides", "front"}, {"shading", "vertex"}, {"stiffness_N_per_mm", 0.5F}}, std::string(64, 'b')};
  mesh.parts = {"980 triangles, 492 vertices"};
  mesh.energy.clear();
  mesh.conservative = false;
  const std::string html = to_html(certificate, Pictures::none);
  for (const char* words :
       {"points per mesh", "<h2>The meshes</h2>", "<th scope=\"col\">mesh</th>", "ball.off", "sides front", "shading vertex",
        "980 triangles", "What kind of force each mesh is", "The points of a mesh are a path"})
    EXPECT_TRUE(has(html, words)) << words;
  for (const char* words : {"The height maps", "<th scope=\"col\">law</th>"}) EXPECT_FALSE(has(html, words)) << words;
}

TEST(report, leaves_out_figures_that_have_nothing_to_show) {
  Certificate certificate = certificate_of_every_law();
  certificate.subjects.resize(1);
  ASSERT_EQ(certificate.subjects.front().name(), "wall");
  EXPECT_EQ(count(to_html(certificate), "<figure>"), 2U);
}

TEST(report, draws_at_the_ends_of_the_domain) {
  for (const Parameters& parameters :
       {Parameters{0.1F, 0.2F, 1000}, Parameters{10000, 0.001F, 0.001F}, Parameters{10000, 20000, 1}}) {
    Certificate certificate = certificate_of_every_law();
    for (const LawName& name : kLaws) result_of(certificate, name.id).identity = identity_of(name.id, parameters);
    const std::string html = to_html(certificate);
    EXPECT_EQ(count(html, "<figure>"), 4U);
    EXPECT_TRUE(has(html, "never more than half of one"));
  }
}

TEST(report, names_a_parameter_outside_the_domain) {
  Certificate certificate = certificate_of_every_law();
  result_of(certificate, LawId::bump_2p).identity = identity_of(LawId::bump_2p, {-1, 25.4F, 0.5F});
  EXPECT_EQ(error_of(certificate), "bump-2p: radius is -1 mm; expected 0.1 to 10000 mm");
}

TEST(report, tells_what_to_install_when_gnuplot_is_missing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_EQ(error_of(certificate_of_every_law()), "gnuplot was not found: install the package gnuplot-nox");
  setenv("PATH", path.c_str(), 1);
}

TEST(gnuplot, is_quoted_when_it_fails_and_an_error_where_it_draws_nothing) {
  const auto error = [](const char* commands) {
    return tests::thrown_by<Error>([&] { svg_plot({100, 100, "a", "nothing"}, commands); });
  };
  tests::expect_words(error("plot nonsense(1)\n"), {"exit status 1", "undefined function: nonsense"});
  EXPECT_NE(error("exit\n"), "");
}

TEST(gnuplot, takes_more_data_than_a_pipe_holds) {
  std::string data = "$d << EOD\n";
  for (int i = 0; i < 50000; ++i) data += std::to_string(i) + " 1\n";
  const std::string svg = svg_plot({100, 100, "a", "<b> & \"c\""}, data + "EOD\nplot $d with points\n");
  EXPECT_GT(svg.size(), 1U << 20);
  EXPECT_TRUE(svg.starts_with("<svg role=\"img\" aria-label=\"&lt;b&gt; &amp; &quot;c&quot;\""));
  EXPECT_FALSE(has(svg, "<title>"));
}

}  // namespace
}  // namespace forceshade::properties
