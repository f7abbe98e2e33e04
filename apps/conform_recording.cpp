// SPDX-License-Identifier: BSD-3-Clause
#include "apps/conform_recording.h"

#include <optional>
#include <vector>

#include "apps/command.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/page.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/standard_streams.h"
#include "apps/tolerance_option.h"
#include "files/csv.h"
#include "forceshade/certificate.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/recordings/recording_text.h"
#include "properties/conformance/report/page.h"

namespace forceshade::apps {
namespace {

std::vector<JunitCase> junit_cases(const conformance::JudgedRecording& found, const std::string& words) {
  std::vector<JunitCase> cases;
  if (found.fit) cases.push_back({found.file, "fit", 0, found.fit->refusal, words});
  if (found.comparison)
    cases.push_back({found.file, "forces", 0, found.comparison->judgement.held() ? std::nullopt : std::optional(words), words});
  for (const conformance::Invariant& invariant : found.invariants)
    if (!invariant.not_applicable)
      cases.push_back({found.file, invariant.name, 0, invariant.violation, std::to_string(invariant.cases) + " cases"});
  return cases;
}

}  // namespace

RecordingOption::RecordingOption(CLI::App& command) {
  const std::string group = command.option_defaults()->get_group();
  command.option_defaults()->group(kEvidenceGroup);
  CLI::Option* recording =
      command
          .add_option("--recording", file_,
                      "another system's run: a CSV file of times, positions and forces, or rows of numbers without a header")
          ->type_name("FILE");
  const auto add = [&](const char* name, std::string& value, const char* type, const std::string& help) {
    return command.add_option(name, value, help)->type_name(type)->needs(recording);
  };
  add("--columns", columns_, "t=NAME,x=NAME,...",
      "of a recording: its columns, t, x, y, z, fx, fy and fz by their names, or by their numbers where it has no header; "
      "those "
      "of 'recording export' unless given");
  add("--time-unit", units_.time, "s|ms|us|ns", "of a recording, where the column's name does not end in it");
  add("--length-unit", units_.length, "mm|cm|m|in", "the same of its positions");
  add("--force-unit", units_.force, "N|mN", "the same of its forces");
  add("--frame", frame_, "x,z,-y", "of a recording: which axes of the scene its first, second and third ones are");
  command
      .add_flag(
          "--fit", options_.fits,
          "of a recording: find the stiffness, the shift and, where they are not given, the turn (--frame), the offset and "
          "the lag that explain its forces best")
      ->needs(recording);
  add("--offset", offset_, "X,Y,Z", "of a recording: what its sensor reads of no force, in N along its axes");
  add_number(command, "--lag", "of a recording: by how many ms a force comes after its position", {-1000, 1000},
             [this](double milliseconds) { options_.lag = milliseconds / 1000; })
      ->needs(recording);
  add_number(command, "--noise", "of a recording: what a measured force may be off by, in N; 0 unless given", {0, 1000},
             [this](double newtons) { options_.noise = newtons; })
      ->needs(recording);
  add_number(command, "--energy", "of a recording: what a loop may give the hand, in mJ; 0 unless given", {0, 1e6},
             [this](double millijoules) { options_.energy = millijoules; })
      ->needs(recording);
  command.option_defaults()->group(group);
}

int RecordingOption::run(const SubjectOption& subject, const std::string& tolerance, const RecordingOutputs& its) const {
  conformance::RecordingOptions options = options_;
  if (options.fits && !subject.is_given())
    throw BadInput("--fit: expected " + subjects::words_of_kinds("or") + " with it, got none");
  if (options.fits && tolerance.empty())
    throw BadInput("--tolerance: expected one in N or % beside --fit, since a fitted force is never correctly rounded");
  if (!tolerance.empty()) options.tolerance = parse_tolerance(tolerance);
  if (!frame_.empty()) options.turn = conformance::turn_of_frame(frame_);
  if (!offset_.empty()) options.offset = conformance::offset_of(offset_);
  expect_room_for_results(its.json, its.junit);
  expect_folder_of("--out", its.out);
  watch_for_interrupt();
  std::ifstream file = files::open_file(file_);
  const conformance::Measurements measured =
      conformance::read_measurements(file, file_, conformance::columns_of(columns_, units_));
  std::optional<Description> description;
  if (subject.is_given()) description = subject.description();
  if (description && std::holds_alternative<DescribedScene>(description->what))
    throw BadInput(description->name +
                   ": expected no object with a motion, since a recording does not say in which tick it began");
  std::optional<ProgressLine> line(file_);
  const conformance::JudgedRecording found = conformance::judge_recording(
      measured, description, options, Monitor([&](double done) { line->draw(done); }, interrupted()));
  line.reset();
  const std::string words = conformance::words_of(found, options.tolerance);
  if (!its.json.empty()) write_file(its.json, conformance::text_of(conformance::json_of(found, options.tolerance)));
  if (!its.out.empty())
    write_file(its.out, page_of(its.out, [&](properties::Pictures shown) {
                 return conformance::to_html(found, options.tolerance, properties::current_build().version, its.repeated,
                                             shown);
               }));
  if (!its.junit.empty())
    write_file(its.junit, to_junit("forceshade conform", {{"tolerance", conformance::words_of(options.tolerance)}},
                                   junit_cases(found, words)));
  print_beside({its.json, its.junit, its.out}, words);
  return found.held() ? kHeld : kFailed;
}

}  // namespace forceshade::apps
