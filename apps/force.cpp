// SPDX-License-Identifier: BSD-3-Clause
// forceshade force: the force of what is rendered at every position of a CSV, by the fast path or by the reference.

#include <iostream>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/force_rows.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/standard_input.h"
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
  std::string input = "-", out = "-";
  std::optional<std::uint64_t> digits;  // of the reference; 0: rounded to binary32
};

RowFormat format_of(const ForceOptions& options) {
  return files::is_named_npy(options.out) ? RowFormat::npy : RowFormat::csv;
}

RowStatus row_status(Status status) {
  return status == Status::unfinished ? RowStatus::unfinished : static_cast<RowStatus>(status);
}

// open(subject): the session of a path.
template <class Open>
Answer along(const std::shared_ptr<const properties::Subject>& subject, const Open& open) {
  const auto session = std::make_shared<decltype(open(*subject))>(open(*subject));
  return {[session](const auto& position) {
            const auto answer = (*session)->step(position);
            return AnsweredRow{answer.force, row_status(answer.status), std::nullopt};
          },
          [subject, session, open] { *session = open(*subject); }};
}

// By the fast path, or by the reference; in a CSV a law's to any number of digits. Built before anything is read.
Answer answer_of(const ForceOptions& options, const SubjectOption& option) {
  const Description what = option.description();
  if (options.digits.value_or(0) > 0) {
    const auto* a_law = std::get_if<DescribedLaw>(&what.what);
    if (a_law == nullptr) throw Error("--digits: expected binary32 beside " + what.name + ", whose numbers have no other form");
    return {[law = built(reference::Law::build(a_law->law, a_law->parameters)),
             digits = static_cast<unsigned>(*options.digits)](const auto& position) {
      reference::DecimalForce answer = law.decimal(position, digits);
      return AnsweredRow{{}, row_status(answer.status), {{std::move(answer.x), "0", std::move(answer.z)}}};
    }};
  }
  const std::shared_ptr<const properties::Subject> subject = properties::subject_of(what);
  if (options.digits) return along(subject, [](const auto& its) { return its.open_reference(); });
  return along(subject, [](const auto& its) { return its.renderer().open(); });
}

ExitCode run(const ForceOptions& options, const SubjectOption& subject) {
  watch_for_interrupt();
  std::ios::sync_with_stdio(false);
  const Answer answer = answer_of(options, subject);
  InputFile input(options.input);
  files::OutputFile output(options.out);
  const RowCount count = answer_rows(input.stream(), input.name(), format_of(options), output.stream(), std::cerr, answer);
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
  command
      ->add_option_function<std::string>(
          "--digits",
          [options](const std::string& text) {
            options->digits = text == "binary32" ? 0 : parse_whole("--digits", text, kDigits);
          },
          "by the reference instead of the fast path: a law's force to so many significant digits, or any rounded to binary32")
      ->type_name("N (1 to 10000)|binary32");
  command->add_option("positions", options->input, "CSV file; - is standard input")->type_name("FILE")->capture_default_str();
  add_output(*command, "--out", options->out,
             "FILE.npy, a structured array for numpy.load; else a CSV file, - is standard output", {".csv", ".npy"})
      ->capture_default_str();
  command->callback([options, subject, &result] {
    if (options->digits.value_or(0) > 0 && format_of(*options) == RowFormat::npy)
      throw Error("--digits: expected a CSV file as --out beside it, got \"" + options->out + "\", which has binary32 numbers");
    result = run(*options, *subject);
  });
}

}  // namespace forceshade::apps
