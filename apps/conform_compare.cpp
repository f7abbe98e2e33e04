// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform compare: two runs of one renderer or simulator side by side.

#include <memory>
#include <string>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/standard_streams.h"
#include "properties/conformance/judgement_text.h"
#include "report/conformance/comparison.h"

namespace forceshade::apps {
namespace {

struct RunsToCompare {
  std::string before, after, json;
};

int run(const RunsToCompare& its) {
  expect_folder_of("--json", its.json);
  const conformance::Comparison found = conformance::compare_files(its.before, its.after);
  if (!its.json.empty()) write_file(its.json, conformance::text_of(conformance::json_of(found)));
  print_beside({its.json}, conformance::words_of(found));
  return found.is_worse() ? kFailed : kHeld;
}

}  // namespace

void add_conform_compare(CLI::App& conform, int& result) {
  const auto its = std::make_shared<RunsToCompare>();
  CLI::App* command = conform.add_subcommand(
      "compare", "Show what got worse and what got better between two runs of one renderer or simulator");
  command->add_option("before", its->before, "the report that 'forceshade conform --json' wrote of one version")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("after", its->after,
                   "of another version, with the same subject, seed, number of positions and tolerance if it is a renderer")
      ->type_name("FILE")
      ->required();
  add_json(*command, its->json, "the changes");
  command->callback([its, &result] { result = run(*its); });
}

}  // namespace forceshade::apps
