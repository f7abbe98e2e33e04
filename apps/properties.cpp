// SPDX-License-Identifier: BSD-3-Clause
// forceshade properties: equivalence, continuity, unit normals and passivity of the fast path, with RapidCheck.

#include <cstdio>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/standard_streams.h"
#include "forceshade/properties/run.h"

namespace forceshade::apps {
namespace {

struct Options {
  int cases = 10000;
  std::uint64_t seed = 1;
};

// Whether all of them held.
template <class Subject>
bool check(const std::string& name, const Subject& subject, const Options& options) {
  bool held = true;
  for (const properties::PropertyResult& property : properties::run_properties(subject, options.cases, options.seed)) {
    std::printf("%-15s %-13s %s  %llu cases\n", name.c_str(), property.name.c_str(), property.held ? "held  " : "FAILED",
                static_cast<unsigned long long>(property.cases));
    if (!property.held) std::printf("  counterexample: %s\n", property.counterexample.c_str());
    flush_standard_output();
    held = held && property.held;
  }
  return held;
}

int run(const Options& options, const LawOptions& law_options, const HeightMapOption& height_map) {
  const auto say_seed = [&] { std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed)); };
  bool held = true;
  if (height_map.is_given()) {
    const float stiffness = law_options.stiffness();
    const auto [map, rendering] = height_map.read(stiffness);
    say_seed();
    return check(height_map.name(), built(properties::fast_subject(map, rendering, stiffness)), options) ? kHeld : kFailed;
  }
  const Parameters parameters = law_options.parameters();
  say_seed();
  for (const LawId id : law_options.laws())
    held = check(std::string(name_of(id)), built(properties::fast_subject(id, parameters)), options) && held;
  return held ? kHeld : kFailed;
}

}  // namespace

void add_properties(CLI::App& app, int& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("properties", "Check the properties of the fast path on generated cases");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one_or_all);
  const auto height_map = std::make_shared<HeightMapOption>(*command, *law);
  add_whole(*command, "--cases", options->cases, "cases per law and property (passivity: a tenth)", kCases);
  add_whole(*command, "--seed", options->seed, "seed of the cases", kSeeds);
  command->callback([options, law, height_map, &result] { result = run(*options, *law, *height_map); });
}

}  // namespace forceshade::apps
