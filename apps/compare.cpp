// SPDX-License-Identifier: BSD-3-Clause
// forceshade compare: the forces that any program gave, held against the exact definition.

#include <iostream>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "apps/subject_option.h"
#include "apps/tolerance_option.h"
#include "files/csv.h"
#include "properties/conformance/case_file.h"
#include "properties/conformance/judgement_text.h"

namespace forceshade::apps {
namespace {

struct CompareOptions {
  std::string forces, tolerance = "0 ulp", json, junit;
};

int run(const CompareOptions& options, const SubjectOption& option) {
  const conformance::Tolerance tolerance = parse_tolerance(options.tolerance);
  expect_room_for_results(options.json, options.junit);
  watch_for_interrupt();
  const auto subject = option.subject();
  conformance::Judge judge(subject, tolerance);
  std::ifstream file;
  if (options.forces != "-") file = files::open_file(options.forces);
  conformance::read_cases(options.forces == "-" ? std::cin : file, options.forces == "-" ? "standard input" : options.forces,
                          [&](const conformance::Case& its) {
                            if (interrupted()) throw Interrupted("not all forces were compared, and nothing was written");
                            judge.add(its);
                          });
  const Identity& identity = subject->identity();
  const std::string words = words_of(judge.judgement(), identity, tolerance);
  const bool held = judge.judgement().held();
  if (!options.json.empty())
    write_file(options.json, conformance::text_of(conformance::json_of(judge.judgement(), identity, tolerance)));
  if (!options.junit.empty())
    write_file(options.junit, to_junit("forceshade compare", {{"tolerance", conformance::words_of(tolerance)}},
                                       {{identity.name, "forces", 0, held ? std::nullopt : std::optional(words), words}}));
  print_beside({options.json, options.junit}, words);
  return held ? kHeld : kFailed;
}

}  // namespace

void add_compare(CLI::App& app, int& result) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Hold the forces that any program gave against the exact definition");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  command
      ->add_option(
          "--forces", options->forces,
          "CSV or NPY file with x_mm, y_mm, z_mm, fx_N, fy_N, fz_N, and reset and aim where positions wrote them; - is "
          "CSV on standard input")
      ->type_name("FILE")
      ->required()
      ->group(kEvidenceGroup);
  add_tolerance(*command, options->tolerance);
  add_json(*command, options->json, "the results");
  add_junit(*command, options->junit);
  command->callback([options, subject, &result] { result = run(*options, *subject); });
}

}  // namespace forceshade::apps
