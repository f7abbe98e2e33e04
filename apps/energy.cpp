// SPDX-License-Identifier: BSD-3-Clause
// forceshade energy: whether a law or a height map is passive: its potential, or the most energy that a loop can give to the
// hand, and a loop that gives it.

#include "forceshade/reference/energy.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/apps/length.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/output_options.h"
#include "forceshade/apps/progress_line.h"
#include "forceshade/apps/signals.h"
#include "forceshade/reference/height_energy.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;
using reference::binary64;

struct EnergyOptions {
  std::string depth, json, along = "x", at = "0", from = "-12.7mm", to = "12.7mm";
};

struct Verdict {
  const reference::Law& law;
  float depth;
  std::optional<std::string> potential = reference::potential(law);
  reference::LoopBound bound = reference::loop_bound(law, depth);
  std::vector<reference::PathPoint> witness = reference::witness(law, depth);
  double witness_mJ = binary64(reference::work(law, witness))[0];
  double most_mJ = binary64(bound.anywhere)[1];
};

// A bound of which the witness gives less is not known to be met by any loop.
constexpr double kMet = 0.99;

template <class V>
void add_witness(Json& json, const V& verdict) {
  json["witness_mJ"] = verdict.witness_mJ;
  if (verdict.most_mJ == 0) return;
  json["witness_share_of_bound"] = verdict.witness_mJ / verdict.most_mJ;
  json["bound_is_met"] = verdict.witness_mJ >= kMet * verdict.most_mJ;
}

template <class V>
void print_witness(const V& verdict) {
  if (!verdict.witness.empty())
    std::printf("witness: %zu corners, gives %.6g mJ, %.2f %% of the bound; --json lists them\n", verdict.witness.size() - 1,
                verdict.witness_mJ, 100 * verdict.witness_mJ / verdict.most_mJ);
  if (verdict.witness_mJ < kMet * verdict.most_mJ)
    std::printf(
        "the bound is not met: no loop was found that gives %g %% of it to the hand; the most that a loop can give lies "
        "between "
        "%.6g and %.6g mJ\n",
        100 * kMet, verdict.witness_mJ, verdict.most_mJ);
}

Json json_of(const Verdict& verdict) {
  const Parameters& p = verdict.law.parameters();
  Json parameters;
  if (has_bump_geometry(verdict.law.id()))
    parameters = {{"radius_mm", static_cast<double>(p.radius)}, {"width_mm", static_cast<double>(p.width)}};
  parameters["stiffness_N_per_mm"] = static_cast<double>(p.stiffness);
  Json json{{"law", name_of(verdict.law.id())},
            {"parameters", parameters},
            {"depth_mm", static_cast<double>(verdict.depth)},
            {"conservative", verdict.potential.has_value()}};
  if (verdict.potential) json["potential"] = *verdict.potential;
  json["bound_mJ"] = binary64(verdict.bound.anywhere);
  json["right_half_mJ"] = {{"counter_clockwise", binary64(verdict.bound.counter_clockwise)},
                           {"clockwise", binary64(verdict.bound.clockwise)}};
  add_witness(json, verdict);
  json["witness"] = Json::array();
  for (const auto& [x, z] : verdict.witness) json["witness"].push_back({static_cast<double>(x), static_cast<double>(z)});
  return json;
}

void print(const Verdict& verdict) {
  const char* name = name_of(verdict.law.id()).data();
  if (verdict.potential) {
    std::printf("%s: conservative: no loop gives energy to the hand; the force is minus the gradient of %s\n", name,
                verdict.potential->c_str());
    return;
  }
  std::printf("%s: active: a simple loop no deeper than %g mm gives the hand up to %.6g mJ\n", name,
              static_cast<double>(verdict.depth), verdict.most_mJ);
  std::printf("on the half x >= 0 alone: %.6g mJ counter-clockwise, %.6g mJ clockwise (x right, z up)\n",
              binary64(verdict.bound.counter_clockwise)[1], binary64(verdict.bound.clockwise)[1]);
  print_witness(verdict);
}

struct HeightVerdict {
  std::string name;
  const reference::HeightMapField& law;
  reference::Slice slice;
  float depth;
  std::optional<std::string> potential;
  reference::SliceBound bound;
  std::vector<Eigen::Vector3f> witness;
  double witness_mJ, most_mJ;
};

HeightVerdict verdict_on(const reference::HeightMapField& law, const std::string& name, const reference::Slice& slice,
                         float depth) {
  ProgressLine line(name);
  const reference::Watch watch([&](double done) { line.draw(done); }, interrupted());
  const auto bound = reference::loop_bound(law, slice, depth, watch.part(0, 0.4));
  const auto witness = reference::witness(law, slice, depth, watch.part(0.4, 0.7));
  const double witness_mJ = binary64(reference::work(law, witness, watch.part(0.7, 1)))[0];
  return {name, law, slice, depth, reference::potential(law), bound, witness, witness_mJ, binary64(bound.most())[1]};
}

Json json_of(const HeightVerdict& verdict) {
  const auto& [along, at, from, to] = verdict.slice;
  Json json{{"height_map", verdict.name},
            {"rendering", name_of(verdict.law.rendering())},
            {"parameters", {{"stiffness_N_per_mm", static_cast<double>(verdict.law.stiffness())}}},
            {"slice",
             {{"along", along == reference::Slice::Along::x ? "x" : "y"},
              {"at_mm", static_cast<double>(at)},
              {"from_mm", static_cast<double>(from)},
              {"to_mm", static_cast<double>(to)}}},
            {"depth_mm", static_cast<double>(verdict.depth)},
            {"conservative", verdict.potential.has_value()}};
  if (verdict.potential) json["potential"] = *verdict.potential;
  json["bound_mJ"] = binary64(verdict.bound.most());
  json["counter_clockwise_mJ"] = binary64(verdict.bound.counter_clockwise);
  json["clockwise_mJ"] = binary64(verdict.bound.clockwise);
  add_witness(json, verdict);
  json["witness"] = Json::array();
  for (const Eigen::Vector3f& corner : verdict.witness)
    json["witness"].push_back(
        {static_cast<double>(corner.x()), static_cast<double>(corner.y()), static_cast<double>(corner.z())});
  return json;
}

void print(const HeightVerdict& verdict) {
  const char *name = verdict.name.c_str(), *rendering = name_of(verdict.law.rendering()).data();
  if (verdict.potential) {
    std::printf("%s, %s: conservative: no loop gives energy to the hand; the force is minus the gradient of %s\n", name,
                rendering, verdict.potential->c_str());
    return;
  }
  const auto& [along, at, from, to] = verdict.slice;
  const bool is_x = along == reference::Slice::Along::x;
  std::printf(
      "%s, %s: %s: over %s = %g mm, %s from %g to %g mm, a simple loop no deeper than %g mm gives the hand up to %.6g mJ\n",
      name, rendering, verdict.most_mJ > 0 ? "active" : "gives no energy", is_x ? "y" : "x", static_cast<double>(at),
      is_x ? "x" : "y", static_cast<double>(from), static_cast<double>(to), static_cast<double>(verdict.depth),
      verdict.most_mJ);
  if (verdict.most_mJ == 0) return;
  std::printf("%.6g mJ counter-clockwise, %.6g mJ clockwise (%s right, z up)\n", binary64(verdict.bound.counter_clockwise)[1],
              binary64(verdict.bound.clockwise)[1], is_x ? "x" : "y");
  print_witness(verdict);
}

template <class V>
void answer(const V& verdict, const EnergyOptions& options) {
  if (!options.json.empty()) write_file(options.json, json_of(verdict).dump() + "\n");
  if (options.json != "-") print(verdict);
}

void run_law(const EnergyOptions& options, const LawOptions& law_options, float depth) {
  const auto law = std::get<reference::Law>(reference::Law::build(law_options.law(), law_options.parameters()));
  if (const auto error = reference::depth_error(law, depth)) throw BadInput("--" + error->message());
  answer(Verdict{law, depth}, options);
}

int run_height_map(const EnergyOptions& options, const LawOptions& law_options, const HeightMapOption& height_map,
                   float depth) {
  const float stiffness = law_options.stiffness();
  const heights::Spec spec = height_map.read(stiffness);
  const auto law = std::get<reference::HeightMapField>(reference::HeightMapField::build(spec.map, spec.rendering, stiffness));
  const reference::Slice slice{options.along == "x" ? reference::Slice::Along::x : reference::Slice::Along::y,
                               parse_length("--at", options.at), parse_length("--from", options.from),
                               parse_length("--to", options.to)};
  const std::string name = height_map.name();
  if (const auto error = reference::slice_error(law, slice, depth)) throw BadInput(name + ": " + error->message());
  watch_for_interrupt();
  try {
    answer(verdict_on(law, name, slice, depth), options);
    return kHeld;
  } catch (const reference::Interrupted&) {
    throw Interrupted(name + " has no verdict, and nothing was written");
  } catch (const reference::NotEnclosed& error) {
    std::fprintf(stderr, "forceshade: %s: no verdict: %s\n", name.c_str(), error.what());
    return kFailed;
  }
}

}  // namespace

void add_energy(CLI::App& app, int& result) {
  const auto options = std::make_shared<EnergyOptions>();
  CLI::App* command =
      app.add_subcommand("energy", "Whether a law or a height map is passive, and the most energy a loop can draw from it");
  const auto law_options = std::make_shared<LawOptions>(*command, LawOptions::Laws::one);
  const auto height_map = std::make_shared<HeightMapOption>(*command, *law_options);
  add_length(*command, "--depth", options->depth, "of the loops, below the nominal surface")->required();
  add_json(*command, options->json, "the verdict, with the loop,");
  CLI::Option* map_option = command->get_option("--height-map");
  const auto add = [&](const char* name, std::string& value, const char* help) {
    add_length(*command, name, value, help)->needs(map_option);
  };
  add_word(*command, "--along", options->along, "of a height map, the axis that its loops lie along", {"x", "y"})
      ->needs(map_option);
  add("--at", options->at, "where on the other axis");
  add("--from", options->from, "where the loops may begin");
  add("--to", options->to, "and where they end");
  command->callback([options, law_options, height_map, &result] {
    const float depth = parse_length("--depth", options->depth);
    if (height_map->is_given())
      result = run_height_map(*options, *law_options, *height_map, depth);
    else
      run_law(*options, *law_options, depth);
  });
}

}  // namespace forceshade::apps
