// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/page.h"

#include "report/html.h"
#include "report/page_style.h"
#include "report/plot_text.h"
#include "study/analysis/figures.h"
#include "study/analysis/number_words.h"
#include "study/analysis/origins.h"
#include "study/analysis/thesis.h"

namespace forceshade::analysis {
namespace {

using properties::cell;
using properties::escaped;

constexpr const char* kTables = R"css(
td.number, th.number { white-space: nowrap; }
tr.overall td, tr.overall th { border-top: 1px solid var(--quiet); font-weight: 600; }
tr.thesis td, tr.thesis th { color: var(--quiet); font-weight: 400; font-style: italic; }
.outside { color: var(--failed); }
figure .panels { grid-template-columns: 1fr; }
h3 { margin-top: 26px; }
)css";

std::string estimate_html(const Estimate& estimate, int decimals) {
  return fixed(estimate.value, decimals) +
         (estimate.interval.is_defined() ? "<small>" + fixed(estimate.interval, decimals) + "</small>" : "");
}

std::string row_html(const char* kind, const std::string& name, const std::string& trials,
                     const std::vector<std::string>& numbers, const std::vector<const char*>& labels) {
  std::string html =
      std::string("<tr class=\"") + kind + "\"><th scope=\"row\">" + escaped(name) + "</th>" + cell("trials", trials, "number");
  for (std::size_t k = 0; k < numbers.size(); ++k) html += cell(labels[k], numbers[k], "number");
  return html + "</tr>\n";
}

std::string head_html(const char* first, const std::vector<const char*>& labels) {
  std::string html = std::string("<table class=\"summary\">\n<thead><tr><th scope=\"col\">") + first +
                     "</th><th scope=\"col\" class=\"number\">trials</th>";
  for (const char* label : labels) html += std::string("<th scope=\"col\" class=\"number\">") + label + "</th>";
  return html + "</tr></thead>\n<tbody>\n";
}

const std::vector<const char*> kColumns4(kMatchingColumns.begin(), kMatchingColumns.end());

std::vector<std::string> numbers_html(const MatchingRow& row) {
  std::vector<std::string> numbers;
  for (std::size_t k = 0; k < row.columns.size(); ++k)
    numbers.push_back(estimate_html(row.columns[k], std::max(kMatchingDecimals[k], 1)));
  return numbers;
}

// The thesis's number; marked where the interval of the overall row does not hold it, to rounding.
std::string thesis_number(double printed, int decimals, const Interval& interval) {
  const double half = 0.5 * std::pow(10, -decimals);
  const bool is_outside = interval.is_defined() && (printed + half < interval.low || printed - half > interval.high);
  const std::string text = fixed(printed, decimals);
  return is_outside ? "<span class=\"outside\">" + text + "</span>" : text;
}

std::string thesis_row(const MatchingTable& table) {
  const ThesisMatchingTable* thesis = thesis_matching(table.stimulus, table.vision);
  if (thesis == nullptr) return "";
  std::vector<std::string> numbers;
  for (std::size_t k = 0; k < thesis->overall().values.size(); ++k)
    numbers.push_back(thesis_number(thesis->overall().values[k], kMatchingDecimals[k], table.overall().columns[k].interval));
  return row_html("thesis", "thesis", "300", numbers, kColumns4);
}

std::string matching_html(const std::vector<MatchingTable>& tables) {
  if (tables.empty()) return "";
  std::string html =
      "<section>\n<h2>The matching experiment</h2>\n<p class=\"note\">Below each number is its interval. Slope: of the line of "
      "least "
      "squares through the final radii against the reference radii. Mean SD: at each reference radius the standard deviation "
      "of the "
      "final radii in percent of their mean, averaged over the radii. Mean SI: of the satisfaction index. Steps: changes of "
      "the "
      "radius. The overall row is of all trials pooled, as in the thesis. A number of the thesis that lies outside the "
      "interval of "
      "the overall row is <span class=\"outside\">marked</span>.</p>\n";
  for (const MatchingTable& table : tables) {
    html += "<h3>" + escaped(heading_of(table)) + "</h3>\n" + head_html("participant", kColumns4);
    for (const MatchingRow& row : table.rows)
      html += row_html(&row == &table.rows.back() ? "overall" : "", row.participant, std::to_string(row.trials),
                       numbers_html(row), kColumns4);
    html += thesis_row(table) + "</tbody>\n</table>\n";
  }
  html += "<h3>Table 7.1: overall rows</h3>\n" + head_html("bump", kColumns4);
  for (const MatchingTable& table : tables)
    html += row_html("", title_of(table.stimulus) + (table.vision ? ", vision" : ", no vision"),
                     std::to_string(table.overall().trials), numbers_html(table.overall()), kColumns4) +
            thesis_row(table);
  return html + "</tbody>\n</table>\n</section>\n";
}

std::string classification_html(const std::vector<ClassificationRow>& rows) {
  if (rows.empty()) return "";
  const std::vector<const char*> labels{"1 (%)", "2 (%)", "3 (%)", "4 (%)"};
  std::string html =
      "<section>\n<h2>The classification experiment</h2>\n<p class=\"note\">Answers in percent of the trials of a row: 1 a "
      "plane, 2 two "
      "polygons, 3 three polygons, 4 a circular cylinder. Where no answer or every answer is the same, the interval is the "
      "exact one "
      "of Clopper and Pearson.</p>\n";
  std::string participant;
  for (const ClassificationRow& row : rows) {
    if (row.participant != participant) {
      if (!participant.empty()) html += "</tbody>\n</table>\n";
      participant = row.participant;
      html += "<h3>" + (participant == kOverall ? "Table 6.9: all participants" : escaped(participant)) + "</h3>\n" +
              head_html("bump", labels);
    }
    std::vector<std::string> numbers, printed;
    const ThesisClassificationRow* thesis = participant == kOverall ? thesis_classification(row.stimulus, row.radius) : nullptr;
    for (std::size_t k = 0; k < row.percents.size(); ++k) {
      numbers.push_back(estimate_html(row.percents[k], 0));
      if (thesis != nullptr) printed.push_back(thesis_number(thesis->percents[k], 0, row.percents[k].interval));
    }
    html += row_html("", title_of(row.stimulus) + ", " + fixed(row.radius, 0) + " mil", std::to_string(row.trials), numbers,
                     labels);
    if (thesis != nullptr) html += row_html("thesis", "thesis", "120", printed, labels);
  }
  return html + "</tbody>\n</table>\n</section>\n";
}

std::string psychometric_html(const std::vector<PsychometricEstimate>& estimates) {
  if (estimates.empty()) return "";
  const std::vector<const char*> labels{"θ-critical (°)", "scale (°)",    "guess",        "lapse",
                                        "deviance",       "p, bootstrap", "p, chi-square"};
  std::string html =
      "<section>\n<h2>θ-critical</h2>\n<p class=\"note\">How often a shaded bump, or the cylinder at the angle 0, was taken "
      "for a circular "
      "cylinder, against the angle that each of its polygons subtends: <i>p</i> = guess + (1 − guess − lapse) "
      "<i>F</i>((θ-critical − "
      "angle) / scale). A small <i>p</i> of the deviance means that the angle alone does not explain the answers.</p>\n" +
      head_html("participant", labels);
  for (const PsychometricEstimate& one : estimates) {
    const auto& [threshold, scale, guess, lapse] = one.fit.parameters;
    int trials = 0;
    for (const AngleCount& point : one.points) trials += point.trials;
    html += row_html(one.participant == kOverall ? "overall" : "", one.participant, std::to_string(trials),
                     {estimate_html({threshold, one.threshold}, 1), estimate_html({scale, one.scale}, 1),
                      estimate_html({guess, one.guess}, 2), estimate_html({lapse, one.lapse}, 2), fixed(one.fit.deviance, 1),
                      fixed(one.p_bootstrap, 3), fixed(one.p_chi_square, 3)},
                     labels);
  }
  html += "</tbody>\n</table>\n";
  for (const PsychometricEstimate& one : estimates)
    if (one.fit.is_at_limit)
      html += "<p class=\"note\">" + escaped(one.participant) +
              ": a parameter lies at a limit of its range, so the data do not determine all four.</p>\n";
  return html + "</section>\n";
}

std::string caption_of(const properties::Picture& picture) {
  const std::string& id = picture.frame.id;
  if (id.starts_with("matching-"))
    return "Each mark is a trial that began with a small radius (o), the reference radius (×) or a large one (+); the three "
           "kinds are drawn beside each other. Above each reference radius is the "
           "standard deviation "
           "there, in percent of the mean. In brackets: the interval of the slope.";
  if (id.starts_with("satisfaction-")) return "The thesis's satisfaction index, from 1, different, to 10, the same.";
  if (id == "psychometric") return "Each point is a bump and a radius. In brackets: the interval of θ-critical.";
  if (id == "radius-profiles") return "Each point is a change of the radius by the participant.";
  return "Dots are positions of the stylus. It is below the surface wherever a force is felt.";
}

std::string figures_html(const std::vector<properties::Picture>& pictures, const std::vector<std::string>& drawn) {
  if (drawn.empty()) return "";
  std::string html = "<section>\n<h2>Figures</h2>\n";
  for (std::size_t i = 0; i < drawn.size(); ++i)
    html += properties::figure(static_cast<int>(i) + 1, "", escaped(pictures[i].frame.description), "", {{"", drawn[i]}},
                               caption_of(pictures[i]));
  return html + "</section>\n";
}

}  // namespace

std::vector<properties::Picture> pictures(const Analysis& analysis, const Profiles& profiles) {
  std::vector<properties::Picture> all;
  for (const MatchingTable& table : analysis.matching) {
    all.push_back(scatter(analysis.results, table));
    all.push_back(satisfaction(analysis.results, table));
  }
  if (!analysis.psychometric.empty()) all.push_back(psychometric_figure(analysis.psychometric, analysis.options.model));
  if (!profiles.radii.empty()) all.push_back(radius_profiles(profiles.radii));
  for (std::size_t i = 0; i < profiles.positions.size(); ++i) {
    all.push_back(position_profile(profiles.positions[i]));
    all.back().frame.id.append("-").append(std::to_string(i + 1));
  }
  if (origins_of(analysis.results).are_virtual())
    for (properties::Picture& one : all) one.frame.description += ", virtual participants";
  return all;
}

std::string to_html(const Analysis& analysis, const std::vector<properties::Picture>& pictures,
                    const std::vector<std::string>& drawn) {
  const std::size_t people = participants_of(analysis.results).size();
  const Origins origins = origins_of(analysis.results);
  const bool are_virtual = origins.are_virtual();
  std::string statements;
  for (const std::string& sentence : sentences_of(origins)) statements += (statements.empty() ? "" : " ") + escaped(sentence);
  if (!statements.empty()) statements = "<p class=\"statement\"><strong>" + statements + "</strong></p>\n";
  return properties::document(
      "forceshade analysis",
      std::string("<header>\n<h1>forceshade: analysis of the experiments") + (are_virtual ? " with virtual participants" : "") +
          "</h1>\n<p class=\"statement\">" + properties::plural(people, are_virtual ? "virtual participant" : "participant") +
          ", " + properties::grouped(analysis.results.matching.size()) + " matching and " +
          properties::grouped(analysis.results.classification.size()) + " classification trials.</p>\n" + statements +
          "<p class=\"statement\">" + escaped(method_of(analysis.options)) + ".</p>\n</header>\n" +
          matching_html(analysis.matching) + classification_html(analysis.classification) +
          psychometric_html(analysis.psychometric) + figures_html(pictures, drawn),
      kTables);
}

}  // namespace forceshade::analysis
