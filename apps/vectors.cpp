// SPDX-License-Identifier: BSD-3-Clause
// forceshade vectors: positions with the exact forces, as JSON.

#include "properties/conformance/vectors.h"

#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/output_file.h"

namespace forceshade::apps {
namespace {

struct VectorsOptions {
  std::uint64_t points = 200, seed = 1;
  std::string out = "-";
};

int run(const VectorsOptions& options, const SubjectOption& option) {
  watch_for_interrupt();
  const Description description = option.description();
  files::OutputFile output(options.out);
  ProgressLine line(description.name);
  const Monitor monitor([&](double done) { line.draw(done); }, interrupted());
  output.stream() << conformance::vectors_of(description, options.points, options.seed, monitor);
  output.commit();
  return kHeld;
}

}  // namespace

void add_vectors(CLI::App& app, int& result) {
  const auto options = std::make_shared<VectorsOptions>();
  CLI::App* command =
      app.add_subcommand("vectors", "Write test vectors: positions with the exact forces, for tests that need nothing else");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  add_whole(*command, "--points", options->points, "number of positions", {1, 1000000});
  add_whole(*command, "--seed", options->seed, "seed of the positions", kSeeds);
  add_output(*command, "--out", options->out, "JSON file; - is standard output", {".json"})->capture_default_str();
  command->callback([options, subject, &result] { result = run(*options, *subject); });
}

}  // namespace forceshade::apps
