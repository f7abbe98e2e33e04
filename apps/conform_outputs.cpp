// SPDX-License-Identifier: BSD-3-Clause
#include "apps/conform_outputs.h"

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/page.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "forceshade/checks.h"
#include "properties/conformance/judgement_text.h"

namespace forceshade::apps {

ConformOutputs::ConformOutputs(CLI::App& command, bool has_page) {
  if (has_page) add_output(command, "--out", out_, "a page of what was found, with pictures", {".html"});
  add_json(command, json_, "the results");
  add_junit(command, junit_);
}

void ConformOutputs::expect_room() const {
  expect_room_for_results(json_, junit_);
  expect_folder_of("--out", out_);
}

int ConformOutputs::write(const ConformResults& results) const {
  if (interrupted()) throw Interrupted("the run was not finished, and nothing was written");
  if (!json_.empty()) write_file(json_, conformance::text_of(results.json));
  if (!out_.empty()) write_file(out_, page_of(out_, results.page));
  if (!junit_.empty()) write_file(junit_, to_junit("forceshade conform", {results.about}, results.cases));
  print_beside({json_, junit_, out_}, results.words);
  return results.held ? kHeld : kFailed;
}

JunitCase case_of_forces(const std::string& suite, const conformance::Judgement& judgement, const std::string& words) {
  return {suite, "forces", 0, judgement.held() ? std::nullopt : std::optional(words), words};
}

void add_cases(std::vector<JunitCase>& cases, const std::string& suite, const std::vector<conformance::Invariant>& invariants,
               const std::optional<std::string>& failure) {
  for (const conformance::Invariant& each : invariants)
    if (!each.not_applicable) cases.push_back({suite, each.name, 0, each.violation, conformance::words_of(each)});
  if (failure) cases.push_back({suite, "answers", 0, failure});
}

CLI::Option* add_tolerance(CLI::App& command, std::string& value) {
  return command
      .add_option("--tolerance", value,
                  "the largest distance of a force from the exact one: \"4 ulp\" in each component, \"1e-6 N\", \"0.1 %\"; "
                  "default: correctly rounded")
      ->type_name("TOLERANCE")
      ->group(kEvidenceGroup);
}

conformance::Tolerance parse_tolerance(const std::string& text) {
  if (text.empty()) return {};
  const auto tolerance = conformance::tolerance_of(text);
  if (!tolerance)
    throw Error(
        "--tolerance: expected a number with ulp (a whole one), N or %, such as \"4 ulp\", \"1e-6 N\" or \"0.1 %\", got \"" +
        text + '"');
  return *tolerance;
}

}  // namespace forceshade::apps
