// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform positions, judge and vectors: positions and forces as files, for programs in whose place anybody can be.

#include <iostream>
#include <memory>

#include "apps/command.h"
#include "apps/conform_outputs.h"
#include "apps/conform_verbs.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "properties/conformance/case_file.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/vectors.h"

namespace forceshade::apps {
namespace {

// A verb that writes positions of a subject. write(options, description, stream, monitor).
struct Positions {
  std::uint64_t points, seed = 1;
  std::string out = "-";
};

template <class Write>
void add_writer(CLI::App& command, std::uint64_t points, std::uint64_t most, const std::string& help,
                const std::vector<std::string>& endings, int& result, const Write& write) {
  const auto options = std::make_shared<Positions>(Positions{points});
  const auto subject = std::make_shared<SubjectOption>(command, subjects::Laws::one);
  add_whole(command, "--points", options->points, "number of positions", {1, most});
  add_whole(command, "--seed", options->seed, "seed of the positions", kSeeds);
  add_output(command, "--out", options->out, help, endings)->capture_default_str();
  command.callback([options, subject, write, &result] {
    watch_for_interrupt();
    const Description description = subject->description();
    files::OutputFile output(options->out);
    with_progress(description.name, [&](const Monitor& monitor) { write(*options, description, output.stream(), monitor); });
    output.commit();
    result = kHeld;
  });
}

int judge(const std::string& forces, const conformance::Tolerance& tolerance, const SubjectOption& option,
          const ConformOutputs& outputs) {
  outputs.expect_room();
  watch_for_interrupt();
  const auto subject = option.subject();
  conformance::Judge judge(subject, tolerance);
  std::ifstream file;
  if (forces != "-") file = files::open_file(forces);
  conformance::read_cases(forces == "-" ? std::cin : file, forces == "-" ? "standard input" : forces,
                          [&](const conformance::Case& its) {
                            if (interrupted()) throw Interrupted("not all forces were compared, and nothing was written");
                            judge.add(its);
                          });
  const conformance::Judgement& found = judge.judgement();
  const Identity& identity = subject->identity();
  const std::string words = words_of(found, identity, tolerance);
  return outputs.write({found.held(),
                        words,
                        json_of(found, identity, tolerance),
                        {},
                        {"tolerance", conformance::words_of(tolerance)},
                        {case_of_forces(identity.name, found, words)}});
}

}  // namespace

void add_conform_positions(CLI::App& conform, int& result) {
  add_writer(*conform.add_subcommand("positions",
                                     "Write positions at which to ask a renderer for forces, each with what it is aimed at"),
             100000, 1000000000, "FILE.npy, a structured array for numpy.load; else a CSV file, - is standard output",
             {".csv", ".npy"}, result,
             [](const Positions& its, const Description& description, std::ostream& stream, const Monitor& monitor) {
               conformance::write_positions(stream, files::is_named_npy(its.out), *properties::subject_of(description),
                                            its.points, its.seed, monitor);
             });
}

void add_conform_vectors(CLI::App& conform, int& result) {
  add_writer(*conform.add_subcommand("vectors",
                                     "Write test vectors: positions with the exact forces, for tests that need nothing else"),
             200, 1000000, "JSON file; - is standard output", {".json"}, result,
             [](const Positions& its, const Description& description, std::ostream& stream, const Monitor& monitor) {
               stream << conformance::vectors_of(description, its.points, its.seed, monitor);
             });
}

void add_conform_judge(CLI::App& conform, int& result) {
  struct Options {
    std::string forces, tolerance;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      conform.add_subcommand("judge", "Compare the forces that any program wrote beside positions with the exact ones");
  command
      ->add_option(
          "forces", options->forces,
          "CSV or NPY file with x_mm, y_mm, z_mm, fx_N, fy_N, fz_N, and reset and aim where positions wrote them; - is "
          "CSV on standard input")
      ->type_name("FILE")
      ->required();
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  add_tolerance(*command, options->tolerance);
  const auto outputs = std::make_shared<ConformOutputs>(*command, false);
  command->callback([options, subject, outputs, &result] {
    result = judge(options->forces, parse_tolerance(options->tolerance), *subject, *outputs);
  });
}

}  // namespace forceshade::apps
