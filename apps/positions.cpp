// SPDX-License-Identifier: BSD-3-Clause
// forceshade positions: where to ask a renderer for forces, for programs that write forces beside them.

#include <iostream>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "properties/conformance/case_file.h"

namespace forceshade::apps {
namespace {

struct PositionsOptions {
  std::uint64_t points = 100000, seed = 1;
  std::string out = "-";
};

int run(const PositionsOptions& options, const SubjectOption& option) {
  watch_for_interrupt();
  const auto subject = option.subject();
  files::OutputFile output(options.out);
  ProgressLine line(subject->identity().name);
  const Monitor monitor([&](double done) { line.draw(done); }, interrupted());
  conformance::write_positions(output.stream(), files::is_named_npy(options.out), *subject, options.points, options.seed,
                               monitor);
  output.commit();
  return kHeld;
}

}  // namespace

void add_positions(CLI::App& app, int& result) {
  const auto options = std::make_shared<PositionsOptions>();
  CLI::App* command =
      app.add_subcommand("positions", "Write positions at which to ask a renderer for forces, each with what it is aimed at");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  add_whole(*command, "--points", options->points, "number of positions", {1, 1000000000});
  add_whole(*command, "--seed", options->seed, "seed of the positions", kSeeds);
  add_output(*command, "--out", options->out,
             "FILE.npy, a structured array for numpy.load; else a CSV file, - is standard output", {".csv", ".npy"})
      ->capture_default_str();
  command->callback([options, subject, &result] { result = run(*options, *subject); });
}

}  // namespace forceshade::apps
