// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/analysis.h"

#include <algorithm>

#include "files/csv.h"
#include "files/printable.h"
#include "study/analysis/number_words.h"
#include "study/analysis/origins.h"
#include "study/analysis/thesis.h"

namespace forceshade::analysis {
namespace {

// Columns as wide as their longest cell, two spaces between them.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  const auto length = [](const std::string& text) {  // in characters
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
  };
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], length(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line.append("  ").append(row[i]).append(i + 1 < row.size() ? widths[i] - length(row[i]) : 0, ' ');
    text += line + '\n';
  }
  return text;
}

std::string with_interval(const Estimate& estimate, int decimals) {
  const std::string value = fixed(estimate.value, decimals);
  return estimate.interval.is_defined() ? value + " (" + fixed(estimate.interval, decimals) + ')' : value;
}

// Steps get a decimal, which the thesis does not print: their intervals are narrow.
int decimals_of(std::size_t column) {
  return std::max(kMatchingDecimals[column], 1);
}

std::vector<std::string> cells(const std::string& name, const MatchingRow& row) {
  std::vector<std::string> all{files::printable(name), std::to_string(row.trials)};
  for (std::size_t k = 0; k < row.columns.size(); ++k) all.push_back(with_interval(row.columns[k], decimals_of(k)));
  return all;
}

std::vector<std::string> thesis_cells(const std::array<double, 4>& values) {
  std::vector<std::string> all{"thesis", "300"};
  for (std::size_t k = 0; k < values.size(); ++k) all.push_back(fixed(values[k], kMatchingDecimals[k]));
  return all;
}

const std::vector<std::string> kHeader{"participant", "trials", "slope", "mean SD (%)", "mean SI", "mean steps"};

std::string matching_text(const MatchingTable& table) {
  std::vector<std::vector<std::string>> rows{kHeader};
  for (const MatchingRow& row : table.rows) rows.push_back(cells(row.participant, row));
  if (const ThesisMatchingTable* thesis = thesis_matching(table.stimulus, table.vision))
    rows.push_back(thesis_cells(thesis->overall().values));
  return files::printable(heading_of(table)) + '\n' + aligned(rows) + '\n';
}

std::string summary_text(const std::vector<MatchingTable>& tables) {
  std::vector<std::vector<std::string>> rows{kHeader};
  rows[0][0] = "bump";
  for (const MatchingTable& table : tables)
    rows.push_back(cells(title_of(table.stimulus) + (table.vision ? ", vision" : ", no vision"), table.overall()));
  return "Table 7.1: overall rows\n" + aligned(rows) + '\n';
}

std::string classification_text(const std::vector<ClassificationRow>& all) {
  std::vector<std::vector<std::string>> rows{{"bump", "radius (mil)", "trials", "1 (%)", "2 (%)", "3 (%)", "4 (%)", "thesis"}};
  for (const ClassificationRow& row : all) {
    if (row.participant != kOverall) continue;
    std::vector<std::string> line{files::printable(title_of(row.stimulus)), shortest(row.radius), std::to_string(row.trials)};
    for (const Estimate& percent : row.percents) line.push_back(with_interval(percent, 0));
    std::string thesis;
    if (const ThesisClassificationRow* printed = thesis_classification(row.stimulus, row.radius))
      for (const int percent : printed->percents) thesis += (thesis.empty() ? "" : " ") + std::to_string(percent);
    line.push_back(thesis.empty() ? "-" : thesis);
    rows.push_back(line);
  }
  return "Table 6.9: answers, all participants\n" + aligned(rows) + '\n';
}

std::string psychometric_text(const std::vector<PsychometricEstimate>& all) {
  std::vector<std::vector<std::string>> rows{
      {"participant", "θ-critical (°)", "scale (°)", "guess", "lapse", "deviance", "p, bootstrap", "p, chi-square", ""}};
  for (const PsychometricEstimate& one : all) {
    const auto& [threshold, scale, guess, lapse] = one.fit.parameters;
    rows.push_back({files::printable(one.participant), with_interval({threshold, one.threshold}, 1),
                    with_interval({scale, one.scale}, 1), with_interval({guess, one.guess}, 2),
                    with_interval({lapse, one.lapse}, 2), fixed(one.fit.deviance, 1), fixed(one.p_bootstrap, 3),
                    fixed(one.p_chi_square, 3), one.fit.is_at_limit ? "at a limit of its range" : ""});
  }
  return "Answer 4 against the angle that each polygon subtends\n" + aligned(rows) + '\n';
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\" ") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(double value) {
  return std::isfinite(value) ? shortest(value) : "";
}

std::string csv_end(const char* column, const Estimate& estimate, const std::string& thesis, const std::string& who) {
  return std::string(",").append(column) + ',' + csv_number(estimate.value) + ',' + csv_number(estimate.interval.low) + ',' +
         csv_number(estimate.interval.high) + ',' + thesis + ',' + who + '\n';
}

}  // namespace

Analysis analyze(experiments::Results results, const AnalysisOptions& options) {
  Analysis analysis{std::move(results), options, {}, {}, {}};
  analysis.matching = matching_tables(analysis.results, options.resampling);
  analysis.classification = classification_rows(analysis.results, options.resampling);
  Resampling refits = options.resampling;
  refits.count = options.psychometric_count;
  std::vector<std::string> names = participants_of(analysis.results);
  names.emplace_back(kOverall);
  for (const std::string& name : names)
    if (auto one = estimate(name, angle_counts(analysis.results, options.width, name), options.model, refits))
      analysis.psychometric.push_back(*one);
  return analysis;
}

std::string condition_words(const MatchingTable& table) {
  return title_of(table.stimulus) + (table.vision ? ", with vision" : ", no vision");
}

std::string heading_of(const MatchingTable& table) {
  const ThesisMatchingTable* thesis = thesis_matching(table.stimulus, table.vision);
  return (thesis == nullptr ? "Table: " : "Table " + thesis->number + ": ") + condition_words(table);
}

std::string method_of(const AnalysisOptions& options) {
  const Resampling& resampling = options.resampling;
  const bool is_trials = resampling.unit == Unit::trials;
  return fixed(100 * resampling.level, 0) + " % BCa intervals (Efron 1987) of " + std::to_string(resampling.count) +
         " resamples, seed " + std::to_string(resampling.seed) +
         (is_trials ? "; units: trials within participant and radius, so the intervals are about these participants"
                    : "; units in overall rows: participants, so those intervals are about people like them") +
         "; psychometric fits: maximum likelihood, " + std::to_string(options.psychometric_count) + " refits";
}

std::string to_text(const Analysis& analysis) {
  std::string text;
  for (const MatchingTable& table : analysis.matching) text += matching_text(table);
  if (!analysis.matching.empty()) text += summary_text(analysis.matching);
  if (!analysis.classification.empty()) text += classification_text(analysis.classification);
  if (!analysis.psychometric.empty()) text += psychometric_text(analysis.psychometric);
  for (const std::string& sentence : sentences_of(origins_of(analysis.results))) text += files::printable(sentence) + '\n';
  return text + method_of(analysis.options) + '\n';
}

std::string to_csv(const Analysis& analysis) {
  std::string text = "table,stimulus,vision,radius_mil,participant,trials,column,value,low,high,thesis,answered_by\n";
  const Origins origins = origins_of(analysis.results);
  constexpr std::array<const char*, 4> kNames{"slope", "mean_sd_percent", "mean_satisfaction", "mean_steps"};
  constexpr std::array<const char*, 4> kAnswers{"percent_1", "percent_2", "percent_3", "percent_4"};
  for (const MatchingTable& table : analysis.matching) {
    const ThesisMatchingTable* thesis = thesis_matching(table.stimulus, table.vision);
    for (const MatchingRow& row : table.rows)
      for (std::size_t k = 0; k < row.columns.size(); ++k) {
        const bool has_thesis = thesis != nullptr && &row == &table.rows.back();
        text += (thesis == nullptr ? "" : thesis->number) + ',' + csv_text(table.stimulus) +
                (table.vision ? ",yes,," : ",no,,") + csv_text(row.participant) + ',' + std::to_string(row.trials) +
                csv_end(kNames[k], row.columns[k], has_thesis ? fixed(thesis->overall().values[k], kMatchingDecimals[k]) : "",
                        answered_by(origins, row.participant));
      }
  }
  for (const ClassificationRow& row : analysis.classification) {
    const ThesisClassificationRow* thesis = thesis_classification(row.stimulus, row.radius);
    for (std::size_t k = 0; k < row.percents.size(); ++k)
      text += std::string(thesis == nullptr ? "" : "6.9") + ',' + csv_text(row.stimulus) + ",," + shortest(row.radius) + ',' +
              csv_text(row.participant) + ',' + std::to_string(row.trials) +
              csv_end(kAnswers[k], row.percents[k],
                      thesis != nullptr && row.participant == kOverall ? std::to_string(thesis->percents[k]) : "",
                      answered_by(origins, row.participant));
  }
  return text;
}

}  // namespace forceshade::analysis
