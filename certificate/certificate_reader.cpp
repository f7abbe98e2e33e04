// SPDX-License-Identifier: BSD-3-Clause
// certificate.json as it is read: nothing is taken that is not in the schema or contradicts the rest.

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "certificate/build_json.h"
#include "certificate/certificate_text.h"
#include "certificate/findings_json.h"
#include "certificate/json_fields.h"
#include "forceshade/certificate.h"
#include "forceshade/fast.h"
#include "rendering/breakdown.h"
#include "text/joined.h"

namespace forceshade::properties {
namespace {

const std::string& in_words(bool value) {
  static const std::string words[]{"false, as the rest of the certificate says", "true, as the rest of the certificate says"};
  return words[value ? 1 : 0];
}

void read_flag(Fields& fields, const char* key, bool must_be) {
  const bool is = fields.flag(key);
  fields.expect(key, is == must_be, in_words(must_be));
}

template <std::size_t kCount>
std::string one_of(const std::array<std::string_view, kCount>& names) {
  return "one of " + joined(names, ", ");
}

Parameters parameters_from(LawId law, Fields fields) {
  Parameters p;
  if (has_bump_geometry(law)) {
    p.radius = fields.binary32("radius_mm");
    p.width = fields.binary32("width_mm");
  }
  p.stiffness = fields.binary32("stiffness_N_per_mm");
  const auto built = fast::Law::build(law, p);
  if (const auto* error = std::get_if<ParameterError>(&built)) throw Error(error->message());
  fields.end();
  return p;
}

LawId law_id_from(Fields& fields, const char* key) {
  const std::string name = fields.text(key);
  if (const auto id = law_named(name)) return *id;
  throw Error("unknown law \"" + name + "\"");
}

// Each of `names` is counted, nothing else is, and the counts are those of all points.
template <std::size_t kCount>
Comparison::Counts breakdown(Fields& fields, const char* key, const std::array<std::string_view, kCount>& names,
                             std::uint64_t points) {
  Comparison::Counts counts = fields.counts(key);
  std::uint64_t left = points;
  bool fits = counts.size() == kCount;
  for (const std::string_view name : names) {
    const auto found = counts.find(std::string(name));
    fits = fits && found != counts.end() && found->second <= left;
    if (fits) left -= found->second;
  }
  fields.expect(key, fits && left == 0, "counts of " + one_of(names).substr(7) + " that add up to " + std::to_string(points));
  return counts;
}

Comparison::Counts sets_from(Fields& fields, std::uint64_t points, const Build& build) {
  constexpr const char* kKey = "points_by_instruction_set";
  Comparison::Counts counts = fields.counts(kKey);
  bool fits = counts.contains("scalar") && counts.contains(build.instruction_set);
  for (const auto& [name, count] : counts) fits = fits && fast::instruction_set_named(name) && count == points;
  fields.expect(
      kKey, fits,
      std::to_string(points) + " for each set that was compared, scalar and " + build.instruction_set + " among them");
  return counts;
}

// most: how many may have been kept; the first kCounterexamples always are.
void expect_counterexamples(Fields& fields, std::size_t count, std::uint64_t mismatches, std::size_t most) {
  const std::uint64_t least = std::min<std::uint64_t>(mismatches, kCounterexamples);
  fields.expect("counterexamples", count >= least && count <= std::min<std::uint64_t>(mismatches, most),
                mismatches == 0 ? "none, as there is no mismatch"
                                : "the first of " + std::to_string(mismatches) + " mismatches, " + std::to_string(least));
}

Comparison comparison_from(Fields& fields, const Build& build) {
  Comparison found;
  found.points = fields.count("points");
  fields.expect("points", found.points > 0, "1 or more");
  found.mismatches = fields.count("mismatches");
  fields.expect("mismatches", found.mismatches <= found.points, "no more than there are points");
  found.points_by_instruction_set = sets_from(fields, found.points, build);
  found.points_by_aim = breakdown(fields, "points_by_aim", kAimNames, found.points);
  found.points_by_stage = breakdown(fields, "points_by_stage", kStageNames, found.points);
  found.points_by_method = breakdown(fields, "points_by_method", kMethodNames, found.points);
  found.points_by_status = breakdown(fields, "points_by_status", kStatusNames, found.points);
  found.counterexamples = fields.texts("counterexamples");
  expect_counterexamples(fields, found.counterexamples.size(), found.mismatches, kCounterexamples);
  return found;
}

std::vector<PropertyResult> properties_from(Fields& entry) {
  std::vector<PropertyResult> all;
  for (Fields& fields : entry.objects("properties")) {
    PropertyResult one = property_from(fields);
    fields.expect("name", all.size() < kPropertyNames.size() && one.name == kPropertyNames[all.size()],
                  "each property once: " + one_of(kPropertyNames).substr(7));
    fields.expect("cases", one.cases > 0, "1 or more");
    fields.expect("counterexample", one.held == one.counterexample.empty(),
                  one.held ? "none, as the property held" : "one, as the property did not hold");
    fields.end();
    all.push_back(std::move(one));
  }
  entry.expect("properties", all.size() == kPropertyNames.size(), "all of " + one_of(kPropertyNames).substr(7));
  return all;
}

std::vector<LoopEnergy> energy_from(Fields& entry, bool conservative) {
  std::vector<LoopEnergy> all;
  for (Fields& fields : entry.objects("energy_per_loop")) {
    const LoopEnergy one = loop_from(fields);
    fields.expect("depth_mm", one.depth_mm > 0, "more than 0");
    fields.expect("bound_mJ", one.bound_mJ[1] >= 0 && (!conservative || one.bound_mJ[1] == 0),
                  conservative ? "[0, 0], as no loop of a conservative law gives energy" : "no bound below 0");
    fields.end();
    all.push_back(one);
  }
  return all;
}

ClosestCall closest_call_from(Fields fields) {
  const ClosestCall call = call_from(fields);
  fields.expect("ulps_from_tie", call.ulps_from_tie > 0 && call.ulps_from_tie <= 1, "more than 0 and at most 1");
  fields.end();
  return call;
}

Spread spread_from(Fields fields, const Build& build) {
  Spread spread{comparison_from(fields, build), fields.count("parameter_sets")};
  fields.expect("parameter_sets", spread.parameter_sets > 0 && spread.parameter_sets <= spread.points,
                "1 or more, and no more than there are points");
  fields.end();
  return spread;
}

Findings findings_from(Fields& fields, const Build& build) {
  Findings found{comparison_from(fields, build)};
  found.jumps = fields.texts("jumps");
  read_flag(fields, "continuous", found.jumps.empty());
  found.conservative = fields.flag("conservative");
  found.closest_call = closest_call_from(fields.object("closest_call"));
  found.spread = spread_from(fields.object("spread"), build);
  found.properties = properties_from(fields);
  found.energy = energy_from(fields, found.conservative);
  return found;
}

// A number that is a binary32, or a word.
IdentityValue value_from(Fields& fields, const std::string& key) {
  if (fields.any(key.c_str()).is_string()) return fields.text(key.c_str());
  return fields.binary32(key.c_str());
}

using IdentityParameters = decltype(Identity::parameters);

// The parameters of a kind that has no rules of its own here.
IdentityParameters any_parameters_from(Fields fields) {
  IdentityParameters parameters;
  for (const std::string& key : fields.keys()) parameters.emplace_back(key, value_from(fields, key));
  fields.end();
  return parameters;
}

IdentityParameters map_parameters_from(Fields fields) {
  const std::string word = fields.text("rendering");
  const auto is_it = [&](const height::ModeName& one) { return one.name == word; };
  if (std::none_of(height::kModes.begin(), height::kModes.end(), is_it)) throw Error("unknown rendering \"" + word + "\"");
  // The domain of a stiffness is the same for every law and map.
  const float stiffness = fields.binary32("stiffness_N_per_mm");
  const auto wall = fast::Law::build(LawId::wall, {.stiffness = stiffness});
  if (const auto* error = std::get_if<ParameterError>(&wall)) throw Error(error->message());
  fields.end();
  return {{"rendering", word}, {"stiffness_N_per_mm", stiffness}};
}

Identity identity_from(Fields& fields) {
  const std::string kind = fields.text("kind");
  if (kind == kLawKind) {
    const LawId law = law_id_from(fields, "name");
    return identity_of(law, parameters_from(law, fields.object("parameters")));
  }
  const bool is_map = kind == kHeightMapKind;
  Identity identity{kind, fields.text("name"), {}, is_map || fields.has("digest") ? digest_from(fields, "digest") : ""};
  identity.parameters =
      is_map ? map_parameters_from(fields.object("parameters")) : any_parameters_from(fields.object("parameters"));
  return identity;
}

// The version that wrote it decides how much is enough; a failure is decided by the rest of the certificate.
void expect_assessment(Fields& fields, Standing computed) {
  const std::string word = fields.text("standing"), lacks = fields.text("lacks");
  fields.expect("standing", std::find(kStandingNames.begin(), kStandingNames.end(), word) != kStandingNames.end(),
                one_of(kStandingNames));
  const bool failed = word == name_of(Standing::failed);
  fields.expect("standing", failed == (computed == Standing::failed),
                failed ? "another, as nothing in the certificate failed" : "failed, as the rest of the certificate says");
  fields.expect("lacks", lacks.empty() == (word != name_of(Standing::insufficient)),
                lacks.empty() ? "what is missing, in words" : "nothing, as the standing is " + word);
}

RenderedBy rendered_by_from(Fields& fields) {
  const std::string word = fields.text("renderer");
  const auto found = std::find(kRenderedByNames.begin(), kRenderedByNames.end(), word);
  fields.expect("renderer", found != kRenderedByNames.end(), one_of(kRenderedByNames));
  return static_cast<RenderedBy>(found - kRenderedByNames.begin());
}

// seeds: of all subjects in schema 6; else they are the subject's own.
SubjectResult subject_from(Fields& fields, std::uint64_t schema, const Build& build, const std::vector<std::uint64_t>& seeds) {
  SubjectResult result{{}, identity_from(fields)};
  if (schema > 7) result.rendered_by = rendered_by_from(fields);
  if (result.identity.kind == kHeightMapKind || fields.has("parts")) {
    result.parts = fields.texts("parts");
    fields.expect("parts", !result.parts.empty(), "at least one part");
  }
  static_cast<Findings&>(result) = findings_from(fields, build);
  result.unit_directions = fields.flag("unit");
  const bool may_be_unit = result.has_held("unit normals") && !is_conservative_map(result.identity);
  const bool must_be_unit = may_be_unit && (result.identity.kind == kLawKind || result.identity.kind == kHeightMapKind);
  fields.expect("unit", result.unit_directions ? may_be_unit : !must_be_unit, in_words(must_be_unit));
  read_flag(fields, "held", result.held());
  result.seeds = seeds;
  if (seeds.empty()) {
    result.seeds = fields.whole_numbers("seeds");
    const bool ascends =
        std::adjacent_find(result.seeds.begin(), result.seeds.end(), std::greater_equal<>()) == result.seeds.end();
    fields.expect("seeds", !result.seeds.empty() && ascends, "one seed or more, each above the one before");
    expect_assessment(fields, assessed(result).standing);
  }
  if (fields.has("subject_file")) result.subject_file = fields.text("subject_file", true);
  fields.end();
  return result;
}

SweepResult sweep_from(Fields& fields) {
  const LawId law = law_id_from(fields, "law");
  const Parameters parameters = parameters_from(law, fields.object("parameters"));
  const std::string word = fields.text("kind");
  const auto kind = std::find(kSweepKinds.begin(), kSweepKinds.end(), word);
  if (kind == kSweepKinds.end()) throw Error("unknown kind of sweep \"" + word + "\"");
  SweepResult result{{law, parameters, static_cast<SweepKind>(kind - kSweepKinds.begin()), fields.binary32("at_mm")},
                     fields.count("inputs"),
                     fields.count("mismatches")};
  constexpr std::uint64_t kInputs = kUnitsPerSweep << (kUnitBits + 1);
  fields.expect("inputs", result.inputs <= kInputs, "at most 2^32, which is every binary32");
  // On both sides of a surface, by the scalar call and two vector sets: six.
  fields.expect("mismatches", result.mismatches <= 6 * result.inputs, "no more than there are calls");
  fields.end();
  return result;
}

Sweeps sweeps_from(Fields fields) {
  Sweeps sweeps;
  for (Fields& row : fields.objects("sweeps")) sweeps.results.push_back(sweep_from(row));
  fields.expect("sweeps", !sweeps.results.empty(), "at least one sweep");
  Fields units = fields.object("units");
  sweeps.first = units.count("first");
  sweeps.end = units.count("end");
  sweeps.next = units.count("next");
  if (!(sweeps.first <= sweeps.next && sweeps.next <= sweeps.end && sweeps.end <= sweeps.units()) ||
      units.count("of") != sweeps.units())
    throw Error("units: expected first <= next <= end <= of = " + std::to_string(sweeps.units()) + ", got " +
                fields.any("units").dump());
  units.end();
  sweeps.seconds = fields.number("seconds");
  fields.expect("seconds", sweeps.seconds >= 0, "0 or more");
  Fields stages = fields.object("calls_by_stage");
  for (std::size_t i = 0; i < kStageNames.size(); ++i) sweeps.stages[i] = stages.count(kStageNames[i].data());
  stages.end();
  std::uint64_t calls = 0;  // on both sides of a surface
  for (const SweepResult& result : sweeps.results) calls += result.inputs * (result.sweep.kind == SweepKind::height ? 2 : 1);
  bool fits = true;
  for (const std::uint64_t stage : sweeps.stages) fits = fits && stage <= std::exchange(calls, calls - stage);
  fields.expect("calls_by_stage", fits && calls == 0, "counts that add up to the scalar calls: one an input, two on a surface");
  sweeps.counterexamples = fields.texts("counterexamples");
  const auto expect_total = [&](const char* key, std::uint64_t total) {
    fields.expect(key, fields.count(key) == total, std::to_string(total) + ", the sum of the sweeps'");
  };
  expect_total("inputs", sweeps.inputs());
  expect_total("mismatches", sweeps.mismatches());
  expect_counterexamples(fields, sweeps.counterexamples.size(), sweeps.mismatches(), SIZE_MAX);
  read_flag(fields, "finished", sweeps.is_finished());
  fields.end();
  return sweeps;
}

// 2026-01-31T23:59:59Z
std::string date_from(Fields& fields) {
  constexpr std::string_view kForm = "dddd-dd-ddTdd:dd:ddZ";
  std::string date = fields.text("date");
  bool fits = date.size() == kForm.size();
  for (std::size_t i = 0; fits && i < kForm.size(); ++i)
    fits = kForm[i] == 'd' ? date[i] >= '0' && date[i] <= '9' : date[i] == kForm[i];
  fields.expect("date", fits, "one like 2026-01-31T23:59:59Z");
  return date;
}

Certificate certificate_from(Fields fields) {
  const std::uint64_t schema = fields.count("schema");
  if (schema < kOldestCertificateSchema || schema > kCertificateSchema)
    throw Error("schema is " + std::to_string(schema) + "; expected " + std::to_string(kOldestCertificateSchema) + " to " +
                std::to_string(kCertificateSchema) + ": certify again");
  for (const auto& [key, words] : {std::pair{"statement", kStatement}, {"method", kMethod}}) {
    const std::string text = fields.text(key);
    fields.expect(key, text == words, "the words of schema " + std::to_string(schema));
  }
  const auto domain = nlohmann::json::parse(kDomain);
  fields.expect("domain", fields.any("domain") == domain, domain.dump());
  Certificate certificate{build_from(fields.object("build")), fields.number("seconds"), {}, {}};
  fields.expect("seconds", certificate.seconds >= 0, "0 or more");
  certificate.date = date_from(fields);
  certificate.processor = fields.text("processor");
  // Schema 6 has one seed for all.
  std::vector<std::uint64_t> seeds;
  if (schema == 6) seeds.push_back(fields.count("seed"));
  for (Fields& subject : fields.objects("subjects"))
    certificate.subjects.push_back(subject_from(subject, schema, certificate.build, seeds));
  if (fields.has("exhaustive")) certificate.sweeps = sweeps_from(fields.object("exhaustive"));
  read_flag(fields, "held", certificate.held());
  if (schema > 6) expect_assessment(fields, assessed(certificate).standing);
  fields.end();
  return certificate;
}

}  // namespace

Certificate from_json(const std::string& text, const std::string& file) {
  try {
    const nlohmann::json json = json_from(text);
    return certificate_from({json, ""});
  } catch (const Error& error) {
    throw Error(file + ": expected a forceshade certificate (schema " + std::to_string(kOldestCertificateSchema) + " to " +
                std::to_string(kCertificateSchema) + "): " + error.what());
  }
}

std::string read_certificate(const std::string& file) {
  try {
    return text_of_json_file(file, "a certificate");
  } catch (const Error& error) {
    throw Error(file + ": " + error.what());
  }
}

}  // namespace forceshade::properties
