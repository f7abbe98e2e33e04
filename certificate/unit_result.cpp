// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/unit_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certificate/json_fields.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;

Json tally_json(const Tally& tally) {
  Json counterexamples = Json::array();
  for (const auto& [part, words] : tally.counterexamples) counterexamples.push_back({{"part", part}, {"words", words}});
  const ClosestCall& call = tally.closest_call;
  return {{"points", tally.points},
          {"mismatches", tally.mismatches},
          {"aims", tally.aims},
          {"stages", tally.stages},
          {"methods", tally.methods},
          {"statuses", tally.statuses},
          {"sets", tally.sets},
          {"closest_call",
           {{"x_mm", static_cast<double>(call.x)},
            {"y_mm", static_cast<double>(call.y)},
            {"z_mm", static_cast<double>(call.z)},
            {"ulps_from_tie", call.ulps_from_tie}}},
          {"counterexamples", counterexamples}};
}

Json found_json(ItemKind kind, const Found& found) {
  if (kind == ItemKind::properties) {
    Json list = Json::array();
    for (const PropertyResult& p : found.properties)
      list.push_back({{"name", p.name}, {"cases", p.cases}, {"held", p.held}, {"counterexample", p.counterexample}});
    return list;
  }
  if (kind != ItemKind::energies) return tally_json(found.tally);
  Json loops = Json::array();
  for (const LoopEnergy& e : found.energies.loops) {
    if (!std::isfinite(e.depth_mm + e.bound_mJ[0] + e.bound_mJ[1] + e.witness_mJ + e.measured_mJ))
      throw Error("no result can be written: an energy per loop is no finite number");
    loops.push_back(
        {{"depth_mm", e.depth_mm}, {"bound_mJ", e.bound_mJ}, {"witness_mJ", e.witness_mJ}, {"measured_mJ", e.measured_mJ}});
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
  tally.closest_call = {call.binary32("x_mm"), call.binary32("y_mm"), call.binary32("z_mm"), call.number("ulps_from_tie")};
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
      found.properties.push_back({one.text("name"), one.count("cases"), one.flag("held"), one.text("counterexample", true)});
      one.end();
    }
  } else if (kind == ItemKind::energies) {
    Fields fields = outer.object("found");
    found.energies.fault = fields.text("fault", true);
    for (Fields& one : fields.objects("loops")) {
      found.energies.loops.push_back(
          {one.number("depth_mm"), one.interval("bound_mJ"), one.number("witness_mJ"), one.number("measured_mJ")});
      one.end();
    }
    fields.end();
  } else {
    found.tally = tally_from(outer.object("found"));
  }
  return found;
}

}  // namespace

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
