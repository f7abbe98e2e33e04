// SPDX-License-Identifier: BSD-3-Clause
// forceshade properties: equivalence, continuity, unit normals and passivity of the fast path, with RapidCheck.

#include <cstdio>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/standard_streams.h"
#include "forceshade/apps/subject_option.h"
#include "forceshade/properties/run.h"

namespace forceshade::apps {
namespace {

struct Options {
  int cases = 10000;
  std::uint64_t seed = 1;
};

// Whether all of them held.
bool check(const properties::Subject& subject, const Options& options) {
  bool held = true;
  run_properties(subject, options.cases, options.seed, [&](const properties::PropertyResult& property) {
    std::printf("%-15s %-13s %s  %llu cases\n", subject.identity().name.c_str(), property.name.c_str(),
                property.held ? "held  " : "FAILED", static_cast<unsigned long long>(property.cases));
    if (!property.held) std::printf("  counterexample: %s\n", property.counterexample.c_str());
    flush_standard_output();
    held = held && property.held;
  });
  return held;
}

int run(const Options& options, const SubjectOption& option) {
  const auto subjects = option.subjects();
  std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  bool held = true;
  for (const auto& subject : subjects) held = check(*subject, options) && held;
  return held ? kHeld : kFailed;
}

}  // namespace

void add_properties(CLI::App& app, int& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("properties", "Check the properties of the fast path on generated cases");
  const auto subject = std::make_shared<SubjectOption>(*command, LawOptions::Laws::one_or_all, LawOptions::Defaults::thesis);
  add_whole(*command, "--cases", options->cases, "cases per law and property (passivity: a tenth)", kCases);
  add_whole(*command, "--seed", options->seed, "seed of the cases", kSeeds);
  command->callback([options, subject, &result] { result = run(*options, *subject); });
}

}  // namespace forceshade::apps
