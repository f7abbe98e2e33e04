// SPDX-License-Identifier: BSD-3-Clause
// forceshade force: the force of a law or of a height map at every position of a CSV, by the fast path or by the reference.

#include <iostream>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/apps/force_rows.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/output_options.h"
#include "forceshade/apps/signals.h"
#include "forceshade/csv/csv.h"
#include "forceshade/csv/output_file.h"
#include "forceshade/fast/height_map_field.h"
#include "forceshade/reference/height_map_field.h"

namespace forceshade::apps {
namespace {

struct Options {
  std::string path = "fast", input = "-", out = "-";
  unsigned digits = 30;
};

const char* word(Status status) {
  return status == Status::contact ? "contact" : status == Status::free ? "free" : "invalid";
}

void write(const Eigen::Vector3f& force, Status status, std::ostream& out) {
  for (const float component : force) out << csv::shortest(component) << ',';
  out << word(status);
}

// The law or height map of either path, built before anything is read.
Answer answer_of_law(const Options& options, const LawOptions& law_options) {
  const Parameters parameters = law_options.parameters();
  if (options.path == "fast")
    return [law = built(fast::Law::build(law_options.law(), parameters))](const auto& position, std::ostream& out) {
      const fast::Evaluation answer = law.evaluate(position);
      write(answer.force, answer.status, out);
    };
  return [law = built(reference::Law::build(law_options.law(), parameters)), digits = options.digits](const auto& position,
                                                                                                      std::ostream& out) {
    const reference::DecimalForce answer = law.decimal(position, digits);
    out << answer.x << ",0," << answer.z << ',' << word(answer.status);
  };
}

Answer answer_of_height_map(const Options& options, const HeightMapOption& height_map, float stiffness) {
  const auto [map, rendering] = height_map.read(stiffness);
  if (options.path == "fast")
    return [law = built(fast::HeightMapField::build(map, rendering, stiffness))](const auto& position, std::ostream& out) {
      const fast::Evaluation answer = law.evaluate(position);
      write(answer.force, answer.status, out);
    };
  return [law = built(reference::HeightMapField::build(map, rendering, stiffness))](const auto& position, std::ostream& out) {
    const reference::Rounded answer = law.round_to_binary32(position);
    write(answer.force, answer.status, out);
  };
}

ExitCode run(const Options& options, const LawOptions& law_options, const HeightMapOption& height_map) {
  watch_for_interrupt();
  std::ios::sync_with_stdio(false);
  const Answer answer = height_map.is_given() ? answer_of_height_map(options, height_map, law_options.stiffness())
                                              : answer_of_law(options, law_options);
  std::ifstream file;
  if (options.input != "-") file = csv::open_input(options.input);
  std::istream& in = options.input == "-" ? std::cin : file;
  csv::OutputFile output(options.out);
  const RowCount count =
      answer_rows(in, options.input == "-" ? "standard input" : options.input, output.stream(), std::cerr, answer);
  output.commit();
  if (count.unanswered == 0) return kHeld;
  std::cerr << "forceshade: " << count.unanswered << " of " << count.rows << " rows could not be answered\n";
  return kFailed;
}

}  // namespace

void add_force(CLI::App& app, int& result) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("force", "Read positions as CSV (x_mm, y_mm, z_mm), write forces as CSV");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one);
  const auto height_map = std::make_shared<HeightMapOption>(*command, *law);
  add_word(*command, "--path", options->path, "fast: binary32, shortest form; reference: exact, to N digits",
           {"fast", "reference"});
  CLI::Option* digits =
      add_whole(*command, "--digits", options->digits, "significant decimal digits of a law's reference", kDigits);
  digits->excludes(command->get_option("--height-map"));
  command->add_option("--input", options->input, "CSV file; - is standard input")->type_name("FILE")->capture_default_str();
  add_output(*command, "--out", options->out, "CSV file; - is standard output")->capture_default_str();
  command->callback([options, law, height_map, digits, &result] {
    if (!digits->empty() && options->path != "reference")
      throw BadInput("--digits: expected --path reference beside it, got --path fast, which prints the shortest form");
    result = run(*options, *law, *height_map);
  });
}

}  // namespace forceshade::apps
