// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certificate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "certificate/build_json.h"
#include "certificate/certificate_text.h"
#include "certificate/findings_json.h"
#include "rendering/breakdown.h"
#include "rendering/identity/identity_json.h"
#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;

Json comparison_json(const Comparison& found) {
  return {{"points", found.points},
          {"mismatches", found.mismatches},
          {"points_by_instruction_set", found.points_by_instruction_set},
          {"points_by_aim", found.points_by_aim},
          {"points_by_stage", found.points_by_stage},
          {"points_by_method", found.points_by_method},
          {"points_by_status", found.points_by_status},
          {"counterexamples", found.counterexamples}};
}

void add_assessment(Json& json, const Assessment& assessment) {
  json["standing"] = name_of(assessment.standing);
  json["lacks"] = assessment.lacks;
}

// After what names the subject.
void add_findings(Json& json, const Findings& law, bool is_unit) {
  Json properties = Json::array();
  for (const PropertyResult& p : law.properties) properties.push_back(json_of(p));
  Json energy = Json::array();
  for (const LoopEnergy& e : law.energy) energy.push_back(json_of(e));
  json.update({{"continuous", law.jumps.empty()}, {"jumps", law.jumps}, {"unit", is_unit}, {"conservative", law.conservative}});
  json.update(comparison_json(law));
  Json spread{{"parameter_sets", law.spread.parameter_sets}};
  spread.update(comparison_json(law.spread));
  json.update({{"closest_call", json_of(law.closest_call)},
               {"spread", spread},
               {"properties", properties},
               {"energy_per_loop", energy}});
}

Json subject_json(const SubjectResult& subject) {
  const Identity& identity = subject.identity;
  Json json{{"kind", identity.kind},
            {"name", identity.name},
            {"renderer", kRenderedByNames[static_cast<std::size_t>(subject.rendered_by)]},
            {"held", subject.held()}};
  add_assessment(json, assessed(subject));
  if (!identity.digest.empty()) json["digest"] = identity.digest;
  json["parameters"] = parameters_json(identity);
  if (!subject.parts.empty()) json["parts"] = subject.parts;
  json["seeds"] = subject.seeds;
  if (!subject.subject_file.empty()) json["subject_file"] = subject.subject_file;
  add_findings(json, subject, subject.unit_directions);
  return json;
}

Json sweeps_json(const Sweeps& sweeps) {
  Json list = Json::array();
  for (const SweepResult& result : sweeps.results)
    list.push_back({{"law", name_of(result.sweep.law)},
                    {"parameters", parameters_json(identity_of(result.sweep.law, result.sweep.parameters))},
                    {"kind", kSweepKinds[static_cast<std::size_t>(result.sweep.kind)]},
                    {"at_mm", static_cast<double>(result.sweep.at)},
                    {"inputs", result.inputs},
                    {"mismatches", result.mismatches}});
  Json stages = Json::object();
  for (std::size_t i = 0; i < kStageNames.size(); ++i) stages[std::string(kStageNames[i])] = sweeps.stages[i];
  return {{"finished", sweeps.is_finished()},
          {"units", {{"first", sweeps.first}, {"end", sweeps.end}, {"next", sweeps.next}, {"of", sweeps.units()}}},
          {"seconds", sweeps.seconds},
          {"inputs", sweeps.inputs()},
          {"mismatches", sweeps.mismatches()},
          {"calls_by_stage", stages},
          {"counterexamples", sweeps.counterexamples},
          {"sweeps", list}};
}

// JSON has no infinity and no NaN: written, they would be null.
void refuse_what_is_not_finite(const Json& json, const std::string& place) {
  if (json.is_number_float() && !std::isfinite(json.get<double>()))
    throw Error("no certificate can be written: " + place + " is " + digits(json.get<double>(), 6) +
                "; expected a finite number");
  if (!json.is_structured()) return;
  for (const auto& member : json.items())
    refuse_what_is_not_finite(member.value(), json.is_array() ? place + '[' + member.key() + ']'
                                              : place.empty() ? member.key()
                                                              : place + '.' + member.key());
}

Json json_of(const Certificate& certificate) {
  Json subjects = Json::array();
  for (const SubjectResult& subject : certificate.subjects) subjects.push_back(subject_json(subject));
  Json json{{"schema", kCertificateSchema}, {"held", certificate.held()}};
  add_assessment(json, assessed(certificate));
  json.update({{"statement", kStatement},
               {"method", kMethod},
               {"domain", Json::parse(kDomain)},
               {"build", build_json(certificate.build)},
               {"date", certificate.date},
               {"processor", certificate.processor},
               {"seconds", certificate.seconds},
               {"subjects", subjects}});
  if (!certificate.sweeps.results.empty()) json["exhaustive"] = sweeps_json(certificate.sweeps);
  return json;
}

std::string written(const Json& json) {
  refuse_what_is_not_finite(json, "");
  // A file's name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

bool Comparison::covers(const std::string& instruction_set) const {
  const auto found = points_by_instruction_set.find(instruction_set);
  return found != points_by_instruction_set.end() && points > 0 && found->second == points;
}

bool Findings::has_held(std::string_view property) const {
  return std::any_of(properties.begin(), properties.end(),
                     [&](const PropertyResult& p) { return p.name == property && p.held; });
}

bool Findings::held() const {
  return points > 0 && mismatches == 0 && spread.mismatches == 0 &&
         std::all_of(kPropertyNames.begin(), kPropertyNames.end(),
                     [&](std::string_view property) { return has_held(property); });
}

bool Certificate::held() const {
  const bool is_empty = subjects.empty() && sweeps.results.empty();
  const bool swept = sweeps.results.empty() || (sweeps.is_whole() && sweeps.mismatches() == 0);
  return !is_empty && swept &&
         std::all_of(subjects.begin(), subjects.end(), [](const SubjectResult& subject) { return subject.held(); });
}

std::vector<std::uint64_t> Certificate::seeds() const {
  std::set<std::uint64_t> all;
  for (const SubjectResult& subject : subjects) all.insert(subject.seeds.begin(), subject.seeds.end());
  return {all.begin(), all.end()};
}

std::string in_words(const std::vector<std::uint64_t>& seeds) {
  return joined(seeds, ", ", in_digits, " and ");
}

std::string to_json(const Certificate& certificate) {
  return written(json_of(certificate));
}

std::string evidence_of(const Certificate& certificate, const std::string& missing) {
  Json json = json_of(certificate);
  for (const char* of_the_run : {"date", "processor", "seconds"}) json.erase(of_the_run);
  if (json.contains("exhaustive")) json["exhaustive"].erase("seconds");
  return written({{"evidence", {{"complete", missing.empty()}, {"missing", missing}}}, {"certificate", json}});
}

}  // namespace forceshade::properties
