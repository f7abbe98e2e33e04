// SPDX-License-Identifier: BSD-3-Clause
// forceshade force: the force of a law or of a height map at every position of a CSV, by the fast path or by the reference.

#include <iostream>
#include <memory>

#include "apps/command.h"
#include "apps/force_rows.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/csv.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "forceshade/properties.h"
#include "forceshade/reference.h"

namespace forceshade::apps {
namespace {

struct ForceOptions {
  std::string path = "fast", input = "-", out = "-";
  unsigned digits = 30;
};

RowFormat format_of(const ForceOptions& options) {
  return files::is_named_npy(options.out) ? RowFormat::npy : RowFormat::csv;
}

RowStatus row_status(Status status) {
  return status == Status::unfinished ? RowStatus::unfinished : static_cast<RowStatus>(status);
}

// By the fast path, or by the reference; in a CSV a law's to any number of digits. Built before anything is read.
Answer answer_of(const ForceOptions& options, const SubjectOption& option) {
  const Description what = option.description();
  const auto* a_law = std::get_if<DescribedLaw>(&what.what);
  if (options.path == "reference" && a_law != nullptr && format_of(options) == RowFormat::csv)
    return [law = built(reference::Law::build(a_law->law, a_law->parameters)), digits = options.digits](const auto& position) {
      reference::DecimalForce answer = law.decimal(position, digits);
      return AnsweredRow{{}, row_status(answer.status), {{std::move(answer.x), "0", std::move(answer.z)}}};
    };
  const std::shared_ptr<const properties::Subject> subject = properties::subject_of(what);
  if (options.path == "reference")
    return [subject, reference = std::shared_ptr(subject->open_reference())](const auto& position) {
      const reference::Rounded answer = reference->step(position);
      return AnsweredRow{answer.force, row_status(answer.status), std::nullopt};
    };
  return [session = std::shared_ptr(subject->renderer().open())](const auto& position) {
    const fast::Evaluation answer = session->step(position);
    return AnsweredRow{answer.force, row_status(answer.status), std::nullopt};
  };
}

ExitCode run(const ForceOptions& options, const SubjectOption& subject) {
  watch_for_interrupt();
  std::ios::sync_with_stdio(false);
  const Answer answer = answer_of(options, subject);
  std::ifstream file;
  if (options.input != "-") file = files::open_input(options.input);
  std::istream& in = options.input == "-" ? std::cin : file;
  files::OutputFile output(options.out);
  const RowCount count = answer_rows(in, options.input == "-" ? "standard input" : options.input, format_of(options),
                                     output.stream(), std::cerr, answer);
  output.commit();
  if (count.unanswered == 0) return kHeld;
  tell(std::to_string(count.unanswered) + " of " + std::to_string(count.rows) + " rows could not be answered");
  return kFailed;
}

}  // namespace

void add_force(CLI::App& app, int& result) {
  const auto options = std::make_shared<ForceOptions>();
  CLI::App* command = app.add_subcommand("force", "Read positions as CSV (x_mm, y_mm, z_mm), write forces as CSV or NPY");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  add_word(*command, "--path", options->path, "fast: binary32, shortest form; reference: exact, to N digits",
           {"fast", "reference"});
  CLI::Option* digits =
      add_whole(*command, "--digits", options->digits, "significant decimal digits of a law's reference", kDigits);
  for (const char* other : {"--height-map", "--mesh", "--scene"}) digits->excludes(command->get_option(other));
  command->add_option("--input", options->input, "CSV file; - is standard input")->type_name("FILE")->capture_default_str();
  add_output(*command, "--out", options->out,
             "FILE.npy, a structured array for numpy.load; else a CSV file, - is standard output", {".csv", ".npy"})
      ->capture_default_str();
  command->callback([options, subject, digits, &result] {
    if (!digits->empty() && options->path != "reference")
      throw Error("--digits: expected --path reference beside it, got --path fast, which prints the shortest form");
    if (!digits->empty() && format_of(*options) == RowFormat::npy)
      throw Error("--digits: expected a CSV file as --out beside it, got \"" + options->out + "\", which has binary32 numbers");
    result = run(*options, *subject);
  });
}

}  // namespace forceshade::apps
