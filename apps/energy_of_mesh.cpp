// SPDX-License-Identifier: BSD-3-Clause
#include "apps/energy_of_mesh.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "properties/mesh_energy.h"
#include "properties/tick_changes.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;

void expect_length(const char* option, float value, float least, float most) {
  if (!(value >= least && value <= most)) throw Error(ParameterError{option, "mm", value, least, most}.message());
}

struct MeshVerdict {
  const std::string& name;
  const MeshRendering& rendering;
  double depth, length, step;  // mm
  properties::LargestTurns turns;
  properties::MeshStroke stroke;
  properties::TickChanges changes;

  properties::HandStep hand() const { return {.depth = depth, .step = step}; }
  // mJ/mm, of a turn.
  double rate_of(double turn) const { return static_cast<double>(rendering.stiffness) * depth * turn; }
  double most_rate() const { return rate_of(turns.most()); }
  double least_rate() const { return std::max(stroke.rate(), rate_of(turns.inside_at_least)); }
  double most_work() const { return most_rate() * length; }
  double rounds() const { return stroke.length > 0 ? std::floor(length / stroke.length) : 0; }
  double least_work() const { return rounds() * stroke.rate() * stroke.length; }
  double share() const { return stroke.rate() / most_rate(); }
  // The factors of that share: of the stroke's length and of the largest turn.
  double share_of_way() const { return stroke.along / stroke.length; }
  double share_of_turn() const { return share() / share_of_way(); }
};

Json json_of(const properties::MeshPosition& position) {
  return {static_cast<double>(position[0]), static_cast<double>(position[1]), static_cast<double>(position[2])};
}

Json json_of(const properties::Change& change) {
  return {{"bound", change.bound}, {"found", change.found}, {"at_mm", {json_of(change.at[0]), json_of(change.at[1])}}};
}

Json json_of(const MeshVerdict& verdict) {
  Json json{{"mesh", verdict.name},
            {"shading", name_of(verdict.rendering.shading)},
            {"parameters", {{"stiffness_N_per_mm", static_cast<double>(verdict.rendering.stiffness)}}},
            {"depth_mm", verdict.depth},
            {"length_mm", verdict.length},
            {"gives_energy", verdict.turns.most() > 0},
            {"largest_turns",
             {{"inside", verdict.turns.inside}, {"edges", verdict.turns.edges}, {"vertices", verdict.turns.vertices}}},
            {"rate_mJ_per_mm", {verdict.least_rate(), verdict.most_rate()}},
            {"bound_mJ", {verdict.least_work(), verdict.most_work()}},
            {"between_ticks",
             {{"step_mm", verdict.step},
              {"force_N", json_of(verdict.changes.force)},
              {"turn_degrees", json_of(verdict.changes.turn)},
              {"bounds_are_of_this_mesh", verdict.changes.is_own},
              {"moves_found", verdict.changes.moves}}}};
  if (verdict.turns.most() == 0) return json;
  json["witness"] = Json::array();
  for (const properties::MeshPosition& corner : verdict.stroke.corners) json["witness"].push_back(json_of(corner));
  if (verdict.stroke.corners.empty()) return json;
  json["witness_triangle"] = verdict.stroke.triangle;
  json["witness_length_mm"] = verdict.stroke.length;
  json["witness_ticks"] = verdict.stroke.ticks;
  json["witness_mJ"] = verdict.stroke.work;
  json["witness_sampling_mJ"] = verdict.stroke.sampling;
  json["witness_share_of_rate"] = verdict.share();
  json["witness_share_of_way"] = verdict.share_of_way();
  json["witness_share_of_turn"] = verdict.share_of_turn();
  return json;
}

void print_energy(const MeshVerdict& verdict) {
  const char* name = verdict.name.c_str();
  if (verdict.turns.most() == 0) {
    std::printf("%s: without shading no closed path gives energy to the hand, but for the length of its steps\n", name);
    return;
  }
  std::printf("%s: the shading gives at most %.6g mJ for each mm of path no deeper than %g mm, and somewhere at least %.6g\n",
              name, verdict.most_rate(), verdict.depth, verdict.least_rate());
  std::printf("largest turns, as chords: %.6g inside triangles, %.6g on edges, %.6g at vertices\n", verdict.turns.inside,
              verdict.turns.edges, verdict.turns.vertices);
  std::printf("a closed path of %g mm gives at most %.6g mJ beside what its steps give\n", verdict.length, verdict.most_work());
  if (verdict.stroke.corners.empty()) {
    std::printf("no witness: no stroke no longer than %g mm was found that gives energy\n", verdict.length);
    return;
  }
  std::printf(
      "witness: a stroke of %.6g mm in triangle %u gives %.6g mJ in %zu ticks, of which their length gives at most %.3g mJ\n",
      verdict.stroke.length, verdict.stroke.triangle, verdict.stroke.work, verdict.stroke.ticks, verdict.stroke.sampling);
  std::printf("that is %.6g mJ/mm, and %g times, within %g mm, %.6g mJ; --json lists its corners\n", verdict.stroke.rate(),
              verdict.rounds(), verdict.length, verdict.least_work());
  std::printf(
      "it is %.3g %% of the bound: %.3g %% of the stroke is along the surface, at %.3g %% of the largest turn in the mean\n",
      100 * verdict.share(), 100 * verdict.share_of_way(), 100 * verdict.share_of_turn());
}

void print(const MeshVerdict& verdict) {
  print_energy(verdict);
  std::printf("%s\n", words_of(verdict.changes, verdict.hand()).c_str());
  if (!verdict.changes.is_own)
    std::printf("the mesh %s: these bounds between ticks are of any mesh\n",
                verdict.rendering.checked.is_regular() ? "has too many triangles for its own" : "is not regular");
}

}  // namespace

int print_energy_of_mesh(const std::string& name, const MeshRendering& rendering, float depth, float length, float step,
                         const std::string& json) {
  if (const std::string why = properties::why_no_energy_bound(rendering); !why.empty()) throw Error(name + ": " + why);
  expect_length("--depth", depth, 0x1p-10F, 100);
  expect_length("--length", length, 0x1p-10F, 10000);
  expect_length("--step", step, 0x1p-10F, 100);
  watch_for_interrupt();
  const auto judged = [&](const Monitor& monitor) {
    MeshVerdict verdict{.name = name,
                        .rendering = rendering,
                        .depth = static_cast<double>(depth),
                        .length = static_cast<double>(length),
                        .step = static_cast<double>(step),
                        .turns = properties::largest_turns(rendering),
                        .stroke = {},
                        .changes = {}};
    verdict.changes = properties::tick_changes(rendering, verdict.hand(), monitor.part(0, 0.5));
    if (verdict.turns.most() > 0)
      verdict.stroke = properties::best_stroke(rendering, verdict.turns, verdict.depth, verdict.length, monitor.part(0.5, 1));
    return verdict;
  };
  try {
    const MeshVerdict verdict = with_progress(name, judged);
    write_json(json, json_of(verdict), -1);
    if (json != "-") print(verdict);
    return kHeld;
  } catch (const Interrupted&) {
    throw Interrupted(name + " has no verdict, and nothing was written");
  }
}

}  // namespace forceshade::apps
