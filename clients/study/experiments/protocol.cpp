// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/protocol.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "files/input_file.h"
#include "files/suggestion.h"
#include "files/toml_table.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;
using files::TomlTable;

// The domain of the laws (docs/laws.md): 0.1 mm to 10 m for a radius, 0.001 mm to twice the radius for a width.
constexpr Mil kLeastRadius = 4, kLargestRadius = 393'700, kLargestWidth = 787'400;
constexpr float kLeastStiffness = 1e-3F, kLargestStiffness = 1e3F;  // N/mm
constexpr int kMostRepetitions = 1000, kMostTrials = 100'000, kMostRadiusSteps = 10'000;

constexpr std::array<std::pair<std::string_view, Experiment>, 2> kExperiments{
    {{"matching", Experiment::matching}, {"classification", Experiment::classification}}};
constexpr std::array<std::pair<std::string_view, Resume>, 2> kResumes{{{"trial", Resume::trial}, {"block", Resume::block}}};
constexpr std::array<std::pair<std::string_view, BlockOrder>, 2> kBlockOrders{
    {{"as-listed", BlockOrder::as_listed}, {"random", BlockOrder::random}}};
constexpr std::array<std::pair<std::string_view, Bigger>, 2> kBiggers{
    {{"higher", Bigger::higher}, {"larger-radius", Bigger::larger_radius}}};
constexpr std::array<std::string_view, 4> kUnits{"mm", "cm", "m", "in"};

// The folder of the files of a protocol, and the rule for missing ones.
struct Beside {
  fs::path folder;
  Files files;
};

fs::path beside(TomlTable& table, std::string_view key, const Beside& where) {
  fs::path file = where.folder / table.text(key);
  std::error_code ignored;
  if (where.files == Files::must_exist && !fs::is_regular_file(file, ignored))
    table.fail(key, "expected a file, found none at " + file.string());
  return file;
}

// The first of these that the table has; a law where it has none.
StimulusKind kind_of(const TomlTable& table) {
  return table.has("height-map") ? StimulusKind::height_map
         : table.has("mesh")     ? StimulusKind::mesh
         : table.has("subject")  ? StimulusKind::subject
                                 : StimulusKind::law;
}

// The file of a height map, mesh or subject; a height map's where the table has none of the three keys.
Variant shape_of(TomlTable& table, StimulusKind kind, const Beside& where) {
  Variant variant;
  const char* key = kind == StimulusKind::mesh ? "mesh" : kind == StimulusKind::subject ? "subject" : "height-map";
  variant.file = beside(table, key, where);
  if (kind != StimulusKind::mesh) return variant;
  variant.unit = table.text("unit");
  if (std::ranges::find(kUnits, variant.unit) == kUnits.end())
    table.fail("unit", "expected mm, cm, m or in, got \"" + variant.unit + '"');
  return variant;
}

void read_variants(TomlTable& table, const Beside& where, Stimulus& stimulus) {
  std::vector<Variant>& all = stimulus.variants;
  for (TomlTable& one : table.tables("variants")) {
    const StimulusKind kind = kind_of(one);
    Variant variant = shape_of(one, kind, where);
    variant.radius = one.whole("radius_mil", kLeastRadius, kLargestRadius);
    one.expect_no_other();
    if (!all.empty() && kind != stimulus.kind)
      table.fail("variants", "expected height maps, meshes or subjects, got more than one of these");
    stimulus.kind = kind;
    if (!all.empty() && variant.radius <= all.back().radius)
      one.fail("radius_mil", "expected more than the " + std::to_string(all.back().radius) + " of the variant before it");
    all.push_back(variant);
  }
}

Stimulus stimulus_of(TomlTable table, const Beside& where) {
  Stimulus stimulus;
  const bool has_name = table.has("name");
  if (has_name) stimulus.name = table.text("name");
  if (table.has("law")) {
    const std::string law = table.text("law");
    const auto id = law_named(law);
    std::vector<std::string> known;
    for (const LawName& each : kLaws) known.emplace_back(each.name);
    if (!id)
      table.fail("law", "expected the name of a law as `forceshade laws` lists them, got \"" + law + '"' +
                            files::suggestion(law, known));
    stimulus.law = *id;
    if (!has_name) stimulus.name = law;
  } else if (table.has("variants")) {
    read_variants(table, where, stimulus);
    if (!has_name) table.fail("name", "is missing: variants need one");
  } else if (kind_of(table) != StimulusKind::law) {
    stimulus.kind = kind_of(table);
    stimulus.variants = {shape_of(table, stimulus.kind, where)};
    if (!has_name) stimulus.name = stimulus.variants.front().file.stem().string();
  } else {
    table.fail("law", "is missing: expected law, height-map, mesh, subject or variants");
  }
  table.expect_no_other();
  return stimulus;
}

bool is_same(const Stimulus& a, const Stimulus& b) {
  const auto same_variant = [](const Variant& v, const Variant& w) {
    return v.radius == w.radius && v.file == w.file && v.unit == w.unit;
  };
  return a.kind == b.kind && a.law == b.law && std::ranges::equal(a.variants, b.variants, same_variant);
}

void read_stimuli(TomlTable& table, const Beside& where, Protocol& protocol) {
  for (const TomlTable& one : table.tables("stimuli")) {
    protocol.stimuli.push_back(stimulus_of(one, where));
    for (std::size_t i = 0; i + 1 < protocol.stimuli.size(); ++i)
      if (protocol.stimuli[i].name == protocol.stimuli.back().name)
        one.fail("name", "\"" + protocol.stimuli.back().name + "\" is the name of an earlier stimulus, too");
  }
}

// Fails where a condition of `stimulus` cannot be rendered.
void expect_radii(const TomlTable& table, std::string_view key, const Protocol& protocol, const Stimulus& stimulus,
                  const std::vector<Mil>& radii) {
  for (const Mil radius : radii) {
    const auto has_radius = [&](const Variant& variant) { return variant.radius == radius; };
    if (stimulus.kind == StimulusKind::law ? stimulus.law != LawId::wall && 2 * radius < protocol.width
                                           : std::ranges::none_of(stimulus.variants, has_radius))
      table.fail(key, stimulus.kind == StimulusKind::law
                          ? "expected half the width of " + std::to_string(protocol.width) + " mil or more, got " +
                                std::to_string(radius)
                          : "stimulus " + stimulus.name + " has no variant of " + std::to_string(radius) + " mil");
  }
}

void read_matching(TomlTable& table, const Beside& where, Protocol& protocol) {
  protocol.reference = stimulus_of(table.table("reference"), where);
  protocol.vision = table.flags("vision");
  protocol.reference_radii = table.wholes("reference_radii_mil", kLeastRadius, kLargestRadius);
  protocol.large_initial_radius = table.whole("large_initial_radius_mil", kLeastRadius, kLargestRadius);
  protocol.small_initial_radius = table.whole("small_initial_radius_mil", kLeastRadius, protocol.large_initial_radius);
  protocol.radius_step = table.whole("radius_step_mil", 1, kLargestRadius);
  protocol.least_radius = table.whole("least_radius_mil", kLeastRadius, protocol.small_initial_radius);
  protocol.largest_radius = table.whole("largest_radius_mil", protocol.large_initial_radius, kLargestRadius);
  if ((protocol.largest_radius - protocol.least_radius) / protocol.radius_step > kMostRadiusSteps)
    table.fail("radius_step_mil",
               "expected at most " + std::to_string(kMostRadiusSteps) + " steps between the limits, got more");
  protocol.bigger = table.word<Bigger>("bigger", kBiggers);
  protocol.block_order = table.word<BlockOrder>("block_order", kBlockOrders);
  protocol.spacing = table.whole("spacing_mil", protocol.width, kLargestWidth);
  if (protocol.spacing % 2 != 0) table.fail("spacing_mil", "expected an even number, got " + std::to_string(protocol.spacing));
  for (const Stimulus& stimulus : protocol.stimuli) {
    if (stimulus.name == protocol.reference.name && !is_same(stimulus, protocol.reference))
      table.fail("reference", "has the name of another stimulus, " + stimulus.name);
    std::vector<Mil> needed = protocol.reference_radii;
    needed.insert(needed.end(), {protocol.large_initial_radius, protocol.small_initial_radius});
    expect_radii(table, "stimuli", protocol, stimulus, needed);
  }
  expect_radii(table, "reference_radii_mil", protocol, protocol.reference, protocol.reference_radii);
  for (const Mil radius : protocol.reference_radii)
    if (radius < protocol.least_radius || radius > protocol.largest_radius)
      table.fail("reference_radii_mil",
                 "expected radii from least_radius_mil to largest_radius_mil, got " + std::to_string(radius));
  if (2 * protocol.least_radius < protocol.width)
    table.fail("least_radius_mil", "expected half the width of " + std::to_string(protocol.width) + " mil or more");
}

void read_classification(TomlTable& table, Protocol& protocol) {
  const bool has_law =
      std::ranges::any_of(protocol.stimuli, [](const Stimulus& stimulus) { return stimulus.kind == StimulusKind::law; });
  if (!has_law) return;
  protocol.radii = table.wholes("radii_mil", kLeastRadius, kLargestRadius);
  for (const Stimulus& stimulus : protocol.stimuli)
    if (stimulus.kind == StimulusKind::law) expect_radii(table, "radii_mil", protocol, stimulus, protocol.radii);
}

std::vector<Mil> variant_radii(const Stimulus& stimulus) {
  std::vector<Mil> radii;
  for (const Variant& variant : stimulus.variants) radii.push_back(variant.radius);
  return radii;
}

}  // namespace

const Stimulus& Protocol::stimulus(std::string_view name) const {
  for (const Stimulus& one : stimuli)
    if (one.name == name) return one;
  return reference;
}

Parameters Protocol::parameters(Mil radius) const {
  return {static_cast<float>(radius * kMillimetresPerMil), static_cast<float>(width * kMillimetresPerMil), stiffness};
}

std::vector<Mil> Protocol::radii_of(const Stimulus& stimulus) const {
  return stimulus.kind == StimulusKind::law ? radii : variant_radii(stimulus);
}

Mil Protocol::stepped(const Stimulus& stimulus, Mil radius, int direction) const {
  if (stimulus.kind == StimulusKind::law) return std::clamp(radius + direction * radius_step, least_radius, largest_radius);
  const std::vector<Mil> all = variant_radii(stimulus);
  const auto at = std::ranges::find(all, radius) - all.begin() + direction;
  return at < 0 || at >= std::ssize(all) ? radius : all[static_cast<std::size_t>(at)];
}

int Protocol::trials() const {
  if (experiment == Experiment::matching)
    return static_cast<int>(stimuli.size() * vision.size() * reference_radii.size()) * 3 * repetitions;
  int all = 0;
  for (const Stimulus& one : stimuli) all += static_cast<int>(radii_of(one).size()) * repetitions;
  return all;
}

std::vector<Bump> Protocol::bumps() const {
  std::vector<std::pair<std::string, std::set<Mil>>> all;  // in the order of the protocol
  const auto add = [&](const Stimulus& one, const std::set<Mil>& its_radii) {
    const auto at = std::ranges::find(all, one.name, &std::pair<std::string, std::set<Mil>>::first);
    if (at == all.end())
      all.emplace_back(one.name, its_radii);
    else
      at->second.insert(its_radii.begin(), its_radii.end());
  };
  if (experiment == Experiment::matching) add(reference, {reference_radii.begin(), reference_radii.end()});
  for (const Stimulus& one : stimuli) {
    if (experiment == Experiment::classification) {
      const std::vector<Mil> its_radii = radii_of(one);
      add(one, {its_radii.begin(), its_radii.end()});
      continue;
    }
    // All that the keys reach from an initial radius.
    std::set<Mil> reached;
    std::vector<Mil> to_do = reference_radii;
    to_do.insert(to_do.end(), {large_initial_radius, small_initial_radius});
    while (!to_do.empty()) {
      const Mil radius = to_do.back();
      to_do.pop_back();
      if (!reached.insert(radius).second) continue;
      to_do.insert(to_do.end(), {stepped(one, radius, 1), stepped(one, radius, -1)});
    }
    add(one, reached);
  }
  std::vector<Bump> bumps;
  for (const auto& [name, its_radii] : all)
    for (const Mil radius : its_radii) bumps.push_back({name, radius, 0});
  return bumps;
}

Protocol read_protocol(const fs::path& file, const fs::path& folder, Files files) {
  const files::TomlFile parsed(file);
  TomlTable table(parsed);
  const Beside where{folder.empty() ? file.parent_path() : folder, files};
  Protocol protocol;
  protocol.file = file;
  protocol.experiment = table.word<Experiment>("experiment", kExperiments);
  protocol.name = table.text("name");
  protocol.language = where.folder / table.text("language");
  protocol.width = table.whole("width_mil", 1, kLargestWidth);
  protocol.stiffness = table.number("stiffness_N_per_mm", kLeastStiffness, kLargestStiffness);
  protocol.practice_trials = table.whole("practice_trials", 0, kMostRepetitions, 0);
  protocol.trials_before_break = table.whole("trials_before_break", 0, kMostTrials, 0);
  protocol.resume = table.word<Resume>("resume", kResumes);
  protocol.repetitions = table.whole("repetitions", 1, kMostRepetitions);
  read_stimuli(table, where, protocol);
  if (protocol.experiment == Experiment::matching)
    read_matching(table, where, protocol);
  else
    read_classification(table, protocol);
  table.expect_no_other();
  if (protocol.trials() > kMostTrials)
    table.fail("repetitions",
               "expected at most " + std::to_string(kMostTrials) + " trials, got " + std::to_string(protocol.trials()));
  return protocol;
}

}  // namespace forceshade::experiments
