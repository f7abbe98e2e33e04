// SPDX-License-Identifier: BSD-3-Clause
// forceshade properties: equivalence, continuity, unit normals and passivity of the fast path, with RapidCheck.

#include <cstdio>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/properties/run.h"

namespace forceshade::apps {

void add_properties(CLI::App& app, int& result) {
  struct Options {
    int cases = 10000;
    std::uint64_t seed = 1;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("properties", "Check the four properties of the fast path on generated cases");
  const auto law_options = std::make_shared<LawOptions>(*command, LawOptions::Laws::one_or_all, LawOptions::Defaults::thesis);
  command->add_option("--cases", options->cases, "cases per law and property (passivity: a tenth)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the cases")->type_name("S")->capture_default_str();
  command->callback([options, law_options, &result] {
    const Parameters parameters = law_options->parameters();
    std::printf("seed %llu\n", static_cast<unsigned long long>(options->seed));
    for (const LawId id : law_options->laws()) {
      const auto subject = std::get<properties::Subject>(properties::fast_subject(id, parameters));
      for (const properties::PropertyResult& property : properties::run_properties(subject, options->cases, options->seed)) {
        std::printf("%-15s %-13s %s  %llu cases\n", name_of(id).data(), property.name.c_str(),
                    property.held ? "held  " : "FAILED", static_cast<unsigned long long>(property.cases));
        if (!property.held) {
          std::printf("  counterexample: %s\n", property.counterexample.c_str());
          result = kFailed;
        }
        std::fflush(stdout);
      }
    }
  });
}

}  // namespace forceshade::apps
