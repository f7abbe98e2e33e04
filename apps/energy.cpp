// SPDX-License-Identifier: BSD-3-Clause
// forceshade energy: whether a law is passive: its potential, or the most a loop can be paid and a loop that is paid it.

#include "forceshade/reference/energy.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/apps/length.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;
using reference::binary64;

struct Verdict {
  const reference::Law& law;
  float depth;
  std::optional<std::string> potential = reference::potential(law);
  reference::LoopBound bound = reference::loop_bound(law, depth);
  std::vector<reference::PathPoint> witness = reference::witness(law, depth);
  double witness_mJ = binary64(reference::work(law, witness))[0];
};

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
  json["witness_mJ"] = verdict.witness_mJ;
  json["witness"] = Json::array();
  for (const auto& [x, z] : verdict.witness) json["witness"].push_back({static_cast<double>(x), static_cast<double>(z)});
  return json;
}

void print(const Verdict& verdict) {
  const char* name = name_of(verdict.law.id()).data();
  if (verdict.potential) {
    std::printf("%s: conservative: no loop is paid anything; the force is minus the gradient of %s\n", name,
                verdict.potential->c_str());
    return;
  }
  const double bound = binary64(verdict.bound.anywhere)[1];
  std::printf("%s: active: a simple loop no deeper than %g mm is paid up to %.6g mJ\n", name,
              static_cast<double>(verdict.depth), bound);
  std::printf("on the half x >= 0 alone: %.6g mJ counter-clockwise, %.6g mJ clockwise (x right, z up)\n",
              binary64(verdict.bound.counter_clockwise)[1], binary64(verdict.bound.clockwise)[1]);
  std::printf("witness: %zu corners, paid %.6g mJ, %.2f %% of the bound; --json - lists them\n", verdict.witness.size() - 1,
              verdict.witness_mJ, 100 * verdict.witness_mJ / bound);
}

}  // namespace

void add_energy(CLI::App& app, int&) {
  struct Options {
    std::string depth, json;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("energy", "Whether a law is passive, and the most energy a loop can draw from it");
  const auto law_options = std::make_shared<LawOptions>(*command, LawOptions::Laws::one, LawOptions::Defaults::thesis);
  command->add_option("--depth", options->depth, "of the loops, below the nominal surface: mm, or with a unit")
      ->type_name("VALUE")
      ->required();
  command->add_option("--json", options->json, "verdict for programs, - for standard output")->type_name("FILE");
  command->callback([options, law_options] {
    const auto law = std::get<reference::Law>(reference::Law::build(law_options->law(), law_options->parameters()));
    const float depth = parse_length("--depth", options->depth);
    if (const auto error = reference::depth_error(law, depth)) throw BadInput("--" + error->message());
    const Verdict verdict{law, depth};
    if (!options->json.empty()) write_file(options->json, json_of(verdict).dump() + "\n");
    if (options->json != "-") print(verdict);
  });
}

}  // namespace forceshade::apps
