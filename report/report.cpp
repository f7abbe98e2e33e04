// SPDX-License-Identifier: BSD-3-Clause
#include "report/report.h"

#include <algorithm>
#include <array>
#include <set>

#include "certificate/certificate_text.h"
#include "forceshade/certificate.h"
#include "forceshade/certify.h"
#include "forceshade/fast.h"
#include "forceshade/identity.h"
#include "rendering/breakdown.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/matrix.h"
#include "report/page_style.h"
#include "text/joined.h"

namespace forceshade::properties {
namespace {

std::uint64_t spread_points_of(const Certificate& certificate) {
  std::uint64_t sum = 0;
  for (const Findings& law : certificate.subjects) sum += law.spread.points;
  return sum;
}

// "20 000 to 1 000 000"
std::string fewest_to_most(const Certificate& certificate, std::uint64_t (*points)(const Findings&)) {
  const auto [fewest, most] = std::minmax_element(certificate.subjects.begin(), certificate.subjects.end(),
                                                  [&](const Findings& a, const Findings& b) { return points(a) < points(b); });
  return (points(*fewest) == points(*most) ? "" : grouped(points(*fewest)) + " to ") + grouped(points(*most));
}

std::string points_per_law(const Certificate& certificate) {
  const std::string per = " per " + subject_word(certificate);
  std::string words = fewest_to_most(certificate, [](const Findings& law) { return law.points; }) + " points" + per;
  if (spread_points_of(certificate) > 0)
    words += ", and of " + fewest_to_most(certificate, [](const Findings& law) { return law.spread.points; }) + per +
             " with other parameters";
  return words;
}

// "continuity of bump-2p, passivity of bump-3p".
std::string failed_properties(const Certificate& certificate) {
  std::string list;
  for (const SubjectResult& law : certificate.subjects) {
    for (const PropertyResult& property : law.properties)
      if (!property.held) list += (list.empty() ? "" : ", ") + escaped(property.name) + " of " + escaped(law.name());
  }
  return list;
}

std::string statements(const Certificate& certificate) {
  if (certificate.subjects.empty() && !certificate.sweeps.results.empty()) return "";
  if (certificate.subjects.empty()) return "<p class=\"statement\">No law was checked.</p>\n";
  const std::string rule = "the exact force rounded to binary32 (nearest, ties to even)";
  std::uint64_t mismatches = 0;
  for (const SubjectResult& law : certificate.subjects) mismatches += law.mismatches + law.spread.mismatches;
  const std::string points = points_per_law(certificate);
  std::string html = "<p class=\"statement\">";
  bool is_compared = false;
  for (const SubjectResult& law : certificate.subjects) is_compared = is_compared || law.points > 0;
  if (!is_compared)
    html += "No point was compared with the exact force.";
  else if (mismatches == 0)
    html += "At every one of " + points + ", each component of the fast path’s force equals " + rule + '.';
  else
    html += "Among " + points + ", " + plural(mismatches, "answer") + " of the fast path " +
            (mismatches == 1 ? "differs" : "differ") + " from " + rule + '.';
  html += "</p>\n<p class=\"statement\">";
  const std::string failed = failed_properties(certificate);
  bool is_unchecked = false;
  for (const Findings& law : certificate.subjects) is_unchecked = is_unchecked || law.properties.size() < kPropertyNames.size();
  if (!failed.empty())
    html += "A counterexample was found to: " + failed + '.';
  else if (is_unchecked)
    html += "Some properties were not checked.";
  else
    html += "No counterexample to equivalence, continuity, unit normals or passivity was found.";
  return html + "</p>\n";
}

std::string sweep_statement(const Sweeps& sweeps) {
  if (sweeps.results.empty()) return "";
  const std::uint64_t mismatches = sweeps.mismatches();
  return "<p class=\"statement\">" + std::string(sweeps.is_whole() ? "" : "As far as they went, ") +
         (sweeps.is_whole() ? "E" : "e") + "xhaustive sweeps over " + grouped(sweeps.inputs()) + " inputs found " +
         (mismatches == 0 ? "no mismatch" : plural(mismatches, "wrong answer")) + ".</p>\n";
}

bool is_of_library_renderer(const SubjectResult& subject) {
  return subject.rendered_by == RenderedBy::library;
}

std::string heading_of(const Certificate& certificate, Standing standing) {
  const auto& all = certificate.subjects;
  switch (standing) {
    case Standing::sufficient: return "Held";
    case Standing::insufficient:
      return std::all_of(all.begin(), all.end(), is_of_library_renderer) ? "Held, too little to drive"
                                                                         : "Held, opens no device";
    case Standing::failed: break;
  }
  return "Failed";
}

// States under the verdict whether a device may be driven.
std::string drive_statement(const Certificate& certificate, const Assessment& assessment) {
  switch (assessment.standing) {
    case Standing::sufficient: return "<p class=\"statement\">This is enough evidence to drive a device with this build.</p>\n";
    case Standing::insufficient:
      return "<p class=\"statement lacking\">It opens no device: " + escaped(assessment.lacks) +
             ".</p>\n<p class=\"statement\">To gather it: <code>" + escaped(assessment.remedy) + "</code></p>\n";
    case Standing::failed: break;
  }
  return certificate.subjects.empty() && certificate.sweeps.results.empty()
             ? ""
             : "<p class=\"statement\">It opens no device.</p>\n";
}

std::string header(const Certificate& certificate) {
  const Assessment assessment = assessed(certificate);
  return "<header class=\"" + std::string(name_of(assessment.standing)) + "\">\n<h1>forceshade " +
         escaped(certificate.build.version) + ": certificate of the fast path</h1>\n<p class=\"verdict\">" +
         heading_of(certificate, assessment.standing) + "</p>\n" + statements(certificate) +
         sweep_statement(certificate.sweeps) + drive_statement(certificate, assessment) + "</header>\n";
}

std::string stage_cell(const std::string& stage, const std::map<std::string, std::uint64_t>& points) {
  const auto found = points.find(stage);
  return cell(("by " + stage).c_str(), found == points.end() ? "not counted" : grouped(found->second), "number");
}

std::string property_cell(const char* name, const Findings& law) {
  const auto property =
      std::find_if(law.properties.begin(), law.properties.end(), [&](const PropertyResult& p) { return p.name == name; });
  if (property == law.properties.end()) return cell(name, "not checked");
  return cell(name, held_or_failed(property->held) + "<small>" + plural(property->cases, "case") + "</small>");
}

// A radius, a width and a stiffness by the thesis's letters.
std::string parameters_of(const SubjectResult& subject) {
  std::string text;
  for (const auto& [key, value] : subject.identity.parameters) {
    const auto line = [&](const char* letter, const char* unit) {
      return std::string("<i>") + letter + "</i>\u202F=\u202F" + escaped(text_of(value)) + "\u202F" + unit;
    };
    text += text.empty() ? "" : "<br>";
    text += key == "radius_mm"            ? line("R", "mm")
            : key == "width_mm"           ? line("w", "mm")
            : key == "stiffness_N_per_mm" ? line("K", "N/mm")
            : key == "rendering"          ? escaped(text_of(value))
                                          : escaped(key + ' ' + text_of(value));
  }
  return text;
}

// No law looks at y, every height map does.
std::string closest_call_of(const Findings& law, bool has_y) {
  const ClosestCall& call = law.closest_call;
  if (!(call.ulps_from_tie < 1)) return "none seen";
  return html_number(call.ulps_from_tie, 2) + "\u202Fulp<small><i>x</i>\u202F=\u202F" + shortest(call.x) +
         (has_y ? "<br><i>y</i>\u202F=\u202F" + shortest(call.y) : "") + "<br><i>z</i>\u202F=\u202F" + shortest(call.z) +
         "</small>";
}

std::string small(bool is_there, const std::string& words) {
  return is_there ? "<small>" + words + "</small>" : "";
}

std::string summary_row(const SubjectResult& law) {
  std::string stages, properties;
  for (const std::string_view stage : kStageNames) stages += stage_cell(std::string(stage), law.points_by_stage);
  for (const std::string_view name : kPropertyNames) properties += property_cell(name.data(), law);
  const Assessment assessment = assessed(law);
  const std::string insufficient = is_of_library_renderer(law) ? "too little to drive" : "opens no device";
  const std::string standing = assessment.standing == Standing::sufficient ? "<span class=\"yes\">held</span>"
                               : assessment.standing == Standing::insufficient
                                   ? "<span class=\"lacking\">" + insufficient + "</span>"
                                   : "<span class=\"no\">failed</span>";
  return "<tr><th scope=\"row\">" + escaped(law.name() + words_behind_name(law.rendered_by)) + "</th>" +
         cell("standing", standing) + cell("parameters", parameters_of(law)) +
         cell("points", grouped(law.points) + small(law.spread.points > 0, "and " + grouped(law.spread.points)), "number") +
         cell("mismatches", faulty(law.mismatches) + small(law.spread.points > 0, "and " + faulty(law.spread.mismatches)),
              "number") +
         stages + properties + cell("closest call", closest_call_of(law, law.identity.kind != kLawKind)) + "</tr>\n";
}

bool has_mesh(const Certificate& certificate) {
  return std::any_of(certificate.subjects.begin(), certificate.subjects.end(),
                     [](const SubjectResult& subject) { return subject.identity.kind == kMeshKind; });
}

// The head of a column for each name.
template <std::size_t n>
std::string column_heads(const std::array<std::string_view, n>& names, const std::string& attributes = "") {
  std::string html;
  for (const std::string_view name : names) html += "<th scope=\"col\"" + attributes + '>' + std::string(name) + "</th>";
  return html;
}

std::string summary(const Certificate& certificate) {
  std::string html =
      "<section>\n<h2>Summary</h2>\n<table class=\"summary\">\n<thead>\n<tr><th></th><th></th><th></th><th></th><th></th>"
      "<th colspan=\"" +
      std::to_string(kStageNames.size()) + "\">points decided by</th><th colspan=\"" + std::to_string(kPropertyNames.size()) +
      "\">properties</th><th></th></tr>\n"
      "<tr><th scope=\"col\">" +
      subject_word(certificate) +
      "</th><th scope=\"col\">standing</th><th scope=\"col\">parameters</th><th scope=\"col\" class=\"number\">points</th>"
      "<th scope=\"col\" class=\"number\">mismatches</th>" +
      column_heads(kStageNames, " class=\"number\"") + column_heads(kPropertyNames) +
      "<th scope=\"col\">closest call</th></tr>\n"
      "</thead>\n<tbody>\n";
  for (const SubjectResult& law : certificate.subjects) html += summary_row(law);
  return html +
         "</tbody>\n</table>\n<p class=\"note\">Points, mismatches: with the parameters on the left, and with others that were "
         "drawn from all of the domain. Decided by: the cheapest arithmetic of the fast path that was sure of every "
         "rounding. Closest call: the point, in mm, whose exact force came nearest to the middle between two neighbouring "
         "binary32 numbers without being there, and how near, in units of the last place (ulp). Where a law is not "
         "conservative, "
         "passivity says that the fast path gives no more energy than the exact law does plus its rounding." +
         (has_mesh(certificate)
              ? " The points of a mesh are a path, in their order. Of a mesh, passivity says that the god-object "
                "never moves away from the position, and that no tick gives more energy than holding the force "
                "and turning it do."
              : "") +
         "</p>\n</section>\n";
}

// Describes, in words and by their digest, the subjects that a name and parameters do not describe.
std::string digests_table(const Certificate& certificate) {
  std::string rows;
  std::set<std::string> kinds;
  for (const SubjectResult& subject : certificate.subjects) {
    if (subject.identity.digest.empty()) continue;
    kinds.insert(subject.identity.kind);
    rows += "<tr><th scope=\"row\">" + escaped(subject.name()) + "</th><td>";
    for (const std::string& part : subject.parts) rows += escaped(part) + "<br>";
    rows += "SHA-256 of its numbers <code>" + escaped(subject.identity.digest) + "</code></td></tr>\n";
  }
  if (rows.empty()) return "";
  const std::string kind = kinds.size() > 1 ? "subject" : *kinds.begin();
  return "<section>\n<h2>The " + escaped(kind) + (kind.ends_with('h') ? "es" : "s") + "</h2>\n<table class=\"facts\">\n" +
         rows + "</table>\n</section>\n";
}

// The subjects in the words of the command.
std::string subject_files(const Certificate& certificate) {
  std::string files;
  for (const SubjectResult& subject : certificate.subjects)
    if (!subject.subject_file.empty())
      files += "<h3>" + escaped(subject.name()) + "</h3>\n<pre>" + escaped(subject.subject_file) + "</pre>\n";
  if (files.empty()) return "";
  return "<details>\n<summary>The subjects, as files for <code>--subject</code></summary>\n" + files + "</details>\n";
}

// One row for each law and kind of sweep.
std::string sweeps_table(const Sweeps& sweeps) {
  if (sweeps.results.empty()) return "";
  constexpr std::array<const char*, 4> kSwept{"every <i>x</i> of the bump, on <i>z</i> = −1\u202Fmm",
                                              "the surface at every <i>x</i> of the bump",
                                              "every <i>x</i>, on a chosen <i>z</i>", "every <i>z</i>, on a chosen <i>x</i>"};
  std::string html =
      "<section>\n<h2>Exhaustive sweeps</h2>\n<table class=\"summary\">\n<thead>\n<tr><th scope=\"col\">law</th><th "
      "scope=\"col\">swept</th><th scope=\"col\">radii, mm</th><th scope=\"col\" class=\"number\">sweeps</th><th "
      "scope=\"col\" class=\"number\">inputs</th><th scope=\"col\" class=\"number\">mismatches</th></tr>\n</thead>\n"
      "<tbody>\n";
  for (const SweepTotal& total : totals(sweeps)) {
    const std::string radii = joined(total.radii, ", ", [](float radius) { return shortest(radius); });
    html += "<tr><th scope=\"row\">" + std::string(name_of(total.law)) + "</th>" +
            cell("swept", kSwept[static_cast<std::size_t>(total.kind)]) + cell("radii, mm", radii.empty() ? "any" : radii) +
            cell("sweeps", grouped(total.sweeps), "number") + cell("inputs", grouped(total.inputs), "number") +
            cell("mismatches", faulty(total.mismatches), "number") + "</tr>\n";
  }
  return html +
         "</tbody>\n</table>\n<p class=\"note\">Every binary32 of one coordinate, numbers below the quantum included (on lines "
         "and columns NaN and infinities too), by the "
         "scalar call and, from the quantum up, by every instruction set of the machine: " +
         html_number(sweeps.seconds, 3) + "\u202Fs.</p>\n</section>\n";
}

std::string counterexamples(const Certificate& certificate) {
  std::string html;
  const auto add = [&](const auto& law, const std::string& what, const std::string& words) {
    html += "<h3>" + escaped(law.name()) + ": " + escaped(what) + "</h3>\n<pre>" + escaped(words) + "</pre>\n";
  };
  for (const SubjectResult& law : certificate.subjects) {
    const std::string mismatches = joined(law.counterexamples, "\n"), spread = joined(law.spread.counterexamples, "\n");
    if (!mismatches.empty())
      add(law, "first " + grouped(law.counterexamples.size()) + " of " + plural(law.mismatches, "wrong answer"), mismatches);
    if (!spread.empty())
      add(law,
          "with other parameters, first " + grouped(law.spread.counterexamples.size()) + " of " +
              plural(law.spread.mismatches, "wrong answer"),
          spread);
    for (const PropertyResult& property : law.properties)
      if (!property.held) add(law, property.name, property.counterexample);
  }
  const std::string swept = joined(certificate.sweeps.counterexamples, "\n");
  if (!swept.empty()) html += "<h3>Exhaustive sweeps</h3>\n<pre>" + escaped(swept) + "</pre>\n";
  return html.empty() ? "" : "<section class=\"counterexamples\">\n<h2>Counterexamples</h2>\n" + html + "</section>\n";
}

// The sets of code that were compared for every law and map.
std::string compared_sets(const Certificate& certificate) {
  std::string list;
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    const std::string name(fast::name_of(set));
    bool covered = !certificate.subjects.empty();
    for (const SubjectResult& law : certificate.subjects) covered = covered && law.covers(name);
    if (covered) list += (list.empty() ? "" : ", ") + name;
  }
  return list.empty() ? "none" : list;
}

std::string build_table(const Certificate& certificate) {
  const Build& build = certificate.build;
  return facts("The build that was checked",
               {
                   {"version", escaped(build.version)},
                   {"revision", "<code>" + escaped(build.revision) + "</code>"},
                   {"compiler", escaped(build.compiler)},
                   {"flags", "<code>" + escaped(build.flags) + "</code>"},
                   {"instruction set", escaped(build.instruction_set) + " is the widest of the machine"},
                   {"compared at the points", compared_sets(certificate)},
                   {"library digest", "<code>" + escaped(build.library_digest) + "</code>"},
                   {"processor", escaped(certificate.processor)},
                   {"date", escaped(certificate.date)},
                   {"seed", "<code>" + in_words(certificate.seeds()) + "</code>"},
                   {"time taken", html_number(certificate.seconds, 3) + "\u202Fs"},
               });
}

constexpr const char* kLimits = R"html(<section>
<h2>What this certifies and what it does not</h2>
<ul class="limits">
<li>Points were checked, not all inputs. Many were aimed at what is hard: surfaces, edges, near-ties, ends of the domain. That every
input is right is a matter of proof, by a machine and separate from this page.</li>
<li>It covers the parameters, height maps and meshes in the tables above. For any other radius, width, stiffness, map, mesh or way to
render a mesh, certify again.</li>
<li>It covers this build: these compiled objects on this kind of machine. Other code, another compiler or other flags have another
digest and need their own certificate.</li>
<li>Lengths are in mm, forces in N, stiffness in N/mm, energy in mJ. A position is three binary32 numbers within ±10<sup>4</sup> mm;
one outside, or NaN, is reported as invalid and gets no force; a coordinate below 2<sup>−30</sup> mm is read as 0.</li>
<li>It is about the force law, not about the device, the servo loop or the hand. A law that is not conservative stays so when it is
rounded correctly: it can give energy to the hand, and only a controller in the servo loop can take that back.</li>
</ul>
</section>
)html";

}  // namespace

std::string to_html(const Certificate& certificate, Pictures shown) {
  const std::string pictures = shown == Pictures::none ? "" : figures(certificate);
  return document("forceshade certificate: " + std::string(name_of(assessed(certificate).standing)),
                  header(certificate) + (!certificate.subjects.empty() ? summary(certificate) : "") +
                      digests_table(certificate) + subject_files(certificate) + matrix(certificate) +
                      sweeps_table(certificate.sweeps) + counterexamples(certificate) +
                      (pictures.empty() ? "" : "<section>\n<h2>Figures</h2>\n" + pictures + "</section>\n") +
                      build_table(certificate) + kLimits);
}

}  // namespace forceshade::properties
