// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/plan.h"

#include <algorithm>
#include <cmath>

#include "certificate/build_json.h"
#include "certificate/findings_json.h"
#include "certificate/json_fields.h"
#include "files/printable.h"
#include "rendering/identity/identity_json.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kPlanSchema = 1;

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = files::character_size(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

Json sweeps_json(const SweepPlan& plan) {
  Json laws = Json::array(), radii = Json::array();
  for (const LawId law : plan.laws) laws.push_back(name_of(law));
  for (const float radius : plan.radii) radii.push_back({{"radius_mm", static_cast<double>(radius)}});
  const Parameters& p = plan.parameters;
  return {{"laws", laws},
          {"radius_mm", static_cast<double>(p.radius)},
          {"width_mm", static_cast<double>(p.width)},
          {"stiffness_N_per_mm", static_cast<double>(p.stiffness)},
          {"radii", radii},
          {"directions", plan.directions},
          {"heights", plan.heights},
          {"lines", plan.lines}};
}

SweepPlan sweeps_from(Fields fields) {
  SweepPlan plan{{}, {}, {}};
  for (const std::string& name : fields.texts("laws")) {
    const auto law = law_named(name);
    if (!law) throw Error("unknown law \"" + name + "\"");
    plan.laws.push_back(*law);
  }
  plan.parameters = {fields.binary32("radius_mm"), fields.binary32("width_mm"), fields.binary32("stiffness_N_per_mm")};
  for (Fields& radius : fields.objects("radii")) plan.radii.push_back(radius.binary32("radius_mm"));
  fields.expect("radii", !plan.radii.empty(), "one radius or more");
  plan.directions = fields.flag("directions");
  plan.heights = fields.flag("heights");
  plan.lines = fields.flag("lines");
  fields.end();
  return plan;
}

void read_points(Fields& fields, Plan& plan) {
  for (Fields& option : fields.objects("subject")) {
    plan.subject.emplace_back(option.text("key"), option.text("value"));
    option.end();
  }
  fields.expect("subject", !plan.subject.empty(), "the options of a subject");
  plan.identities = fields.texts("identities");
  plan.points = fields.count("points");
  plan.cases = fields.count("cases");
  plan.seed = fields.count("seed");
  fields.expect("points", plan.points > 0, "1 or more");
  fields.expect("cases", plan.cases > 0 && plan.cases <= 1000000000, "a number from 1 to 1000000000");
}

Json tally_json(const Tally& tally) {
  Json counterexamples = Json::array();
  for (const auto& [part, words] : tally.counterexamples) counterexamples.push_back({{"part", part}, {"words", words}});
  return {{"points", tally.points},
          {"mismatches", tally.mismatches},
          {"aims", tally.aims},
          {"stages", tally.stages},
          {"methods", tally.methods},
          {"statuses", tally.statuses},
          {"sets", tally.sets},
          {"closest_call", json_of(tally.closest_call)},
          {"counterexamples", counterexamples}};
}

Json found_json(ItemKind kind, const Found& found) {
  if (kind == ItemKind::properties) {
    Json list = Json::array();
    for (const PropertyResult& p : found.properties) list.push_back(json_of(p));
    return list;
  }
  if (kind != ItemKind::energies) return tally_json(found.tally);
  Json loops = Json::array();
  for (const LoopEnergy& e : found.energies.loops) {
    if (!std::isfinite(e.depth_mm + e.bound_mJ[0] + e.bound_mJ[1] + e.witness_mJ + e.measured_mJ))
      throw Error("no result can be written: an energy per loop is no finite number");
    loops.push_back(json_of(e));
  }
  return {{"fault", found.energies.fault}, {"loops", loops}};
}

template <std::size_t kCount>
void read(Fields& fields, const char* key, std::array<std::uint64_t, kCount>& counts) {
  const std::vector<std::uint64_t> all = fields.whole_numbers(key);
  fields.expect(key, all.size() == kCount, std::to_string(kCount) + " counts");
  std::copy(all.begin(), all.end(), counts.begin());
}

Tally tally_from(Fields fields) {
  Tally tally;
  tally.points = fields.count("points");
  tally.mismatches = fields.count("mismatches");
  read(fields, "aims", tally.aims);
  read(fields, "stages", tally.stages);
  read(fields, "methods", tally.methods);
  read(fields, "statuses", tally.statuses);
  read(fields, "sets", tally.sets);
  Fields call = fields.object("closest_call");
  tally.closest_call = call_from(call);
  call.end();
  for (Fields& one : fields.objects("counterexamples")) {
    tally.counterexamples.emplace_back(one.count("part"), one.text("words", true));
    one.end();
  }
  fields.end();
  return tally;
}

Found found_from(ItemKind kind, Fields& outer) {
  Found found;
  if (kind == ItemKind::properties) {
    for (Fields& one : outer.objects("found")) {
      found.properties.push_back(property_from(one));
      one.end();
    }
  } else if (kind == ItemKind::energies) {
    Fields fields = outer.object("found");
    found.energies.fault = fields.text("fault", true);
    for (Fields& one : fields.objects("loops")) {
      found.energies.loops.push_back(loop_from(one));
      one.end();
    }
    fields.end();
  } else {
    found.tally = tally_from(outer.object("found"));
  }
  return found;
}

}  // namespace

std::string to_json(const Plan& plan) {
  Json json{{"schema", kPlanSchema},
            {"build", build_json(plan.build)},
            {"parts_of_a_unit", plan.parts_of_a_unit},
            {"lease_s", plan.lease}};
  if (plan.has_sweeps()) {
    json["sweeps"] = sweeps_json(plan.sweeps);
  } else {
    Json subject = Json::array();
    for (const auto& [key, value] : plan.subject) {
      if (!is_utf8(value))
        throw Error("--" + key + ": expected a name in UTF-8, as a plan's file is, got " + files::shown(value));
      subject.push_back({{"key", key}, {"value", value}});
    }
    json.update({{"subject", subject},
                 {"identities", plan.identities},
                 {"points", plan.points},
                 {"cases", plan.cases},
                 {"seed", plan.seed}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Plan plan_from_json(const std::string& text, const std::string& file) {
  try {
    const nlohmann::json json = json_from(text);
    Fields fields(json, "");
    Plan plan;
    fields.expect("schema", fields.count("schema") == kPlanSchema, std::to_string(kPlanSchema));
    plan.build = build_from(fields.object("build"));
    plan.parts_of_a_unit = fields.count("parts_of_a_unit");
    fields.expect("parts_of_a_unit", plan.parts_of_a_unit > 0, "1 or more");
    plan.lease = fields.count("lease_s");
    fields.expect("lease_s", plan.lease > 0, "1 or more");
    if (fields.has("sweeps"))
      plan.sweeps = sweeps_from(fields.object("sweeps"));
    else
      read_points(fields, plan);
    fields.end();
    return plan;
  } catch (const Error& error) {
    throw Error(file + ": expected a plan of forceshade certify (schema " + std::to_string(kPlanSchema) + "): " + error.what());
  }
}

std::string identity_line(const Identity& identity) {
  return identity.kind + ' ' + identity.name + ' ' + identity.digest + ' ' +
         parameters_json(identity).dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string refusal_of_build(const Plan& plan, const Build& build) {
  const auto differs = [](const std::string& what, const std::string& expected, const std::string& got) {
    return "the plan is for another " + what + ": expected " + expected + ", got " + got;
  };
  const Build& its = plan.build;
  if (its.instruction_set != build.instruction_set)
    return differs("instruction set", its.instruction_set, build.instruction_set) +
           "; let machines work on it that have this widest set";
  if (its.library_digest != build.library_digest)
    return differs("build of the library", "digest " + its.library_digest, build.library_digest);
  if (its.compiler != build.compiler) return differs("compiler", its.compiler, build.compiler);
  if (its.flags != build.flags) return differs("set of compiler flags", its.flags, build.flags);
  if (its.revision != build.revision) return differs("revision", its.revision, build.revision);
  if (its.version != build.version) return differs("version", its.version, build.version);
  return "";
}

std::uint64_t parts_for_units(const std::vector<Item>& items, std::uint64_t units) {
  std::uint64_t parts = 0;
  for (const Item& item : items) parts += item.parts;
  return std::max<std::uint64_t>(1, (parts + units - 1) / units);
}

std::string text_of_unit(const std::string& plan, std::uint64_t number, const Units& units, const Found& found) {
  const Unit unit = units.at(number);
  const Item& item = units.items()[unit.item];
  const Json json{{"plan", plan},
                  {"unit", number},
                  {"kind", kItemKinds[static_cast<std::size_t>(item.kind)]},
                  {"of", item.of},
                  {"first", unit.first},
                  {"end", unit.end},
                  {"found", found_json(item.kind, found)}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Found unit_from_text(const std::string& text, const std::string& plan, std::uint64_t number, const Units& units,
                     const std::string& file) {
  const Unit unit = units.at(number);
  const Item& item = units.items()[unit.item];
  try {
    const nlohmann::json json = json_from(text);
    Fields fields(json, "");
    fields.expect("plan", fields.text("plan") == plan, "the digest of the plan, " + plan);
    const auto expect = [&](const char* key, std::uint64_t value) {
      fields.expect(key, fields.count(key) == value, std::to_string(value));
    };
    expect("unit", number);
    const std::string kind(kItemKinds[static_cast<std::size_t>(item.kind)]);
    fields.expect("kind", fields.text("kind") == kind, kind);
    expect("of", item.of);
    expect("first", unit.first);
    expect("end", unit.end);
    Found found = found_from(item.kind, fields);
    fields.end();
    return found;
  } catch (const Error& error) {
    throw Error(file + ": expected the result of a unit of this plan: " + error.what());
  }
}

}  // namespace forceshade::properties
