// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform: a renderer of anybody's, in a process of its own, held against the exact definition.

#include "properties/conformance/conform.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/conform_compare.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/page.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "apps/subject_option.h"
#include "apps/tolerance_option.h"
#include "forceshade/certificate.h"
#include "properties/conformance/doors/process_door.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/report/page.h"

namespace forceshade::apps {
namespace {

struct ConformCommand {
  std::string command, tolerance = "0 ulp", out, json, junit;
  conformance::ConformOptions options = {};
  double answer_seconds = 10;
};

std::vector<JunitCase> junit_cases(const conformance::Conformance& found, const std::string& words) {
  const std::string& name = found.identity.name;
  std::vector<JunitCase> cases;
  if (found.hello.claims_definition || !found.is_applicable())
    cases.push_back({name, "forces", 0, found.judgement.held() ? std::nullopt : std::optional(words), words});
  for (const conformance::Invariant& invariant : found.invariants)
    if (!invariant.not_applicable)
      cases.push_back({name, invariant.name, 0, invariant.violation, std::to_string(invariant.cases) + " cases"});
  if (found.failure) cases.push_back({name, "answers", 0, found.failure});
  return cases;
}

int run(const ConformCommand& its, const SubjectOption& option, const std::string& repeated) {
  conformance::ConformOptions options = its.options;
  options.tolerance = parse_tolerance(its.tolerance);
  expect_room_for_results(its.json, its.junit);
  expect_folder_of("--out", its.out);
  watch_for_interrupt();
  const Description description = option.description();
  conformance::ProcessLimits limits;
  limits.answer = std::chrono::milliseconds(static_cast<int>(1000 * its.answer_seconds));
  std::optional<ProgressLine> line(description.name);
  const Monitor monitor([&](double done) { line->draw(done); }, interrupted());
  const conformance::Conformance found =
      conformance::conform(description, conformance::process_door(its.command, limits), options, monitor);
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
  if (its.json != "-" && its.junit != "-" && its.out != "-") {
    std::fputs(words.c_str(), stdout);
    flush_standard_output();
  }
  return found.held() ? kHeld : kFailed;
}

}  // namespace

void add_conform(CLI::App& app, int& result) {
  const auto its = std::make_shared<ConformCommand>();
  CLI::App* command =
      app.add_subcommand("conform", "Hold a renderer of anybody's, in a process of its own, against the exact definition");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  command->option_defaults()->group(kEvidenceGroup);
  command
      ->add_option(
          "--command", its->command,
          "how the shell starts it; it speaks lines of JSON on its standard input and output (docs/conformance-protocol.md)")
      ->type_name("COMMAND")
      ->group(kEvidenceGroup);
  add_tolerance(*command, its->tolerance);
  add_whole(*command, "--points", its->options.points, "how many positions to compare", {1, 1000000000});
  add_whole(*command, "--seed", its->options.seed, "seed of the positions", kSeeds);
  add_number(*command, "--answer-timeout",
             "how long the renderer may take for an answer of up to 1024 forces, in seconds; 10 unless given", {0.01, 3600},
             [its](double seconds) { its->answer_seconds = seconds; });
  command
      ->add_flag("--timing", its->options.is_timed,
                 "measure the time of an answer to one position: half, 99.9 % and the slowest; it decides nothing")
      ->group(kEvidenceGroup);
  add_number(*command, "--max-answer-time", "measure it, and fail where the slowest answer took more, in seconds", {1e-9, 3600},
             [its](double seconds) {
               its->options.is_timed = true;
               its->options.most_seconds = seconds;
             });
  add_output(*command, "--out", its->out, "a page of what was found, with pictures", {".html"});
  add_json(*command, its->json, "what was found");
  add_junit(*command, its->junit);
  add_conform_compare(*command, result);
  command->callback([its, subject, command, &result] {
    if (command->got_subcommand("compare")) return;
    if (its->command.empty()) throw CLI::RequiredError("--command");
    result = run(*its, *subject, repeated(*command));
  });
}

}  // namespace forceshade::apps
