// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/certificate.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStatement =
    "At every point checked, each component of the fast path's force is the exact force rounded to binary32, nearest, ties to "
    "even; and the four properties held on every case.";
constexpr const char* kMethod =
    "Each answer is compared, bit for bit, with the rounded reference: a 64-bit enclosure where it decides, MPFI intervals of "
    "growing precision where it does not, CGAL's exact algebraic numbers for facets and rounding ties. Half of the points are "
    "aimed at surface neighbours, facet lines (of a height map: cell lines, edges and rims), the position quantum, domain "
    "ends, near-ties, the axis (centres, apexes and crests) and few-bit numbers. Every instruction set of the machine gave "
    "the same bits.";

Json domain() {
  return {{"radius_mm", {0.1, 1e4}},
          {"width_mm", {1e-3, "2 radius"}},
          {"stiffness_N_per_mm", {1e-3, 1e3}},
          {"position_mm", {-1e4, 1e4}},
          {"position_quantum_mm", "2^-30"}};
}

// binary32 numbers are written as the binary64 numbers they are, so they come back the same.
Json parameters_json(LawId law, const Parameters& p) {
  Json json;
  if (has_bump_geometry(law)) json = {{"radius_mm", static_cast<double>(p.radius)}, {"width_mm", static_cast<double>(p.width)}};
  json["stiffness_N_per_mm"] = static_cast<double>(p.stiffness);
  return json;
}

Parameters parameters_from(LawId law, const Json& json) {
  Parameters p;
  if (has_bump_geometry(law)) {
    p.radius = static_cast<float>(json.at("radius_mm").get<double>());
    p.width = static_cast<float>(json.at("width_mm").get<double>());
  }
  p.stiffness = static_cast<float>(json.at("stiffness_N_per_mm").get<double>());
  return p;
}

// After what names the law or the map.
void add_findings(Json& json, const Findings& law, bool is_unit) {
  Json properties = Json::array();
  for (const PropertyResult& p : law.properties)
    properties.push_back({{"name", p.name}, {"cases", p.cases}, {"held", p.held}, {"counterexample", p.counterexample}});
  Json energy = Json::array();
  for (const LoopEnergy& e : law.energy)
    energy.push_back(
        {{"depth_mm", e.depth_mm}, {"bound_mJ", e.bound_mJ}, {"witness_mJ", e.witness_mJ}, {"measured_mJ", e.measured_mJ}});
  json.update({{"continuous", law.jumps.empty()},
               {"jumps", law.jumps},
               {"unit", is_unit},
               {"conservative", law.conservative},
               {"points", law.points},
               {"undecided", law.undecided},
               {"mismatches", law.mismatches},
               {"points_by_aim", law.points_by_aim},
               {"points_by_stage", law.points_by_stage},
               {"points_by_method", law.points_by_method},
               {"points_by_status", law.points_by_status},
               {"closest_call",
                {{"x_mm", static_cast<double>(law.closest_call.x)},
                 {"y_mm", static_cast<double>(law.closest_call.y)},
                 {"z_mm", static_cast<double>(law.closest_call.z)},
                 {"ulps_from_tie", law.closest_call.ulps_from_tie}}},
               {"counterexamples", law.counterexamples},
               {"properties", properties},
               {"energy_per_loop", energy}});
}

Json law_json(const LawResult& law) {
  Json json{{"law", name_of(law.law)}, {"held", law.held()}, {"parameters", parameters_json(law.law, law.parameters)}};
  add_findings(json, law, law.is_unit());
  return json;
}

Json height_map_json(const HeightMapResult& map) {
  Json json{{"height_map", map.file},
            {"held", map.held()},
            {"map_digest", map.identity.map_digest},
            {"rendering", name_of(map.identity.rendering)},
            {"stiffness_N_per_mm", static_cast<double>(map.identity.stiffness)},
            {"parts", map.parts}};
  add_findings(json, map, map.is_unit());
  return json;
}

LawId id_from(const Json& json) {
  const std::string name = json.at("law");
  if (const auto id = law_named(name)) return *id;
  throw std::runtime_error("unknown law \"" + name + "\"");
}

Findings findings_from(const Json& json) {
  Findings law;
  law.jumps = json.at("jumps").get<std::vector<std::string>>();
  law.conservative = json.at("conservative");
  law.points = json.at("points");
  law.undecided = json.at("undecided");
  law.mismatches = json.at("mismatches");
  law.points_by_aim = json.at("points_by_aim");
  law.points_by_stage = json.at("points_by_stage");
  law.points_by_method = json.at("points_by_method");
  law.points_by_status = json.at("points_by_status");
  const Json& call = json.at("closest_call");
  law.closest_call = {static_cast<float>(call.at("x_mm").get<double>()), static_cast<float>(call.at("y_mm").get<double>()),
                      static_cast<float>(call.at("z_mm").get<double>()), call.at("ulps_from_tie")};
  law.counterexamples = json.at("counterexamples").get<std::vector<std::string>>();
  for (const Json& p : json.at("properties"))
    law.properties.push_back({p.at("name"), p.at("cases"), p.at("held"), p.at("counterexample")});
  for (const Json& e : json.at("energy_per_loop"))
    law.energy.push_back({e.at("depth_mm"), e.at("bound_mJ"), e.at("witness_mJ"), e.at("measured_mJ")});
  return law;
}

LawResult law_from(const Json& json) {
  const LawId id = id_from(json);
  return {findings_from(json), id, parameters_from(id, json.at("parameters"))};
}

HeightMapResult height_map_from(const Json& json) {
  const std::string word = json.at("rendering");
  const auto* rendering = std::find_if(height::kRenderings.begin(), height::kRenderings.end(),
                                       [&](const height::RenderingName& name) { return name.name == word; });
  if (rendering == height::kRenderings.end()) throw std::runtime_error("unknown rendering \"" + word + "\"");
  return {findings_from(json),
          json.at("height_map"),
          {json.at("map_digest"), rendering->rendering, static_cast<float>(json.at("stiffness_N_per_mm").get<double>())},
          json.at("parts").get<std::vector<std::string>>()};
}

Json sweeps_json(const Sweeps& sweeps) {
  Json list = Json::array();
  for (const SweepResult& result : sweeps.results)
    list.push_back({{"law", name_of(result.sweep.law)},
                    {"parameters", parameters_json(result.sweep.law, result.sweep.parameters)},
                    {"kind", kSweepKinds[static_cast<std::size_t>(result.sweep.kind)]},
                    {"at_mm", static_cast<double>(result.sweep.at)},
                    {"inputs", result.inputs},
                    {"mismatches", result.mismatches}});
  return {{"finished", sweeps.is_finished()},
          {"units", {{"first", sweeps.first}, {"end", sweeps.end}, {"next", sweeps.next}, {"of", sweeps.units()}}},
          {"seconds", sweeps.seconds},
          {"inputs", sweeps.inputs()},
          {"mismatches", sweeps.mismatches()},
          {"calls_by_stage", {{"binary64", sweeps.stages[0]}, {"double-double", sweeps.stages[1]}, {"wide", sweeps.stages[2]}}},
          {"counterexamples", sweeps.counterexamples},
          {"sweeps", list}};
}

Sweeps sweeps_from(const Json& json) {
  Sweeps sweeps;
  for (const Json& row : json.at("sweeps")) {
    const LawId law = id_from(row);
    const auto kind = std::find(kSweepKinds.begin(), kSweepKinds.end(), row.at("kind").get<std::string>());
    if (kind == kSweepKinds.end()) throw std::runtime_error("unknown kind of sweep " + row.at("kind").dump());
    sweeps.results.push_back(
        {{law, parameters_from(law, row.at("parameters")), static_cast<SweepKind>(kind - kSweepKinds.begin()),
          static_cast<float>(row.at("at_mm").get<double>())},
         row.at("inputs"),
         row.at("mismatches")});
  }
  const Json& units = json.at("units");
  sweeps.first = units.at("first");
  sweeps.end = units.at("end");
  sweeps.next = units.at("next");
  if (!(sweeps.first <= sweeps.next && sweeps.next <= sweeps.end && sweeps.end <= sweeps.units()) ||
      units.at("of") != sweeps.units())
    throw std::runtime_error("units: expected first <= next <= end <= of = " + std::to_string(sweeps.units()) + ", got " +
                             units.dump());
  sweeps.seconds = json.at("seconds");
  const Json& stages = json.at("calls_by_stage");
  sweeps.stages = {stages.at("binary64"), stages.at("double-double"), stages.at("wide")};
  sweeps.counterexamples = json.at("counterexamples").get<std::vector<std::string>>();
  return sweeps;
}

}  // namespace

bool Findings::has_held(std::string_view property) const {
  return std::any_of(properties.begin(), properties.end(),
                     [&](const PropertyResult& p) { return p.name == property && p.held; });
}

bool Findings::held() const {
  return points > 0 && mismatches == 0 &&
         std::all_of(kPropertyNames.begin(), kPropertyNames.end(),
                     [&](std::string_view property) { return has_held(property); });
}

bool Certificate::held() const {
  const bool is_empty = !has_points() && sweeps.results.empty();
  const bool swept = sweeps.results.empty() || (sweeps.is_whole() && sweeps.mismatches() == 0);
  bool all = true;
  for_each([&](const Findings& one) { all = all && one.held(); });
  return !is_empty && swept && all;
}

std::string to_json(const Certificate& certificate) {
  const Build& build = certificate.build;
  Json laws = Json::array();
  for (const LawResult& law : certificate.laws) laws.push_back(law_json(law));
  Json height_maps = Json::array();
  for (const HeightMapResult& map : certificate.height_maps) height_maps.push_back(height_map_json(map));
  Json json{{"schema", kCertificateSchema},
            {"held", certificate.held()},
            {"statement", kStatement},
            {"method", kMethod},
            {"domain", domain()},
            {"build",
             {{"version", build.version},
              {"revision", build.revision},
              {"compiler", build.compiler},
              {"flags", build.flags},
              {"instruction_set", build.instruction_set},
              {"library_digest", build.library_digest}}},
            {"seed", certificate.seed},
            {"seconds", certificate.seconds},
            {"laws", laws},
            {"height_maps", height_maps}};
  if (!certificate.sweeps.results.empty()) json["exhaustive"] = sweeps_json(certificate.sweeps);
  return json.dump(2) + "\n";
}

Certificate from_json(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    const int schema = json.at("schema");
    if (schema != kCertificateSchema)
      throw std::runtime_error("schema is " + std::to_string(schema) + "; expected " + std::to_string(kCertificateSchema) +
                               ": certify again");
    Certificate certificate;
    const Json& build = json.at("build");
    certificate.build = {build.at("version"), build.at("revision"),        build.at("compiler"),
                         build.at("flags"),   build.at("instruction_set"), build.at("library_digest")};
    certificate.seed = json.at("seed");
    certificate.seconds = json.at("seconds");
    for (const Json& law : json.at("laws")) certificate.laws.push_back(law_from(law));
    for (const Json& map : json.at("height_maps")) certificate.height_maps.push_back(height_map_from(map));
    if (json.contains("exhaustive")) certificate.sweeps = sweeps_from(json.at("exhaustive"));
    return certificate;
  } catch (const std::exception& error) {
    throw CertificateError(file + ": expected a forceshade certificate (schema " + std::to_string(kCertificateSchema) +
                           "): " + error.what());
  }
}

}  // namespace forceshade::properties
