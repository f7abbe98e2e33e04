// SPDX-License-Identifier: BSD-3-Clause
// forceshade energy: whether a law or a height map is passive: its potential, or the most energy that a loop can give to the
// hand, and a loop that gives it.

#include "reference/energy.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "forceshade/identity.h"
#include "properties/mesh_energy.h"
#include "reference/height_energy.h"
#include "text/formatted.h"
#include "text/number_text.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;
using reference::binary64;

struct EnergyOptions {
  std::string depth, json, length = "100mm";
  Section section;
  damping::Described damping;
};

// γ max(B, B_t), N·s/mm: the most that sampling gives for the sum of the squares of the steps over the period.
double sampled(const damping::Described& damping) {
  const damping::Parameters& its = damping.parameters;
  return damping::sampling_factor(static_cast<double>(its.share)) * static_cast<double>(its.larger());
}

// The verdict on a law or a height map. What differs between the two is in its JSON and its words.
struct Verdict {
  std::string name;
  Json of;            // the first members of the JSON: the law or map, its parameters, and where the loops lie
  std::string where;  // in words: empty, or "over …, "
  float depth;        // mm, of the loops
  std::optional<std::string> potential;
  std::array<double, 2> bound;  // mJ, enclosed
  Json senses;                  // the bounds of each sense, mJ, under their keys
  std::string senses_in_words;
  std::vector<std::vector<double>> witness;  // its corners, mm
  double witness_mJ;

  double most_mJ() const { return bound[1]; }
  // A bound of which the witness gives less is not known to be met by any loop.
  static constexpr double kMet = 0.99;
  bool is_met() const { return witness_mJ >= kMet * most_mJ(); }
};

// mJ of the loops in either sense, in words.
std::string words_of(const reference::Interval& counter_clockwise, const reference::Interval& clockwise, const char* right) {
  return formatted("%.6g mJ counter-clockwise, %.6g mJ clockwise (%s right, z up)", binary64(counter_clockwise)[1],
                   binary64(clockwise)[1], right);
}

Verdict verdict_on(const reference::Law& law, float depth) {
  const Parameters& p = law.parameters();
  Json parameters;
  if (has_bump_geometry(law.id()))
    parameters = {{"radius_mm", static_cast<double>(p.radius)}, {"width_mm", static_cast<double>(p.width)}};
  parameters["stiffness_N_per_mm"] = static_cast<double>(p.stiffness);
  const reference::LoopBound bound = reference::loop_bound(law, depth);
  const auto witness = reference::witness(law, depth);
  Verdict verdict{
      .name = std::string(name_of(law.id())),
      .of = {{"law", name_of(law.id())}, {"parameters", parameters}},
      .where = "",
      .depth = depth,
      .potential = reference::potential(law),
      .bound = binary64(bound.anywhere),
      .senses = {{"right_half_mJ",
                  {{"counter_clockwise", binary64(bound.counter_clockwise)}, {"clockwise", binary64(bound.clockwise)}}}},
      .senses_in_words = "on the half x >= 0 alone: " + words_of(bound.counter_clockwise, bound.clockwise, "x"),
      .witness = {},
      .witness_mJ = binary64(reference::work(law, witness))[0]};
  for (const auto& [x, z] : witness) verdict.witness.push_back({static_cast<double>(x), static_cast<double>(z)});
  return verdict;
}

Verdict verdict_on(const reference::HeightMapField& law, const std::string& name, const reference::Slice& slice, float depth,
                   const Monitor& monitor) {
  const reference::SliceBound bound = reference::loop_bound(law, slice, depth, monitor.part(0, 0.4));
  const auto witness = reference::witness(law, slice, depth, monitor.part(0.4, 0.7));
  const bool is_x = slice.along == reference::Slice::Along::x;
  const double at = static_cast<double>(slice.at), from = static_cast<double>(slice.from), to = static_cast<double>(slice.to);
  const std::string where =
      formatted("over %s = %g mm, %s from %g to %g mm, ", is_x ? "y" : "x", at, is_x ? "x" : "y", from, to);
  Verdict verdict{
      .name = name + ", " + std::string(name_of(law.mode())),
      .of = {{"height_map", name},
             {"rendering", name_of(law.mode())},
             {"parameters", {{"stiffness_N_per_mm", static_cast<double>(law.stiffness())}}},
             {"slice", {{"along", is_x ? "x" : "y"}, {"at_mm", at}, {"from_mm", from}, {"to_mm", to}}}},
      .where = where.data(),
      .depth = depth,
      .potential = reference::potential(law),
      .bound = binary64(bound.most()),
      .senses = {{"counter_clockwise_mJ", binary64(bound.counter_clockwise)}, {"clockwise_mJ", binary64(bound.clockwise)}},
      .senses_in_words = words_of(bound.counter_clockwise, bound.clockwise, is_x ? "x" : "y"),
      .witness = {},
      .witness_mJ = binary64(reference::work(law, witness, monitor.part(0.7, 1)))[0]};
  for (const Eigen::Vector3f& corner : witness)
    verdict.witness.push_back(
        {static_cast<double>(corner.x()), static_cast<double>(corner.y()), static_cast<double>(corner.z())});
  return verdict;
}

Json json_of(const Verdict& verdict) {
  Json json = verdict.of;
  json["depth_mm"] = static_cast<double>(verdict.depth);
  json["conservative"] = verdict.potential.has_value();
  if (verdict.potential) json["potential"] = *verdict.potential;
  json["bound_mJ"] = verdict.bound;
  json.update(verdict.senses);
  json["witness_mJ"] = verdict.witness_mJ;
  if (verdict.most_mJ() != 0) {
    json["witness_share_of_bound"] = verdict.witness_mJ / verdict.most_mJ();
    json["bound_is_met"] = verdict.is_met();
  }
  json["witness"] = verdict.witness;
  return json;
}

void print(const Verdict& verdict) {
  const char* name = verdict.name.c_str();
  if (verdict.potential) {
    std::printf("%s: conservative: no loop gives energy to the hand; the force is minus the gradient of %s\n", name,
                verdict.potential->c_str());
    return;
  }
  std::printf("%s: %s: %sa simple loop no deeper than %g mm gives the hand up to %.6g mJ\n", name,
              verdict.most_mJ() > 0 ? "active" : "gives no energy", verdict.where.c_str(), static_cast<double>(verdict.depth),
              verdict.most_mJ());
  if (verdict.most_mJ() == 0) return;
  std::printf("%s\n", verdict.senses_in_words.c_str());
  if (!verdict.witness.empty())
    std::printf("witness: %zu corners, gives %.6g mJ, %.2f %% of the bound; --json lists them\n", verdict.witness.size() - 1,
                verdict.witness_mJ, 100 * verdict.witness_mJ / verdict.most_mJ());
  if (!verdict.is_met())
    std::printf(
        "the bound is not met: no loop was found that gives %g %% of it to the hand; the most that a loop can give lies "
        "between %.6g and %.6g mJ\n",
        100 * Verdict::kMet, verdict.witness_mJ, verdict.most_mJ());
}

void answer(const Verdict& verdict, const EnergyOptions& options) {
  Json json = json_of(verdict);
  if (!options.damping.parameters.is_off()) json["damping_gives_at_most_N_s_per_mm"] = sampled(options.damping);
  write_json(options.json, json, -1);
  if (options.json != "-") print(verdict);
}

int run_law(const EnergyOptions& options, const DescribedLaw& described, float depth) {
  const auto law = std::get<reference::Law>(reference::Law::build(described.law, described.parameters));
  if (const auto error = reference::depth_error(law, depth)) throw Error("--" + error->message());
  answer(verdict_on(law, depth), options);
  return kHeld;
}

int run_height_map(const EnergyOptions& options, const std::string& name, const DescribedHeightMap& map, float depth) {
  const auto law = std::get<reference::HeightMapField>(reference::HeightMapField::build(map.map, map.mode, map.stiffness));
  const auto& [along, from, to, at] = options.section;
  const reference::Slice slice{along == 'x' ? reference::Slice::Along::x : reference::Slice::Along::y, at, from, to};
  if (const auto error = reference::slice_error(law, slice, depth)) throw Error(name + ": " + error->message());
  watch_for_interrupt();
  try {
    answer(with_progress(name, [&](const Monitor& monitor) { return verdict_on(law, name, slice, depth, monitor); }), options);
    return kHeld;
  } catch (const Interrupted&) {
    throw Interrupted(name + " has no verdict, and nothing was written");
  } catch (const reference::NotEnclosed& error) {
    tell(name + ": no verdict: " + error.what());
    return kFailed;
  }
}

// The energy that the shading of a mesh can give to the hand.

void expect_length(const char* option, float value, float least, float most) {
  if (!(value >= least && value <= most)) throw Error(ParameterError{option, "mm", value, least, most}.message());
}

struct MeshVerdict {
  const std::string& name;
  const MeshRendering& rendering;
  double depth, length;  // mm
  properties::LargestTurns turns;
  properties::MeshStroke stroke;

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
            {"bound_mJ", {verdict.least_work(), verdict.most_work()}}};
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

void print(const MeshVerdict& verdict) {
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

// depth: of the god-object from the hand; length: of a closed path; both in mm. json: where the verdict goes as JSON, "-" for
// standard output, or empty. Throws Error where there is no bound for this rendering, and Interrupted; nothing is written then.
// Returns the exit code.
int print_energy_of_mesh(const std::string& name, const MeshRendering& rendering, float depth, float length,
                         const std::string& json) {
  if (const std::string why = properties::why_no_energy_bound(rendering); !why.empty()) throw Error(name + ": " + why);
  expect_length("--depth", depth, 0x1p-10F, 100);
  expect_length("--length", length, 0x1p-10F, 10000);
  watch_for_interrupt();
  const auto judged = [&](const Monitor& monitor) {
    MeshVerdict verdict{.name = name,
                        .rendering = rendering,
                        .depth = static_cast<double>(depth),
                        .length = static_cast<double>(length),
                        .turns = properties::largest_turns(rendering),
                        .stroke = {}};
    if (verdict.turns.most() > 0)
      verdict.stroke = properties::best_stroke(rendering, verdict.turns, verdict.depth, verdict.length, monitor);
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

}  // namespace

void add_energy(CLI::App& app, int& result) {
  const auto options = std::make_shared<EnergyOptions>();
  CLI::App* command = app.add_subcommand(
      "energy", "Show whether a law, a height map or a mesh is passive, and the most energy a loop can draw from it");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one, true);
  add_length(*command, "--depth", options->depth, "of the loops, below the nominal surface or from a mesh's god-object")
      ->required();
  add_json(*command, options->json, "the verdict, with the loop,");
  add_section(*command, options->section, "of a height map, over which its loops lie")->needs("--height-map");
  add_length(*command, "--length", options->length, "of the loops on a mesh, at most")->needs("--mesh");
  command->callback([options, subject, &result] {
    const float depth = files::parse_length("--depth", options->depth);
    const Description what = subject->description();
    options->damping = what.damping;
    if (what.damping.time > 0) {
      const subjects::Options given = subject->options();  // which do not have what a scene's file says
      throw Error((given.has(subjects::kDampingFilter) ? given.name(subjects::kDampingFilter) : what.name + ": time") +
                  ": expected a share such as 0.5, since a time constant makes one of a rate, got \"" +
                  shortest(what.damping.time) + "s\"");
    }
    result = what.visit([&](const DescribedLaw& law) { return run_law(*options, law, depth); },
                        [&](const DescribedHeightMap& map) { return run_height_map(*options, what.name, map, depth); },
                        [&](const MeshRendering& mesh) {
                          return print_energy_of_mesh(what.name, mesh, depth, files::parse_length("--length", options->length),
                                                      options->json);
                        },
                        [&](const DescribedScene&) -> int {
                          throw Error(what.name + ": expected a scene without objects that move, got one with them");
                        });
    if (const double most = sampled(what.damping); most > 0 && options->json != "-")
      std::printf(
          "damping: takes energy at its own velocity; held from tick to tick it gives at most %.4g N s/mm times the sum "
          "of |step|^2 / T, such as %.4g mJ in a second at 100 mm/s\n",
          most, most * 1e4);
  });
}

}  // namespace forceshade::apps
