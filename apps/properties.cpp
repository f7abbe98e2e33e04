// SPDX-License-Identifier: BSD-3-Clause
// forceshade properties: equivalence, continuity, unit normals and passivity of the fast path, on generated cases.

#include "forceshade/properties.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "apps/subject_option.h"
#include "certificate/build.h"
#include "forceshade/checks.h"
#include "rendering/identity/identity_json.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;

struct PropertiesOptions {
  int cases = 10000;
  std::uint64_t seed = 1;
  std::string json, junit;
};

// Checks one subject after the other, and keeps what was found.
class Checks {
 public:
  explicit Checks(const PropertiesOptions& options) : options_(options) {}

  void add(const properties::Subject& subject) {
    const std::string& name = subject.identity().name;
    Json properties = Json::array();
    for (const properties::PropertyResult& property : results(subject)) {
      held_ = held_ && property.held;
      const double seconds = times_.seconds(name, property.name);
      Json found{{"name", property.name}, {"held", property.held}, {"cases", property.cases}, {"seconds", seconds}};
      if (!property.held) found["counterexample"] = property.counterexample;
      properties.push_back(found);
      junit_.push_back({name, property.name, seconds, property.held ? std::nullopt : std::optional(property.counterexample),
                        std::to_string(property.cases) + " cases"});
    }
    // Named as in a certificate.
    Json found{{"kind", subject.identity().kind}, {"name", name}};
    if (!subject.identity().digest.empty()) found["digest"] = subject.identity().digest;
    found["parameters"] = parameters_json(subject.identity());
    found["properties"] = properties;
    subjects_.push_back(found);
  }

  bool held() const { return held_; }
  bool is_printed() const { return options_.json != "-" && options_.junit != "-"; }

  void write() const {
    const properties::Build build = properties::current_build();
    const std::string seed = std::to_string(options_.seed);
    if (!options_.json.empty()) {
      const Json json{{"held", held_},
                      {"seed", options_.seed},
                      {"cases", options_.cases},
                      {"version", build.version},
                      {"library_digest", build.library_digest},
                      {"subjects", subjects_}};
      write_json(options_.json, json);
    }
    if (!options_.junit.empty())
      write_file(options_.junit,
                 to_junit("forceshade properties",
                          {{"seed", seed}, {"version", build.version}, {"library_digest", build.library_digest}}, junit_));
  }

 private:
  std::vector<properties::PropertyResult> results(const properties::Subject& subject) {
    const std::string& name = subject.identity().name;
    std::optional<ProgressLine> line;
    return run_properties(
        subject, options_.cases, options_.seed,
        [&](const properties::PropertyResult& property) {
          line.reset();               // off the row that is printed on
          if (interrupted()) return;  // not all cases were checked
          if (is_printed()) print(name, property);
        },
        [&](const std::string& property, double done) {
          times_.add(name, property);
          if (!line) line.emplace(name);
          line->draw(done);
        },
        &interrupted());
  }

  static void print(const std::string& name, const properties::PropertyResult& property) {
    std::printf("%-15s %-13s %s  %llu cases\n", name.c_str(), property.name.c_str(), property.held ? "held  " : "FAILED",
                static_cast<unsigned long long>(property.cases));
    if (!property.held) std::printf("  counterexample: %s\n", property.counterexample.c_str());
    flush_standard_output();
  }

  const PropertiesOptions& options_;
  bool held_ = true;
  PartTimes times_;
  Json subjects_ = Json::array();
  std::vector<JunitCase> junit_;
};

int run(const PropertiesOptions& options, const SubjectOption& option) {
  expect_room_for_results(options.json, options.junit);
  const auto subjects = option.subjects();
  Checks checks(options);
  if (checks.is_printed()) std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  watch_for_interrupt();
  for (const auto& subject : subjects) {
    checks.add(*subject);
    if (interrupted()) throw Interrupted("not all properties were checked, and nothing was written");
  }
  checks.write();
  return checks.held() ? kHeld : kFailed;
}

}  // namespace

void add_properties(CLI::App& app, int& result) {
  const auto options = std::make_shared<PropertiesOptions>();
  CLI::App* command = app.add_subcommand("properties", "Check the properties of the fast path on generated cases");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::several);
  add_whole(*command, "--cases", options->cases, "cases per law and property (passivity: a tenth)", kCases);
  add_whole(*command, "--seed", options->seed, "seed of the cases", kSeeds);
  add_json(*command, options->json, "the results");
  add_junit(*command, options->junit);
  command->callback([options, subject, &result] { result = run(*options, *subject); });
}

}  // namespace forceshade::apps
