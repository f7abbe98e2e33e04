// SPDX-License-Identifier: BSD-3-Clause
#include "report/conformance/page.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "files/printable.h"
#include "properties/binary32.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/recordings/recording_text.h"
#include "report/conformance/figures.h"
#include "report/html.h"
#include "report/page_style.h"

namespace forceshade::conformance {
namespace {

using properties::cell;
using properties::escaped;
using properties::facts;
using properties::faulty;
using properties::grouped;
using properties::held_or_failed;
using properties::html_number;
using properties::plural;

// Text of a renderer or a file.
std::string shown(const std::string& foreign) {
  return escaped(files::printable(foreign));
}

std::string code(const std::string& foreign) {
  return "<code>" + shown(foreign) + "</code>";
}

std::string statement(const std::string& html) {
  return "<p class=\"statement\">" + html + "</p>\n";
}

std::string who(const Conformance& found) {
  const std::string& name = found.hello.name;
  return name.empty() ? "The renderer" : shown(name + ' ' + found.hello.version);
}

bool is_failed(const Invariant& invariant) {
  return invariant.violation.has_value();
}

std::string statement_of_invariants(const std::vector<Invariant>& invariants) {
  if (invariants.empty()) return "";
  const auto failed = std::ranges::count_if(invariants, &is_failed);
  return statement(failed == 0 ? "No violation of an invariant was found."
                               : grouped(static_cast<std::uint64_t>(failed)) + " of " + plural(invariants.size(), "invariant") +
                                     (failed == 1 ? " does" : " do") + " not hold.");
}

std::string statement_of_failure(const std::optional<std::string>& failure) {
  return failure ? statement("The run ended before its end: " + shown(*failure)) : "";
}

std::string statements(const Conformance& found, const Circumstances& circumstances) {
  if (found.hello.refusal) return statement("It does not render this scene: " + shown(*found.hello.refusal));
  std::string html;
  const Count& all = found.judgement.all;
  if (all.cases > 0) {
    html += "Of " + plural(all.cases, "answer") + ", " + grouped(all.cases - all.wrong) +
            (all.cases - all.wrong == 1 ? " is" : " are") + " the exact force rounded to binary32 (nearest, ties to even)";
    if (!circumstances.options.tolerance.value.is_zero())
      html += ", and " + grouped(all.cases - all.beyond) + (all.cases - all.beyond == 1 ? " is" : " are") +
              " within the tolerance, " + escaped(words_of(circumstances.options.tolerance));
    html = statement(html + '.');
  } else if (!found.hello.claims_definition) {
    html = statement("It does not claim the exact definition, and was not compared with it.");
  }
  return html + statement_of_invariants(found.invariants) + statement_of_failure(found.failure);
}

std::string header(const std::string& heading, const std::string& statements, bool held, bool is_applicable = true) {
  const auto [standing, verdict] = !is_applicable ? std::pair("insufficient", "Not applicable")
                                   : held         ? std::pair("held", "Held")
                                                  : std::pair("failed", "Failed");
  return std::string("<header class=\"") + standing + "\">\n<h1>" + heading + "</h1>\n<p class=\"verdict\">" + verdict +
         "</p>\n" + statements + "</header>\n";
}

std::string figures_section(const std::string& pictures) {
  return pictures.empty() ? "" : "<section>\n<h2>Figures</h2>\n" + pictures + "</section>\n";
}

std::string table(const std::string& heading, const std::vector<const char*>& columns, const std::string& rows,
                  const std::string& note) {
  std::string html = "<section>\n<h2>" + heading + "</h2>\n<table class=\"summary\">\n<thead>\n<tr>";
  for (const char* column : columns) html += std::string("<th scope=\"col\">") + column + "</th>";
  return html + "</tr>\n</thead>\n<tbody>\n" + rows + "</tbody>\n</table>\n<p class=\"note\">" + note + "</p>\n</section>\n";
}

std::string aims_table(const Judgement& found) {
  if (found.all.cases == 0) return "";
  std::string rows;
  const auto add = [&](const std::string& aim, const Count& count) {
    rows += "<tr><th scope=\"row\">" + shown(aim) + "</th>" + cell("answers", grouped(count.cases)) +
            cell("not correctly rounded", faulty(count.wrong)) + cell("beyond the tolerance", faulty(count.beyond)) + "</tr>\n";
  };
  add("all", found.all);
  for (const auto& [aim, count] : found.by_aim)
    if (!aim.empty()) add(aim, count);
  std::string note = "By what the position was aimed at.";
  if (found.undecided > 0)
    note += ' ' + plural(found.undecided, "answer") + " at positions that the definition did not decide are not judged.";
  if (found.unfinished > 0)
    note += ' ' + plural(found.unfinished, "answer") +
            " for which the definition’s god-object did not come to rest are not judged.";
  return table("Against the exact force", {"aimed at", "answers", "not correctly rounded", "beyond the tolerance"}, rows, note);
}

constexpr const char* kFelt = "the violation or the largest deviation, and what a hand would feel";

// In words: why it was not tried, or what was found.
std::string found_of(const Invariant& invariant) {
  if (invariant.not_applicable) return *invariant.not_applicable;
  return invariant.violation.value_or(invariant.largest.value_or(""));
}

std::string invariants_table(const std::vector<Invariant>& invariants) {
  if (invariants.empty()) return "";
  std::string rows;
  for (const Invariant& invariant : invariants) {
    const bool is_tried = !invariant.not_applicable;
    rows += "<tr><th scope=\"row\">" + shown(invariant.name) + "</th>" +
            cell("result", is_tried ? held_or_failed(!is_failed(invariant)) : "not applicable") +
            cell("cases", is_tried ? grouped(invariant.cases) : "") + cell(kFelt, shown(found_of(invariant)), "felt") +
            "</tr>\n";
  }
  return table("Invariants", {"invariant", "result", "cases", kFelt}, rows,
               "These must hold of a renderer whatever it renders. No definition is needed to look at it.");
}

// The components below each other.
std::string vector(const Eigen::Vector3f& numbers) {
  std::string html;
  for (const float number : numbers) html += (html.empty() ? "" : "<br>") + escaped(properties::show(number));
  return html;
}

std::string size_of(const Distance& distance) {
  if (distance.ulps == kNoNumber) return "no finite force";
  std::string html = grouped(distance.ulps) + "\u202Fulp<br>" + html_number(distance.newtons.high, 3) + "\u202FN";
  if (distance.exact_newtons.high > 0)
    html += "<br>" + html_number(100 * distance.newtons.high / distance.exact_newtons.high, 3) + "\u202F%";
  return html;
}

std::string worst_table(const Judgement& found) {
  constexpr std::array kUnits{"ulp", "N", "%"};
  std::string rows;
  for (std::size_t unit = 0; unit < kUnits.size(); ++unit) {
    const auto& worst = found.worst[unit];
    if (!worst) continue;
    const std::string aim = worst->its.aim.empty() ? "" : ", aimed at " + worst->its.aim;
    rows += std::string("<tr><th scope=\"row\">") + kUnits[unit] + "</th>" + cell("size", size_of(worst->distance)) +
            cell("place", shown(worst->its.place + aim)) + cell("position, mm", vector(worst->its.position)) +
            cell("answer, N", vector(worst->its.force)) + cell("exact force, rounded, N", vector(worst->exact.force)) +
            "</tr>\n";
  }
  if (rows.empty()) return "";
  return table(
      "The largest errors", {"largest in", "size", "place", "position, mm", "answer, N", "exact force, rounded, N"}, rows,
      "A size in ulp counts the binary32 numbers from the correctly rounded force, in the component that is furthest off; "
      "in N it is the length of the difference from the exact force; in % it is that over the length of the exact force.");
}

std::string counterexample(const Conformance& found) {
  if (!found.counterexample) return "";
  return "<section class=\"counterexamples\">\n<h2>A test to paste</h2>\n<pre>" +
         escaped(test_to_paste(found.identity, found.shortest_path, found.periods_of_shortest_path, *found.counterexample)) +
         "</pre>\n<p class=\"note\">The shortest path found whose last answer is beyond the tolerance, with numbers that are "
         "short "
         "to write. Lines of C; the numbers lose nothing.</p>\n</section>\n";
}

std::string timing(const std::optional<Timing>& its) {
  if (!its) return "";
  return facts("The time of an answer",
               {{"half within", words_of_time(its->p50)},
                {"99.9\u202F% within", words_of_time(its->p999)},
                {"the slowest", words_of_time(its->worst)},
                {"measured", plural(its->answers, "answer") + ", each to a request of one position, from the request to its "
                                                              "answer and with the way through the door"}});
}

std::string capabilities(const std::string& name, const std::string& version, const nlohmann::ordered_json& declared) {
  std::vector<std::pair<std::string, std::string>> rows{{"name", shown(name)}, {"version", shown(version)}};
  for (const auto& [key, value] : declared.items())
    rows.emplace_back(shown(key), shown(value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', true)));
  return facts("Its declaration", rows);
}

std::string run_table(const Identity& identity, const Circumstances& its) {
  std::vector<std::pair<std::string, std::string>> rows{
      {"subject", shown(identity.kind + ' ' + identity.name + ": " + parameters_in_words(identity))}};
  if (!identity.digest.empty()) rows.emplace_back("SHA-256 of its numbers", code(identity.digest));
  rows.emplace_back("tolerance", escaped(words_of(its.options.tolerance)));
  rows.emplace_back("positions", grouped(its.options.points));
  rows.emplace_back("seed", "<code>" + std::to_string(its.options.seed) + "</code>");
  rows.emplace_back("forceshade", shown(its.version));
  if (!its.command.empty()) rows.emplace_back("the command that repeats it", code(its.command));
  return facts("The run", rows);
}

constexpr const char* kStyle = R"css(
tbody th { white-space: normal; }
.one .panel svg { max-width: 860px; }
.one .panel svg[aria-label*="allowed"] { max-width: 620px; }
@media screen and (max-width: 900px) {
  .summary td:empty { display: none; }
  .summary td.felt { grid-column: 1 / -1; }
}
)css";

constexpr const char* kLimits = R"html(<section>
<h2>What this says and what it does not</h2>
<ul class="limits">
<li>Positions were tried, not all of them. Many were aimed at what is hard: surfaces, edges, near-ties, ends of the domain. What held
may fail elsewhere.</li>
<li>Right is the exact force of the definition that the subject names, rounded once. A renderer that has another definition is
wrong here, and may be right by its own; the invariants do not depend on the definition.</li>
<li>Lengths are in mm, forces in N, energy in mJ.</li>
</ul>
</section>
)html";

}  // namespace

std::string to_html(const Conformance& found, const Description& subject, const Circumstances& circumstances,
                    properties::Pictures shown_pictures) {
  const std::string pictures = shown_pictures == properties::Pictures::none ? "" : figures(found.judgement, subject);
  return properties::document("forceshade conform: " + files::printable(found.hello.name + " renders " + found.identity.name),
                              header(who(found) + " as a renderer of " + shown(found.identity.name),
                                     statements(found, circumstances), found.held(), found.is_applicable()) +
                                  aims_table(found.judgement) + worst_table(found.judgement) + counterexample(found) +
                                  figures_section(pictures) + invariants_table(found.invariants) +
                                  capabilities(found.hello.name, found.hello.version, found.hello.declared) +
                                  timing(found.timing) + run_table(found.identity, circumstances) + kLimits,
                              kStyle);
}

std::string to_html(const simulators::SimulatorConformance& found, const std::string& version, const std::string& command,
                    properties::Pictures shown_pictures) {
  const std::string& name = found.simulator.name;
  const std::string pictures = shown_pictures == properties::Pictures::none ? "" : deviations_figure(found.invariants);
  std::vector<std::pair<std::string, std::string>> run{{"forceshade", shown(version)}};
  if (!command.empty()) run.emplace_back("the command that repeats it", code(command));
  return properties::document(
      "forceshade conform: " + files::printable(name),
      header((name.empty() ? "The simulator" : shown(name + ' ' + found.simulator.version)) + " as a simulator",
             statement_of_invariants(found.invariants) + statement_of_failure(found.failure), found.held()) +
          figures_section(pictures) + invariants_table(found.invariants) +
          capabilities(name, found.simulator.version, found.simulator.declared) + facts("The run", run),
      kStyle);
}

std::string to_html(const JudgedRecording& found, const Tolerance& tolerance, const std::string& version,
                    const std::string& command, properties::Pictures shown_pictures) {
  const auto rows = [](const Facts& facts) {
    std::vector<std::pair<std::string, std::string>> html;
    const auto without = [](const std::string& words, const char* ends) {
      return shown(words.substr(0, words.find_last_not_of(ends) + 1));
    };
    for (const auto& [name, value] : facts) html.emplace_back(without(name, ":,"), without(value, ":"));
    return html;
  };
  const auto& comparison = found.comparison;
  std::string said = found.fit && found.fit->refusal ? statement("There is no fit: " + shown(*found.fit->refusal)) : "", forces;
  std::vector<std::pair<std::string, std::string>> run;
  if (comparison) {
    const Count& all = comparison->judgement.all;
    said += statement("Of " + plural(all.cases, "force") + ", " + grouped(all.cases - all.beyond) +
                      (all.cases - all.beyond == 1 ? " is" : " are") + " within the tolerance, " +
                      escaped(words_of(tolerance)) + '.');
    forces = aims_table(comparison->judgement) + worst_table(comparison->judgement);
    if (shown_pictures == properties::Pictures::all)
      forces +=
          figures_section(course_figure(1, comparison->course) + figures(comparison->judgement, comparison->description, 2));
    run.emplace_back("subject", shown(comparison->identity.kind + ' ' + comparison->identity.name + ": " +
                                      parameters_in_words(comparison->identity)));
    run.emplace_back("tolerance", escaped(words_of(tolerance)));
  }
  run.emplace_back("forceshade", shown(version));
  if (!command.empty()) run.emplace_back("the command that repeats it", code(command));
  const std::string beside = comparison ? " beside " + shown(comparison->identity.name) : "";
  return properties::document(
      "forceshade conform: " + files::printable(found.file),
      header(shown(found.file) + beside, said + statement_of_invariants(found.invariants), found.held()) +
          facts("The recording", rows(facts_of(found.pace, found.samples, found.file))) +
          (found.fit && !found.fit->refusal ? facts("The fit", rows(facts_of(*found.fit, found.file))) : "") + forces +
          invariants_table(found.invariants) + facts("The run", run),
      kStyle);
}

}  // namespace forceshade::conformance
