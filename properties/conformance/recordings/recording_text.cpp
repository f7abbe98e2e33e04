// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/recording_text.h"

#include "properties/conformance/judgement_text.h"
#include "properties/conformance/recordings/words.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

std::string lines_of(const Facts& facts, const std::string& indent) {
  std::string lines;
  for (const auto& [name, value] : facts) lines += indent + name + ' ' + value + '\n';
  return lines;
}

std::string words_of(const Fit& fit, const std::string& file) {
  if (fit.refusal) return "FAILED: there is no fit: " + *fit.refusal + '\n';
  return "  fitted to " + lines_of(facts_of(fit, file), "    ").substr(4);
}

std::string words_of(const Spread& spread, const std::string& unit) {
  return "half of them at most " + brief(spread.half) + unit + ", 90 % " + brief(spread.p90) + unit + ", 99 % " +
         brief(spread.p99) + unit + ", all " + brief(spread.all) + unit + '\n';
}

Json json_of(const Spread& spread) {
  return {{"p50", spread.half}, {"p90", spread.p90}, {"p99", spread.p99}, {"most", spread.all}};
}

Json json_of(const Fit& fit) {
  if (fit.refusal) return {{"refusal", *fit.refusal}};
  const Placement& at = fit.placement;
  Json json{{"stiffness_N_per_mm", fit.stiffness}, {"stiffness_error_N_per_mm", fit.stiffness_error}};
  for (Eigen::Index row = 0; row < 3; ++row) json["turn"].push_back({at.turn(row, 0), at.turn(row, 1), at.turn(row, 2)});
  json["turn_error_degrees"] = fit.turn_error;
  json["shift_mm"] = {at.shift.x(), at.shift.y(), at.shift.z()};
  json["shift_error_mm"] = fit.shift_error;
  json["offset_N"] = {at.offset.x(), at.offset.y(), at.offset.z()};
  json["offset_error_N"] = {fit.offset_error.x(), fit.offset_error.y(), fit.offset_error.z()};
  json["lag_s"] = at.lag;
  json["lag_error_s"] = fit.lag_error;
  json["rests"] = fit.rests;
  json["noise_at_rest_N"] = fit.noise_at_rest;
  json["undetermined"] = fit.undetermined;
  json["samples"] = fit.samples;
  json["contacts"] = fit.contacts;
  json["left_out"] = fit.outliers;
  json["rms_N"] = fit.rms;
  json["largest_N"] = fit.largest;
  json["largest_at_line"] = fit.largest_at;
  return json;
}

}  // namespace

Facts facts_of(const Pace& pace, std::size_t samples, const std::string& file) {
  Facts facts{{file + ':', std::to_string(samples) + " samples in " + brief(pace.seconds) + " s, " + brief(pace.rate) + " Hz"},
              {"intervals:", "median " + milliseconds(pace.median) + ", 99 % at most " + milliseconds(pace.p99) + ", longest " +
                                 milliseconds(pace.longest) + ", jitter " + milliseconds(pace.jitter)}};
  if (pace.repeats == 0) return facts;
  facts.emplace_back(
      "at " + std::to_string(pace.repeats) + " samples",
      "the position is that of the one before; the force changes by " + newtons(pace.noise) + " (root mean square)");
  facts.emplace_back("new positions:", brief(pace.rate_of_positions) + " Hz, without a hand at rest");
  return facts;
}

Facts facts_of(const Fit& fit, const std::string& file) {
  Facts facts;
  if (fit.refusal) return facts;
  facts.emplace_back(std::to_string(fit.samples) + " samples,",
                     std::to_string(fit.contacts) + " in contact, " + std::to_string(fit.outliers) + " left out:");
  facts.emplace_back("stiffness", brief(fit.stiffness) + " +- " + brief(fit.stiffness_error) + " N/mm");
  for (Eigen::Index row = 0; row < 3; ++row)
    facts.emplace_back(std::string(1, "xyz"[row]),
                       "= " + brief(fit.placement.turn(row, 0)) + " x' + " + brief(fit.placement.turn(row, 1)) + " y' + " +
                           brief(fit.placement.turn(row, 2)) + " z' + " + brief(fit.placement.shift[row]) + " mm");
  facts.emplace_back("turn", "+- " + brief(fit.turn_error) + " degrees, shift +- " + brief(fit.shift_error) + " mm");
  const Placement& at = fit.placement;
  const auto force_with_error = [&](Eigen::Index axis) {
    return brief(at.offset[axis]) + " +- " + brief(fit.offset_error[axis]);
  };
  facts.emplace_back("offset of the force",
                     force_with_error(0) + ", " + force_with_error(1) + ", " + force_with_error(2) + " N along x', y', z'");
  facts.emplace_back("lag of the force", brief(1000 * at.lag) + " +- " + milliseconds(fit.lag_error));
  facts.emplace_back("at rest", fit.rests == 0 ? "no sample"
                                               : std::to_string(fit.rests) + " samples, noise " + newtons(fit.noise_at_rest) +
                                                     " (root mean square)");
  for (const std::string& name : fit.undetermined) facts.emplace_back("not determined by these samples:", name);
  facts.emplace_back("residuals:", "root mean square " + newtons(fit.rms) + ", largest " + newtons(fit.largest) + " at " +
                                       file + ':' + std::to_string(fit.largest_at));
  return facts;
}

std::string words_of(const JudgedRecording& found, const Tolerance& tolerance) {
  std::string words = lines_of(facts_of(found.pace, found.samples, found.file), "  ").substr(2);
  if (found.fit) words += words_of(*found.fit, found.file);
  if (const auto& comparison = found.comparison) {
    words += "  differences from the exact force in N: " + words_of(comparison->newtons, "") +
             "  in % of it, in contact: " + words_of(comparison->percent, "");
    words += words_of(comparison->judgement, comparison->identity, tolerance);
  }
  for (const Invariant& invariant : found.invariants) words += words_of(invariant);
  return words;
}

Json json_of(const JudgedRecording& found, const Tolerance& tolerance) {
  const Pace& pace = found.pace;
  Json json{{"schema", "forceshade judged recording 1"},
            {"held", found.held()},
            {"file", found.file},
            {"samples", found.samples},
            {"pace",
             {{"seconds", pace.seconds},
              {"rate_Hz", pace.rate},
              {"median_s", pace.median},
              {"p99_s", pace.p99},
              {"longest_s", pace.longest},
              {"jitter_s", pace.jitter},
              {"repeats", pace.repeats},
              {"rate_of_positions_Hz", pace.rate_of_positions},
              {"noise_N", pace.noise}}}};
  if (found.fit) json["fit"] = json_of(*found.fit);
  if (const auto& comparison = found.comparison) {
    json["difference_N"] = json_of(comparison->newtons);
    json["difference_percent"] = json_of(comparison->percent);
    json["exact"] = json_of(comparison->judgement, comparison->identity, tolerance);
  }
  json["invariants"] = Json::array();
  for (const Invariant& invariant : found.invariants) json["invariants"].push_back(json_of(invariant));
  return json;
}

}  // namespace forceshade::conformance
