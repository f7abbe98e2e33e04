// SPDX-License-Identifier: BSD-3-Clause
// forceshade-study analyze: the thesis's tables and figures from the results of sessions, with intervals, beside the thesis's
// numbers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/tell.h"
#include "files/csv.h"
#include "files/output_folder.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "study/analysis/figures.h"
#include "study/analysis/origins.h"
#include "study/analysis/page.h"
#include "study/analysis/thesis.h"
#include "study/command/commands.h"
#include "study/command/trial_profiles.h"
#include "study/experiments/results_csv.h"
#include "study/experiments/session_results.h"
#include "subjects/options.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;
using properties::Picture;

struct AnalyzeOptions {
  std::vector<std::string> folders, trials;
  std::string json, width = subjects::kUsualWidth, unit = "trials", shape = "logistic";
  analysis::AnalysisOptions options;

  // Throws Error.
  void read() {
    options.width = static_cast<double>(files::parse_length("--width", width)) / 0.0254;
    if (!(options.width > 0)) throw Error("--width: expected a length above 0 mm, got \"" + width + '"');
    options.resampling.unit = unit == "trials" ? analysis::Unit::trials : analysis::Unit::participants;
    options.model.shape = shape == "logistic" ? analysis::Shape::logistic : analysis::Shape::gaussian;
    options.psychometric_count = std::min<std::size_t>(options.resampling.count, 1000);
  }
};

experiments::Results read_folders(const std::vector<std::string>& folders) {
  experiments::GatheredResults gathered;
  for (const std::string& folder : folders) {
    const bool is_session = std::filesystem::exists(std::filesystem::path(folder) / "trials.jsonl");
    gathered.add(is_session ? experiments::results_of(experiments::read_session(folder)) : experiments::read_results(folder),
                 folder);
  }
  experiments::Results all = std::move(gathered.all);
  for (const std::string& name : analysis::participants_of(all))
    if (name == analysis::kOverall) throw Error("participant: expected a name other than \"overall\", which the tables use");
  if (all.matching.empty() && all.classification.empty())
    throw Error(folders.front() + ": expected at least one trial, got none");
  if (const std::string fault = analysis::fault_of(analysis::origins_of(all)); !fault.empty()) throw Error("folder: " + fault);
  return all;
}

Json origins_json(const analysis::Origins& origins) {
  Json devices = Json::object();
  for (const auto& [device, trials] : origins.devices) devices[device.empty() ? "not recorded" : device] = trials;
  return {{"people", origins.people},
          {"virtual_participants", origins.models},
          {"not_recorded", origins.not_recorded},
          {"trials_by_device", devices},
          {"trials_certified", origins.certified},
          {"trials_not_certified", origins.uncertified},
          {"trials_not_recorded", origins.unknown}};
}

Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json estimate_json(const analysis::Estimate& of) {
  return {{"value", number_json(of.value)}, {"low", number_json(of.interval.low)}, {"high", number_json(of.interval.high)}};
}

constexpr std::array<const char*, 4> kColumnKeys{"slope", "mean_sd_percent", "mean_satisfaction", "mean_steps"};

Json matching_json(const analysis::MatchingTable& table) {
  Json rows = Json::array();
  for (const analysis::MatchingRow& row : table.rows) {
    Json one{{"participant", row.participant}, {"trials", row.trials}, {"intercept_mil", number_json(row.line.intercept)}};
    for (std::size_t k = 0; k < kColumnKeys.size(); ++k) one[kColumnKeys[k]] = estimate_json(row.columns[k]);
    rows.push_back(one);
  }
  const analysis::ThesisMatchingTable* thesis = analysis::thesis_matching(table.stimulus, table.vision);
  Json printed = nullptr;
  if (thesis != nullptr) {
    printed = {{"table", thesis->number}};
    for (std::size_t k = 0; k < kColumnKeys.size(); ++k) printed[kColumnKeys[k]] = thesis->overall().values[k];
  }
  return {{"stimulus", table.stimulus}, {"vision", table.vision}, {"rows", rows}, {"thesis_overall", printed}};
}

Json classification_json(const analysis::ClassificationRow& row) {
  Json percents = Json::array(), printed = nullptr;
  for (const analysis::Estimate& percent : row.percents) percents.push_back(estimate_json(percent));
  const analysis::ThesisClassificationRow* thesis = analysis::thesis_classification(row.stimulus, row.radius);
  if (thesis != nullptr && row.participant == analysis::kOverall) printed = thesis->percents;
  return {{"participant", row.participant}, {"stimulus", row.stimulus}, {"radius_mil", row.radius},
          {"trials", row.trials},           {"percents", percents},     {"thesis_overall", printed}};
}

Json psychometric_json(const analysis::PsychometricEstimate& one) {
  Json points = Json::array();
  for (const analysis::AngleCount& point : one.points)
    points.push_back({{"angle_deg", point.angle}, {"chosen", point.chosen}, {"trials", point.trials}});
  const auto& [threshold, scale, guess, lapse] = one.fit.parameters;
  return {{"participant", one.participant},
          {"theta_critical_deg", estimate_json({threshold, one.threshold})},
          {"scale_deg", estimate_json({scale, one.scale})},
          {"guess", estimate_json({guess, one.guess})},
          {"lapse", estimate_json({lapse, one.lapse})},
          {"deviance", one.fit.deviance},
          {"p_bootstrap", number_json(one.p_bootstrap)},
          {"p_chi_square", number_json(one.p_chi_square)},
          {"at_limit", one.fit.is_at_limit},
          {"points", points}};
}

std::string analysis_json(const analysis::Analysis& analysis, const AnalyzeOptions& options) {
  const analysis::Resampling& resampling = analysis.options.resampling;
  Json json{{"method",
             {{"interval", "BCa"},
              {"level", resampling.level},
              {"unit", options.unit},
              {"seed", resampling.seed},
              {"resamples", resampling.count},
              {"psychometric_shape", options.shape},
              {"psychometric_refits", analysis.options.psychometric_count},
              {"width_mil", analysis.options.width}}},
            {"answered_by", origins_json(analysis::origins_of(analysis.results))},
            {"matching", Json::array()},
            {"classification", Json::array()},
            {"psychometric", Json::array()}};
  for (const auto& table : analysis.matching) json["matching"].push_back(matching_json(table));
  for (const auto& row : analysis.classification) json["classification"].push_back(classification_json(row));
  for (const auto& one : analysis.psychometric) json["psychometric"].push_back(psychometric_json(one));
  return json.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

// The names of the files to write. Throws Error where two conditions would have the same file.
std::vector<std::string> files_of(const experiments::Results& results, const analysis::Profiles& profiles) {
  std::set<std::pair<std::string, bool>> conditions;
  for (const experiments::MatchingResult& trial : results.matching) conditions.emplace(trial.stimulus, trial.vision);
  std::vector<std::string> stems;
  for (const auto& [stimulus, vision] : conditions) {
    const std::string name = analysis::condition_name(stimulus, vision);
    const auto is_same = [&](const std::string& stem) {
      return files::folded_name(stem) == files::folded_name("matching-" + name);
    };
    if (std::ranges::any_of(stems, is_same))
      throw Error("stimulus: expected names that differ in letters, not only capital ones, and digits; two are " + name);
    stems.insert(stems.end(), {"matching-" + name, "satisfaction-" + name});
  }
  if (!results.classification.empty()) stems.emplace_back("psychometric");
  if (!profiles.radii.empty()) stems.emplace_back("radius-profiles");
  for (std::size_t i = 1; i <= profiles.positions.size(); ++i) stems.push_back("position-profile-" + std::to_string(i));
  std::vector<std::string> files{"report.html", "tables.csv"};
  for (const std::string& stem : stems) files.insert(files.end(), {stem + ".svg", stem + ".png"});
  return files;
}

int analyze(AnalyzeOptions& options, const OutFolder& out) {
  options.read();
  experiments::Results results = read_folders(options.folders);
  watch_for_interrupt();
  const bool has_folder = !out.path().empty();
  if (!has_folder && !options.trials.empty()) throw Error("--trial: expected --out beside it, for its figures");
  const analysis::Profiles profiles = profiles_of(options.trials, {options.folders.begin(), options.folders.end()}, results);
  if (has_folder) out.expect_room_for(files_of(results, profiles));
  const analysis::Analysis analysis = analysis::analyze(std::move(results), options.options);
  if (!options.json.empty()) write_file(options.json, analysis_json(analysis, options));
  if (options.json != "-") std::printf("%s", analysis::to_text(analysis).c_str());
  if (!has_folder) return kHeld;
  const std::vector<Picture> pictures = analysis::pictures(analysis, profiles);
  std::vector<std::string> drawn;
  std::vector<std::pair<std::string, std::string>> figures;  // names and bytes of their files: all figures or none
  try {
    for (const Picture& picture : pictures) {
      if (interrupted()) throw Interrupted("not all figures were drawn");
      drawn.push_back(properties::svg_plot(picture));
      figures.emplace_back(picture.frame.id + ".svg", properties::svg_file(picture));
      figures.emplace_back(picture.frame.id + ".png", properties::png_file(picture));
    }
  } catch (const properties::PlotError& error) {
    if (interrupted()) throw Interrupted("not all figures were drawn");
    tell("warning: no figures: " + std::string(error.what()));
    drawn.clear();
    figures.clear();
  }
  files::OutputFolder& folder = out.folder();
  for (const auto& [name, bytes] : figures) folder.write(name, bytes);
  folder.write("tables.csv", analysis::to_csv(analysis));
  folder.write("report.html", analysis::to_html(analysis, pictures, drawn));
  folder.commit();
  return kHeld;
}

}  // namespace

void add_analyze(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand(
      "analyze",
      "Make the tables and figures of the thesis from the results of sessions, with intervals, beside the thesis's numbers");
  const auto options = std::make_shared<AnalyzeOptions>();
  command
      ->add_option("folder", options->folders,
                   "folders of sessions, or with matching.csv, classification.csv or both; all trials are taken together")
      ->type_name("FOLDER")
      ->required();
  const auto out =
      std::make_shared<OutFolder>(*command, "directory for report.html, tables.csv and the figures as .svg and .png");
  add_json(*command, options->json, "all numbers");
  command
      ->add_option("--trial", options->trials,
                   "also draw this trial's radii and positions, such as P-01:12; may be given several times")
      ->type_name("PARTICIPANT:NUMBER")
      ->allow_extra_args(false);
  analysis::Resampling& resampling = options->options.resampling;
  add_whole(*command, "--seed", resampling.seed, "of the resamples: the same seed gives the same intervals", kSeeds);
  add_whole(*command, "--bootstrap", resampling.count,
            "number of resamples for each interval; of these at most 1000 for a psychometric fit", {100, 1000000});
  add_word(*command, "--resample", options->unit,
           "the unit drawn again for the intervals of overall rows: trials, for statements about these participants, or whole "
           "participants, for statements about others, which needs many",
           {"trials", "participants"});
  add_word(*command, "--psychometric", options->shape, "function that is fitted to the answers", {"logistic", "gaussian"});
  add_length(*command, "--width", options->width, "of the bumps, from which the angles of their polygons follow");
  command->callback([options, out, &result] { result = analyze(*options, *out); });
}

}  // namespace forceshade::apps
