// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform: a third-party renderer, in a process of its own, held against the exact definition.

#include "properties/conformance/conform.h"

#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/conform_compare.h"
#include "apps/conform_recording.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/page.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "apps/subject_option.h"
#include "apps/tolerance_option.h"
#include "files/csv.h"
#include "forceshade/certificate.h"
#include "properties/conformance/doors/object_door.h"
#include "properties/conformance/doors/process_door.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/report/page.h"
#include "properties/conformance/simulators/conform_simulator.h"
#include "properties/conformance/simulators/simulator_process.h"

namespace forceshade::apps {
namespace {

struct ConformCommand {
  std::string command, object, simulator, tolerance, out, json, junit;
  conformance::ConformOptions options = {};
  double answer_seconds = 10;

  files::ProcessLimits limits() const {
    files::ProcessLimits limits;
    limits.answer = std::chrono::milliseconds(static_cast<int>(1000 * answer_seconds));
    return limits;
  }
};

void add_cases(std::vector<JunitCase>& cases, const std::string& suite, const std::vector<conformance::Invariant>& invariants,
               const std::optional<std::string>& failure) {
  for (const conformance::Invariant& each : invariants)
    if (!each.not_applicable) cases.push_back({suite, each.name, 0, each.violation, conformance::words_of(each)});
  if (failure) cases.push_back({suite, "answers", 0, failure});
}

std::vector<JunitCase> junit_cases(const conformance::Conformance& found, const std::string& words) {
  const std::string& name = found.identity.name;
  std::vector<JunitCase> cases;
  if (found.hello.claims_definition || !found.is_applicable())
    cases.push_back({name, "forces", 0, found.judgement.held() ? std::nullopt : std::optional(words), words});
  add_cases(cases, name, found.invariants, found.failure);
  return cases;
}

int run(const ConformCommand& its, const SubjectOption& option, const std::string& repeated) {
  if (!its.object.empty()) files::open_input(its.object);
  conformance::ConformOptions options = its.options;
  if (!its.tolerance.empty()) options.tolerance = parse_tolerance(its.tolerance);
  expect_room_for_results(its.json, its.junit);
  expect_folder_of("--out", its.out);
  watch_for_interrupt();
  const Description description = option.description();
  std::optional<ProgressLine> line(description.name);
  const Monitor monitor([&](double done) { line->draw(done); }, interrupted());
  const conformance::OpenRenderer open = its.object.empty() ? conformance::process_door(its.command, its.limits())
                                                            : conformance::object_door(its.object, its.limits());
  const conformance::Conformance found = conformance::conform(description, open, options, monitor);
  line.reset();
  const std::string words = conformance::words_of(found, options.tolerance);
  const conformance::Circumstances circumstances{options, properties::current_build().version, repeated};
  if (!its.json.empty()) write_file(its.json, conformance::text_of(conformance::json_of(found, circumstances)));
  if (!its.out.empty())
    write_file(its.out, page_of(its.out, [&](properties::Pictures shown) {
                 return conformance::to_html(found, description, circumstances, shown);
               }));
  if (!its.junit.empty())
    write_file(its.junit, to_junit("forceshade conform", {{"tolerance", conformance::words_of(options.tolerance)}},
                                   junit_cases(found, words)));
  print_beside({its.json, its.junit, its.out}, words);
  return found.held() ? kHeld : kFailed;
}

int run_simulator(const ConformCommand& its, const std::string& repeated) {
  namespace simulators = conformance::simulators;
  expect_room_for_results(its.json, its.junit);
  expect_folder_of("--out", its.out);
  watch_for_interrupt();
  std::optional<ProgressLine> line("simulator");
  const Monitor monitor([&](double done) { line->draw(done); }, interrupted());
  const simulators::SimulatorConformance found =
      simulators::conform_simulator(simulators::simulator_process(its.simulator, its.limits()), monitor);
  line.reset();
  const std::string version = properties::current_build().version;
  if (!its.json.empty()) write_file(its.json, conformance::text_of(simulators::json_of(found, version, repeated)));
  if (!its.out.empty())
    write_file(its.out, page_of(its.out, [&](properties::Pictures shown) {
                 return conformance::to_html(found, version, repeated, shown);
               }));
  if (!its.junit.empty()) {
    std::vector<JunitCase> cases;
    add_cases(cases, found.simulator.name, found.invariants, found.failure);
    write_file(its.junit, to_junit("forceshade conform", {{"settings", found.simulator.settings}}, cases));
  }
  print_beside({its.json, its.junit, its.out}, simulators::words_of(found));
  return found.held() ? kHeld : kFailed;
}

}  // namespace

void add_conform(CLI::App& app, int& result) {
  const auto its = std::make_shared<ConformCommand>();
  CLI::App* command = app.add_subcommand(
      "conform", "Compare a third-party renderer, in a process of its own or by a recording, with the exact definition");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  command->option_defaults()->group(kEvidenceGroup);
  CLI::Option* process = command
                             ->add_option("--command", its->command,
                                          "its command for the shell; it speaks lines of JSON on its standard input and output "
                                          "(docs/conformance-protocol.md)")
                             ->type_name("COMMAND")
                             ->group(kEvidenceGroup);
  command
      ->add_option("--object", its->object, "a shared object with the one function of forceshade.h, in the place of a process")
      ->type_name("FILE")
      ->excludes(process)
      ->group(kEvidenceGroup);
  CLI::Option* simulator = command->add_option(
      "--simulator", its->simulator,
      "instead of a subject and its renderer: how the shell starts a simulator, which answers forces with motion");
  simulator->type_name("COMMAND")->group(kEvidenceGroup);
  const auto recording = std::make_shared<RecordingOption>(*command);
  add_tolerance(*command, its->tolerance);
  add_whole(*command, "--points", its->options.points, "number of positions to compare", {1, 1000000000});
  add_whole(*command, "--seed", its->options.seed, "seed of the positions", kSeeds);
  add_number(*command, "--answer-timeout",
             "the longest time for an answer to up to 1024 positions or forces, in seconds; default: 10", {0.01, 3600},
             [its](double seconds) { its->answer_seconds = seconds; });
  command
      ->add_flag("--timing", its->options.is_timed,
                 "measure the time of an answer to one position: half, 99.9 % and the slowest; count what a shared object "
                 "allocates in it; "
                 "it decides nothing")
      ->group(kEvidenceGroup);
  add_number(*command, "--max-answer-time", "measure it, and fail where the slowest answer took more, in seconds", {1e-9, 3600},
             [its](double seconds) {
               its->options.is_timed = true;
               its->options.most_seconds = seconds;
             });
  add_output(*command, "--out", its->out, "a page of what was found, with pictures", {".html"});
  add_json(*command, its->json, "the results");
  add_junit(*command, its->junit);
  for (const char* of_renderers : {"--law", "--height-map", "--mesh", "--scene", "--subject", "--command", "--object",
                                   "--recording", "--tolerance", "--points", "--seed", "--timing", "--max-answer-time"})
    simulator->excludes(command->get_option(of_renderers));
  for (const char* of_doors :
       {"--command", "--object", "--points", "--seed", "--answer-timeout", "--timing", "--max-answer-time"})
    command->get_option(of_doors)->excludes(command->get_option("--recording"));
  add_conform_compare(*command, result);
  command->callback([its, subject, recording, command, &result] {
    if (command->got_subcommand("compare")) return;
    if (its->command.empty() && its->object.empty() && its->simulator.empty() && !recording->is_given())
      throw CLI::RequiredError("--command, --object, --simulator or --recording");
    if (recording->is_given())
      result = recording->run(*subject, its->tolerance, {its->out, its->json, its->junit, repeated(*command)});
    else
      result = its->simulator.empty() ? run(*its, *subject, repeated(*command)) : run_simulator(*its, repeated(*command));
  });
}

}  // namespace forceshade::apps
