// SPDX-License-Identifier: BSD-3-Clause
// The page of a conformance run.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "forceshade/subjects.h"
#include "properties/conformance/distance.h"
#include "report/conformance/figures.h"
#include "report/conformance/page.h"
#include "tests/conformance/made_judgement.h"
#include "tests/support/has.h"
#include "tests/support/html.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::conformance {
namespace {

using properties::Pictures;
using tests::count;
using tests::has;

const Description kBump{"bump-2p", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}};
constexpr const char kAttack[] = "\"><script>alert(1)</script><img src=x onerror='y'>\n\x1b[2J\xff";

using Wrong = std::function<Eigen::Vector3f(const Eigen::Vector3f& position, const Eigen::Vector3f& right)>;

// A run of so many positions of the subject, with the fast path's answers made wrong.
Conformance run_of(const Description& description, std::size_t points, const Wrong& wrong) {
  const std::shared_ptr<const properties::Subject> subject = properties::subject_of(description);
  Judge judge(subject, {});
  const auto positions = subject->positions(1);
  const auto session = subject->renderer().open();
  Conformance found;
  found.identity = subject->identity();
  found.hello.name = "mine";
  found.hello.version = "2.1";
  for (std::size_t i = 0; i < points; ++i) {
    const properties::Aimed aimed = positions->next();
    const Eigen::Vector3f right = session->step(aimed.position).force;
    const auto beyond = judge.add({aimed.position, i == 0, wrong(aimed.position, right), std::string(name_of(aimed.aim)),
                                   "position " + std::to_string(i)});
    if (!beyond || found.counterexample) continue;
    found.counterexample = beyond;
    found.shortest_path = {aimed.position};
  }
  found.judgement = judge.judgement();
  found.invariants = {{"the same path twice gives the same bits", 500}, {"a hand at rest feels a force at rest", 20}};
  return found;
}

Eigen::Vector3f right_one(const Eigen::Vector3f&, const Eigen::Vector3f& right) {
  return right;
}

// One number off on one side, and no number at all in a corner.
Eigen::Vector3f wrong_one(const Eigen::Vector3f& position, Eigen::Vector3f right) {
  if (position.x() > 0 && right.z() != 0) right.z() = std::nextafter(right.z(), 10.0F);
  if (position.x() < -10 && position.z() < -8) right.y() = std::numeric_limits<float>::quiet_NaN();
  return right;
}

std::string page_of(const Conformance& found, const Description& description, Pictures pictures = Pictures::none) {
  const Circumstances circumstances{{.points = 3000, .seed = 7}, "0.1.0", "forceshade conform --command 'a <b> & c'"};
  return to_html(found, description, circumstances, pictures);
}

TEST(conformance_page, needs_nothing_from_elsewhere_and_has_its_pictures) {
  const std::string page = page_of(run_of(kBump, 3000, wrong_one), kBump, Pictures::all);
  tests::expect_needs_nothing_from_elsewhere(page);
  tests::expect_every_id_once_and_none_missing(page, 3);
  EXPECT_EQ(count(page, "<figure>"), 2U);
  EXPECT_EQ(count(page, "<svg role=\"img\""), 3U) << "two distributions and a map";
  EXPECT_TRUE(has(page, "from the side: <i>x</i> and <i>z</i>"));
  EXPECT_TRUE(has(page, "outside the picture"));
  EXPECT_LT(page.size(), 2U << 20);
}

TEST(conformance_page, has_no_distribution_of_errors_where_there_are_none) {
  const std::string page = page_of(run_of(kBump, 3000, right_one), kBump, Pictures::all);
  EXPECT_EQ(count(page, "<figure>"), 1U);
  EXPECT_TRUE(has(page, ">Held</p>"));
  EXPECT_TRUE(has(page, "Of 3\u202F000 answers, 3\u202F000 are the exact force rounded to binary32"));
  for (const char* absent : {"A test to paste", "The largest errors", "class=\"no\"", "does not hold", "The time of an answer"})
    EXPECT_FALSE(has(page, absent)) << absent;
}

TEST(conformance_page, says_what_was_wrong_and_how_to_repeat_it) {
  Conformance found = run_of(kBump, 3000, wrong_one);
  found.invariants[1].violation = "tick 3: 1 N became 2 N";
  found.timing = Timing{4000, 1e-5, 2.5e-4, 0.5};
  const std::string page = page_of(found, kBump);
  for (const char* part :
       {">Failed</p>", "1 of 2 invariants does not hold", "tick 3: 1 N became 2 N", "no finite force", "A test to paste",
        "const float path_mm[][3] = {{", "<th scope=\"row\">tolerance</th><td>correctly rounded</td>",
        "<th scope=\"row\">seed</th><td><code>7</code></td>", "<th scope=\"row\">forceshade</th><td>0.1.0</td>",
        "<code>forceshade conform --command &#39;a &lt;b&gt; &amp; c&#39;</code>", "250 µs", "4\u202F000 answers",
        "<th scope=\"row\">surface</th>"})
    EXPECT_TRUE(has(page, part)) << part;
  EXPECT_FALSE(has(page, "<figure>")) << "without pictures";
}

TEST(conformance_page, says_why_a_run_is_not_applicable_or_ended_early) {
  Conformance found;
  found.hello.refusal = "it has no <bumps>";
  const std::string refused = page_of(found, kBump, Pictures::all);
  EXPECT_TRUE(has(refused, ">Not applicable</p>"));
  EXPECT_TRUE(has(refused, "it has no &lt;bumps&gt;"));
  EXPECT_FALSE(has(refused, ">Held"));
  found = {};
  found.failure = "the renderer was killed by signal 11";
  const std::string failed = page_of(found, kBump, Pictures::all);
  EXPECT_TRUE(has(failed, ">Failed</p>"));
  EXPECT_TRUE(has(failed, "The run ended before its end: the renderer was killed by signal 11"));
}

TEST(conformance_page, keeps_foreign_text_text) {
  Conformance found = run_of(kBump, 500, wrong_one);
  for (std::string* text : {&found.hello.name, &found.hello.version, &found.invariants[0].name}) *text = kAttack;
  found.invariants[0].violation = kAttack;
  found.failure = kAttack;
  for (auto& worst : found.judgement.worst) worst->its.place = worst->its.aim = kAttack;
  found.judgement.by_aim[kAttack] = {1, 1, 1};
  Description named = kBump;
  named.name = kAttack;
  found.identity.name = found.identity.digest = kAttack;
  found.hello.declared = {{kAttack, kAttack}};
  found.invariants[1].not_applicable = kAttack;
  for (const bool is_refused : {false, true}) {
    if (is_refused) found.hello.refusal = kAttack;
    const std::string page = to_html(found, named, {{}, kAttack, kAttack}, Pictures::all);
    EXPECT_TRUE(has(page, "&lt;script&gt;"));
    for (const char* part : {"<script", "<img", "\x1b", "\xff", "\"&gt;"}) EXPECT_FALSE(has(page, part)) << part;
  }
}

TEST(conformance_page, shows_a_mesh_with_its_edges_and_a_height_map_from_above) {
  const tests::TemporaryDirectory folder;
  folder.write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Description mesh = subjects::read_file(folder.write(
      "tetrahedron.toml", "mesh = \"tetrahedron.off\"\nunit = \"mm\"\nshading = \"none\"\nstiffness = \"0.5N/mm\"\n"));
  const std::string of_mesh = page_of(run_of(mesh, 300, right_one), mesh, Pictures::all);
  EXPECT_TRUE(has(of_mesh, "from above: <i>x</i> and <i>y</i>"));
  EXPECT_TRUE(has(of_mesh, "The lines are the edges of the mesh."));
  const Description map{
      "ripple.toml", DescribedHeightMap{HeightMap{{height::Part{height::Plane{0.1F, 0, 0}}}}, height::Mode::true_height, 0.5F}};
  const std::string of_map = page_of(run_of(map, 300, right_one), map, Pictures::all);
  EXPECT_TRUE(has(of_map, "from above: <i>x</i> and <i>y</i>"));
  EXPECT_FALSE(has(of_map, "The lines are"));
}

TEST(conformance_page, says_each_number_of_a_judgement_where_it_belongs) {
  Conformance found;
  found.identity = properties::subject_of(kBump)->identity();
  found.judgement = made_judgement();
  const std::string page = page_of(found, kBump, Pictures::all);
  Circumstances tolerant{{.points = 3000, .seed = 7}, "0.1.0", "forceshade conform"};
  tolerant.options.tolerance = *tolerance_of("4 ulp");
  EXPECT_TRUE(has(to_html(found, kBump, tolerant, Pictures::none), ", and 50 are within the tolerance, 4 ulp."));
  for (const char* part :
       {"Of 100 answers, 40 are the exact force rounded to binary32",
        "3 answers at positions that the definition did not decide are not judged. 1 answer for which the definition’s "
        "god-object did not come to rest are not judged.",
        "5\u202Fulp<br>0.5\u202FN<br>25\u202F%", "All 100 answers that were judged.",
        "A position for each of 2\u202F048 of 3\u202F000 wrong answers, and for all 40 right ones"})
    EXPECT_TRUE(has(page, part)) << part;
  // The bins of both distributions in their order, below their bars.
  const auto labels = [&](const char* id) {
    const std::size_t begin = page.find(std::string("id=\"") + id), end = page.find("</svg>", begin);
    std::string all;
    for (const std::string& label : tests::matches(page.substr(begin, end - begin), "<tspan[^>]*>([^<]*)</tspan>"))
      all += label + ' ';
    return all;
  };
  EXPECT_TRUE(has(labels("errors-ulp"), " 0 4 32 2 8  2 11  2 14 "));
  EXPECT_TRUE(has(labels("errors-newton"), " 0 10 -3  10 -2  10 -1  10 0  10 1  10 2  10 3  10 4  10 5  more "))
      << labels("errors-newton");
}

// One in two of more than 2000.
TEST(conformance_page, says_how_many_samples_of_a_recording_it_draws) {
  for (const auto& [count, said] : {std::pair(2000, "All 2\u202F000 samples"), {2001, "One in 2 of 2\u202F001 samples"}})
    EXPECT_TRUE(has(course_figure(1, std::vector<TimedForce>(static_cast<std::size_t>(count))), said)) << said;
}

}  // namespace
}  // namespace forceshade::conformance
