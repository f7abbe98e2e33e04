// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform positions and judge: positions and forces as files, for programs in whose place anybody can be.

#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/conform_outputs.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/standard_input.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "properties/conformance/case_file.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/vectors.h"

namespace forceshade::apps {
namespace {

constexpr std::uint64_t kPositions = 100000, kVectors = 200, kMostVectors = 1000000;

using Rate = std::optional<double>;  // Hz

struct Positions {
  std::optional<std::uint64_t> points;
  std::uint64_t seed = 1;
  Rate rate;
  std::string out = "-";
};

void add_rate(CLI::App& command, Rate& rate) {
  add_number(command, "--rate", "periods in a second, with damping", {1, 131072}, [&rate](double given) { rate = given; });
}

// Damping behind the subject; none where it has none. Throws Error.
std::optional<damping::Parameters> damping_of(const Description& description, const Rate& rate) {
  if (description.damping.parameters.is_off()) return std::nullopt;
  if (!rate) throw Error("--rate: expected the periods in a second with damping, whose forces depend on them");
  const damping::Parameters parameters = description.damping.at(*rate);
  const auto built = reference::Damping::build(parameters);
  if (const auto* error = std::get_if<ParameterError>(&built)) throw Error("--damping: " + error->message());
  return parameters;
}

int write(const Positions& its, const SubjectOption& subject) {
  watch_for_interrupt();
  const Description description = subject.description();
  const bool has_forces = files::format_ending(its.out) == ".json";
  const std::uint64_t points = its.points.value_or(has_forces ? kVectors : kPositions);
  if (has_forces && points > kMostVectors)
    throw Error("--points: expected at most " + std::to_string(kMostVectors) + " with their forces, got " +
                std::to_string(points));
  const auto damping = damping_of(description, its.rate);
  files::OutputFile output(its.out);
  with_progress(description.name, [&](const Monitor& monitor) {
    if (has_forces)
      output.stream() << conformance::vectors_of(description, points, its.seed, monitor, damping);
    else
      conformance::write_positions(output.stream(), files::is_named_npy(its.out), *properties::subject_of(description), points,
                                   its.seed, damping.has_value(), monitor);
  });
  output.commit();
  return kHeld;
}

int judge(const std::string& forces, const conformance::Tolerance& tolerance, const SubjectOption& option, const Rate& rate,
          const ConformOutputs& outputs) {
  outputs.expect_room();
  watch_for_interrupt();
  const Description description = option.description();
  const auto damping = damping_of(description, rate);
  const std::shared_ptr<const properties::Subject> subject = properties::subject_of(description);
  conformance::Judge judge(subject, tolerance, 0, damping);
  InputFile input(forces, files::open_file);
  conformance::read_cases(input.stream(), input.name(), [&](const conformance::Case& its) {
    if (interrupted()) throw Interrupted("not all forces were compared, and nothing was written");
    judge.add(its);
  });
  const conformance::Judgement& found = judge.judgement();
  const Identity& identity = subject->identity();
  const std::string words = words_of(found, identity, tolerance);
  auto json = json_of(found, identity, tolerance);
  if (damping) json["damping"] = conformance::json_of(*damping);
  return outputs.write({found.held(),
                        words,
                        json,
                        {},
                        {"tolerance", conformance::words_of(tolerance)},
                        {case_of_forces(identity.name, found, words)}});
}

}  // namespace

void add_conform_positions(CLI::App& conform, int& result) {
  const auto options = std::make_shared<Positions>();
  CLI::App* command = conform.add_subcommand(
      "positions", "Write positions at which to ask a renderer for forces; or, as test vectors, with the exact forces");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one, true);
  add_whole(*command, "--points",
            "number of positions; default: " + std::to_string(kPositions) + ", with forces " + std::to_string(kVectors),
            {1, 1000000000}, [options](std::uint64_t given) { options->points = given; });
  add_whole(*command, "--seed", options->seed, "seed of the positions", kSeeds);
  add_rate(*command, options->rate);
  add_output(*command, "--out", options->out,
             "FILE.json: test vectors, for tests that need nothing else; FILE.npy, a structured array for numpy.load, or a CSV "
             "file, - for standard output: positions with what each is aimed at",
             {".csv", ".npy", ".json"})
      ->capture_default_str();
  command->callback([options, subject, &result] { result = write(*options, *subject); });
}

void add_conform_judge(CLI::App& conform, int& result) {
  struct Options {
    std::string forces, tolerance;
    Rate rate;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      conform.add_subcommand("judge", "Compare the forces that any program wrote beside positions with the exact ones");
  command
      ->add_option("forces", options->forces,
                   "CSV or NPY file with x_mm, y_mm, z_mm, fx_N, fy_N, fz_N, and reset, aim and periods where positions wrote "
                   "them; - is CSV on standard input")
      ->type_name("FILE")
      ->required();
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one, true);
  add_rate(*command, options->rate);
  add_tolerance(*command, options->tolerance);
  const auto outputs = std::make_shared<ConformOutputs>(*command, false);
  command->callback([options, subject, outputs, &result] {
    result = judge(options->forces, parse_tolerance(options->tolerance), *subject, options->rate, *outputs);
  });
}

}  // namespace forceshade::apps
