// SPDX-License-Identifier: BSD-3-Clause
// forceshade energy: whether a law or a height map is passive: its potential, or the most energy that a loop can give to the
// hand, and a loop that gives it. For the shading of a mesh: energy_of_mesh.cpp.

#include "reference/energy.h"

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/energy_of_mesh.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "reference/height_energy.h"
#include "text/number_text.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;
using reference::binary64;

struct EnergyOptions {
  std::string depth, json, length = "100mm", step = "0.1mm";
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
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%.6g mJ counter-clockwise, %.6g mJ clockwise (%s right, z up)",
                binary64(counter_clockwise)[1], binary64(clockwise)[1], right);
  return text.data();
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
  std::array<char, 128> where{};
  std::snprintf(where.data(), where.size(), "over %s = %g mm, %s from %g to %g mm, ", is_x ? "y" : "x", at, is_x ? "x" : "y",
                from, to);
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
  add_length(*command, "--step", options->step, "the hand's way over a mesh from one tick to the next, at most")
      ->needs("--mesh");
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
                                                      files::parse_length("--step", options->step), options->json);
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
