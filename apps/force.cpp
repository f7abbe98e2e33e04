// SPDX-License-Identifier: BSD-3-Clause
// forceshade force: the force at every position of a CSV, by the fast path or by the reference.

#include <iostream>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/csv/csv.h"
#include "forceshade/csv/output_file.h"
#include "forceshade/fast/law.h"
#include "forceshade/reference/law.h"

namespace forceshade::apps {
namespace {

struct Options {
  std::string path = "fast", input = "-", output = "-";
  unsigned digits = 30;
};

const char* word(Status status) {
  return status == Status::contact ? "ok" : status == Status::free ? "free" : "invalid";
}

// Calls answer(position, out), which writes fx,fy,fz,status, for each row.
template <class Answer>
void for_each_row(std::istream& in, const std::string& file, std::ostream& out, const Answer& answer) {
  csv::Reader rows(in, file, {"x_mm", "y_mm", "z_mm"});
  out << "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n";
  while (rows.next()) {
    if (interrupted()) throw BadInput("interrupted: no output file was written");
    const Eigen::Vector3f position(rows.binary32(0), rows.binary32(1), rows.binary32(2));
    for (const float coordinate : position) out << csv::shortest(coordinate) << ',';
    answer(position, out);
    out << '\n';
  }
}

void run(const Options& options, const LawOptions& law_options) {
  watch_for_interrupt();
  std::ios::sync_with_stdio(false);
  std::ifstream file;
  if (options.input != "-") file = csv::open_input(options.input);
  std::istream& in = options.input == "-" ? std::cin : file;
  const std::string name = options.input == "-" ? "standard input" : options.input;
  const Parameters parameters = law_options.parameters();
  csv::OutputFile output(options.output);
  if (options.path == "fast") {
    const auto law = std::get<fast::Law>(fast::Law::build(law_options.law(), parameters));
    for_each_row(in, name, output.stream(), [&](const Eigen::Vector3f& position, std::ostream& out) {
      const fast::Evaluation answer = law.evaluate(position);
      for (const float component : answer.force) out << csv::shortest(component) << ',';
      out << word(answer.status);
    });
  } else {
    const auto law = std::get<reference::Law>(reference::Law::build(law_options.law(), parameters));
    for_each_row(in, name, output.stream(), [&](const Eigen::Vector3f& position, std::ostream& out) {
      const reference::DecimalForce answer = law.decimal(position, options.digits);
      out << answer.x << ",0," << answer.z << ',' << word(answer.status);
    });
  }
  output.commit();
}

}  // namespace

void add_force(CLI::App& app, int&) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("force", "Read positions as CSV (x_mm, y_mm, z_mm), write forces as CSV");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one, LawOptions::Defaults::none);
  command->add_option("--path", options->path, "fast: binary32, shortest form; reference: exact, to N digits")
      ->check(CLI::IsMember({"fast", "reference"}))
      ->capture_default_str();
  command->add_option("--digits", options->digits, "significant decimal digits of the reference")
      ->type_name("N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--input", options->input, "CSV file, - for standard input")->type_name("FILE")->capture_default_str();
  command->add_option("--output", options->output, "CSV file, - for standard output")->type_name("FILE")->capture_default_str();
  command->callback([options, law] { run(*options, *law); });
}

}  // namespace forceshade::apps
