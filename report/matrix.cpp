// SPDX-License-Identifier: BSD-3-Clause
#include "report/matrix.h"

#include <algorithm>

#include "report/html.h"
#include "text/joined.h"

namespace forceshade::properties {
namespace {

std::string yes_or_no(bool yes, const std::string& words = "") {
  return std::string(yes ? "yes" : "no") + (words.empty() ? "" : "<small>" + words + "</small>");
}

std::string continuous(const Findings& law) {
  return law.jumps.empty() ? "yes" : "no<small class=\"words\">jumps on " + joined(law.jumps, ", ", &escaped) + "</small>";
}

std::string unit_of(const SubjectResult& subject) {
  const bool is_sum = subject.identity.kind == kLawKind && subject.name() == name_of(LawId::bump_cylinder);
  return yes_or_no(subject.unit_directions, is_sum                                  ? "each of its two forces"
                                            : is_conservative_map(subject.identity) ? "as long as the map is steep"
                                                                                    : "");
}

// At the greatest depth that was walked.
std::string energy_of(const Findings& law) {
  if (law.conservative) return "0";
  if (law.energy.empty()) return "not measured";
  const LoopEnergy& loop = law.energy.back();
  return html_number(loop.bound_mJ[1], 5) + "\u202FmJ<small>" + html_number(loop.depth_mm, 4) + "\u202Fmm deep; fast path " +
         html_number(loop.measured_mJ, 5) + "\u202FmJ</small>";
}

}  // namespace

std::string subject_word(const Certificate& certificate) {
  const std::string& kind = certificate.subjects.front().identity.kind;
  const auto is_other = [&](const SubjectResult& subject) { return subject.identity.kind != kind; };
  return std::any_of(certificate.subjects.begin(), certificate.subjects.end(), is_other) ? "subject" : escaped(kind);
}

std::string matrix(const Certificate& certificate) {
  if (certificate.subjects.empty()) return "";
  const std::string word = subject_word(certificate);
  std::string html = "<section>\n<h2>What kind of force each " + word +
                     " is</h2>\n<table class=\"summary\">\n<thead>\n<tr><th scope=\"col\">" + word +
                     "</th>"
                     "<th scope=\"col\">continuous</th><th scope=\"col\">unit direction</th><th scope=\"col\">conservative</th>"
                     "<th scope=\"col\">most energy per loop</th></tr>\n</thead>\n<tbody>\n";
  for (const SubjectResult& law : certificate.subjects)
    html += "<tr><th scope=\"row\">" + escaped(law.name()) + "</th>" + cell("continuous", continuous(law)) +
            cell("unit direction", unit_of(law)) + cell("conservative", yes_or_no(law.conservative)) +
            cell("most energy per loop", energy_of(law)) + "</tr>\n";
  return html +
         "</tbody>\n</table>\n<p class=\"note\">Energy: the most that any simple loop no deeper below the nominal surface can "
         "give to the hand (in a height map: any in the slice y = 0, 12.7\u202Fmm to both sides or 250 cells of its finest "
         "grid; it is not measured for a mesh), and "
         "what the fast path gave around one that comes within 1\u202F% of it.</p>\n</section>\n";
}

}  // namespace forceshade::properties
