// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform: a third-party renderer, in a process of its own, held against the exact definition; and a simulator, held
// against what must hold of its motion.

#include "properties/conformance/conform.h"

#include <filesystem>
#include <memory>

#include "apps/command.h"
#include "apps/conform_outputs.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "forceshade/certificate.h"
#include "properties/conformance/doors/process_door.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/simulators/conform_simulator.h"
#include "properties/conformance/simulators/simulator_process.h"
#include "report/conformance/page.h"

namespace forceshade::apps {
namespace {

constexpr const char* kNoLimit = "none";  // of --timing, where only the times are of interest

struct Answerer {
  std::string command;  // for the shell, or a shared object
  double answer_seconds = 10;

  files::ProcessLimits limits() const {
    files::ProcessLimits limits;
    limits.answer = std::chrono::milliseconds(static_cast<int>(1000 * answer_seconds));
    limits.stop = &interrupted();
    return limits;
  }
  bool is_object() const {
    return files::format_ending(command) == ".so" && (command.find(' ') == command.npos || std::filesystem::exists(command));
  }
  conformance::OpenRenderer door() const {
    return is_object() ? conformance::object_door(command, limits()) : conformance::process_door(command, limits());
  }
};

// keep: gets the seconds.
void add_answer_timeout(CLI::App& command, std::function<void(double)> keep) {
  add_number(command, "--answer-timeout",
             "the longest time for an answer to up to 1024 positions or forces, in seconds; default: 10", {0.01, 3600},
             std::move(keep));
}

ConformResults results_of(const Description& description, const conformance::Conformance& found,
                          const conformance::Circumstances& circumstances) {
  const conformance::Tolerance& tolerance = circumstances.options.tolerance;
  const std::string words = conformance::words_of(found, tolerance);
  std::vector<JunitCase> cases;
  if (found.hello.claims_definition || !found.is_applicable())
    cases.push_back(case_of_forces(found.identity.name, found.judgement, words));
  add_cases(cases, found.identity.name, found.invariants, found.failure);
  return {found.held(),
          words,
          conformance::json_of(found, circumstances),
          [&](properties::Pictures shown) { return conformance::to_html(found, description, circumstances, shown); },
          {"tolerance", conformance::words_of(tolerance)},
          cases};
}

ConformResults results_of(const conformance::simulators::SimulatorConformance& found, const std::string& repeated) {
  const std::string version = properties::current_build().version;
  std::vector<JunitCase> cases;
  add_cases(cases, found.simulator.name, found.invariants, found.failure);
  return {
      found.held(),
      words_of(found),
      json_of(found, version, repeated),
      [&found, version, repeated](properties::Pictures shown) { return conformance::to_html(found, version, repeated, shown); },
      {"settings", found.simulator.settings},
      cases};
}

}  // namespace

void add_conform(CLI::App& app, int& result) {
  struct Options {
    Answerer renderer;
    std::string tolerance;
    conformance::ConformOptions conform = {};
  };
  const auto its = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("conform", "Compare a third-party renderer, in a process of its own, with the exact definition");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  command->option_defaults()->group(kEvidenceGroup);
  command
      ->add_option("--command", its->renderer.command,
                   "its command for the shell, which speaks lines of JSON on its standard input and output "
                   "(docs/conformance-protocol.md); or FILE.so, a shared object with the one function of forceshade.h")
      ->type_name("COMMAND|FILE.so");
  add_tolerance(*command, its->tolerance);
  add_whole(*command, "--points", its->conform.points, "number of positions to compare", {1, 1000000000});
  add_whole(*command, "--seed", its->conform.seed, "seed of the positions", kSeeds);
  add_answer_timeout(*command, [its](double seconds) { its->renderer.answer_seconds = seconds; });
  const auto time = [its](const std::string& limit) {
    its->conform.is_timed = true;
    if (limit != kNoLimit) its->conform.most_seconds = parse_number("--timing", limit, {1e-9, 3600});
  };
  command
      ->add_option_function<std::string>("--timing", time,
                                         "measure the time of an answer to one position: half, 99.9 % and the slowest, and "
                                         "fail where this took more than SECONDS")
      ->type_name("[SECONDS (0.000000001 to 3600)]")
      ->expected(0, 1)
      ->default_str(kNoLimit);
  const auto outputs = std::make_shared<ConformOutputs>(*command);
  add_conform_positions(*command, result);
  add_conform_judge(*command, result);
  add_conform_recording(*command, result);
  add_conform_simulator(*command, result);
  command->callback([its, subject, outputs, command, &result] {
    if (!command->get_subcommands().empty()) return;
    if (its->renderer.command.empty()) throw CLI::RequiredError("--command");
    if (its->renderer.is_object()) files::open_input(its->renderer.command);
    its->conform.tolerance = parse_tolerance(its->tolerance);
    outputs->expect_room();
    watch_for_interrupt();
    const Description description = subject->description();
    const conformance::Circumstances circumstances{its->conform, properties::current_build().version, repeated(*command)};
    const auto found = with_progress(description.name, [&](const Monitor& monitor) {
      return conformance::conform(description, its->renderer.door(), its->conform, monitor);
    });
    result = outputs->write(results_of(description, found, circumstances));
  });
}

void add_conform_simulator(CLI::App& conform, int& result) {
  const auto its = std::make_shared<Answerer>();
  CLI::App* command =
      conform.add_subcommand("simulator", "Check what must hold of a simulator, which answers forces with motion");
  command->add_option("--command", its->command, "how the shell starts it (docs/conformance-protocol.md)")
      ->type_name("COMMAND")
      ->required()
      ->group(kEvidenceGroup);
  add_answer_timeout(*command, [its](double seconds) { its->answer_seconds = seconds; });
  const auto outputs = std::make_shared<ConformOutputs>(*command);
  command->callback([its, outputs, command, &result] {
    outputs->expect_room();
    watch_for_interrupt();
    namespace simulators = conformance::simulators;
    const auto found = with_progress("simulator", [&](const Monitor& monitor) {
      return simulators::conform_simulator(simulators::simulator_process(its->command, its->limits()), monitor);
    });
    result = outputs->write(results_of(found, repeated(*command)));
  });
}

}  // namespace forceshade::apps
