// SPDX-License-Identifier: BSD-3-Clause
// forceshade conform recording: what another system did, judged.

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "apps/command.h"
#include "apps/conform_outputs.h"
#include "apps/options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "files/quantity.h"
#include "forceshade/certificate.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/recordings/columns.h"
#include "properties/conformance/recordings/judged_recording.h"
#include "properties/conformance/recordings/recording_text.h"
#include "report/conformance/page.h"

namespace forceshade::apps {
namespace {

struct RecordingOptions {
  std::string file, columns, frame, offset, tolerance;
  conformance::RecordingOptions judged;
};

// Reads "0.02N", "1mJ" or both.
void allow(const std::string& text, conformance::RecordingOptions& options) {
  for (const std::string& part : files::at_commas(text)) {
    const std::size_t unit = part.find_last_not_of("NmJ ") + 1;
    const std::string number = part.substr(0, unit),
                      name = part.substr(std::min(part.find_first_not_of(' ', unit), part.size()));
    if (name != "N" && name != "mJ")
      throw Error("--allow: expected an error in N, an energy in mJ or both, such as 0.02N,1mJ, got \"" + text + '"');
    (name == "N" ? options.noise : options.energy) = parse_number("--allow", number, {0, name == "N" ? 1000.0 : 1e6});
  }
}

int judge(const RecordingOptions& its, const SubjectOption& subject, const ConformOutputs& outputs,
          const std::string& repeated) {
  conformance::RecordingOptions options = its.judged;
  if (options.fits && !subject.is_given())
    throw Error("--fit: expected " + subjects::words_of_kinds("or") + " with it, got none");
  if (options.fits && its.tolerance.empty())
    throw Error("--tolerance: expected one in N or % beside --fit, since a fitted force is never correctly rounded");
  options.tolerance = parse_tolerance(its.tolerance);
  if (!its.frame.empty()) options.turn = conformance::turn_of_frame(its.frame);
  if (!its.offset.empty()) options.offset = conformance::offset_of(its.offset);
  outputs.expect_room();
  watch_for_interrupt();
  std::ifstream file = files::open_file(its.file);
  const conformance::Measurements measured =
      conformance::read_measurements(file, its.file, conformance::columns_of(its.columns));
  std::optional<Description> description;
  if (subject.is_given()) description = subject.description();
  if (description && description->moves())
    throw Error(description->name +
                ": expected no object with a motion, since a recording does not say in which tick it began");
  const conformance::JudgedRecording found = with_progress(
      its.file, [&](const Monitor& monitor) { return conformance::judge_recording(measured, description, options, monitor); });
  const std::string words = conformance::words_of(found, options.tolerance);
  std::vector<JunitCase> cases;
  if (found.fit) cases.push_back({found.file, "fit", 0, found.fit->refusal, words});
  if (found.comparison) cases.push_back(case_of_forces(found.file, found.comparison->judgement, words));
  add_cases(cases, found.file, found.invariants);
  return outputs.write({found.held(),
                        words,
                        conformance::json_of(found, options.tolerance),
                        [&](properties::Pictures shown) {
                          return conformance::to_html(found, options.tolerance, properties::current_build().version, repeated,
                                                      shown);
                        },
                        {"tolerance", conformance::words_of(options.tolerance)},
                        cases});
}

}  // namespace

void add_conform_recording(CLI::App& conform, int& result) {
  const auto its = std::make_shared<RecordingOptions>();
  CLI::App* command = conform.add_subcommand(
      "recording", "Check what another system did: its forces beside the exact ones, and what must hold of any");
  command->add_option("recording", its->file, "a CSV file of times, positions and forces, or rows of numbers without a header")
      ->type_name("FILE")
      ->required()
      ->group(kEvidenceGroup);
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::one);
  command->option_defaults()->group(kEvidenceGroup);
  const auto add = [&](const char* name, std::string& value, const char* type, const std::string& help) {
    command->add_option(name, value, help)->type_name(type);
  };
  add("--columns", its->columns, "t=NAME,x=NAME,...,ms,m,mN",
      "its columns, t, x, y, z, fx, fy and fz by their names, or by their numbers where it has no header; those of 'recording "
      "export' unless given. And the units of its times (s, ms, us, ns), positions (mm, cm, m, in) and forces (N, mN), where "
      "the names do not end in them");
  add("--frame", its->frame, "x,z,-y", "the axes of the scene that its first, second and third ones are");
  command->add_flag(
      "--fit", its->judged.fits,
      "find the stiffness, the shift and, where they are not given, the turn (--frame), the offset and the lag that "
      "explain its forces best");
  add("--offset", its->offset, "X,Y,Z", "the reading of its sensor without a force, in N along its axes");
  add_number(*command, "--lag", "by how many ms a force comes after its position", {-1000, 1000},
             [its](double milliseconds) { its->judged.lag = milliseconds / 1000; });
  command
      ->add_option_function<std::string>(
          "--allow", [its](const std::string& text) { allow(text, its->judged); },
          "the largest error of a measured force and the most that a loop may give the hand; default: 0N,0mJ")
      ->type_name("0.02N,1mJ");
  add_tolerance(*command, its->tolerance);
  const auto outputs = std::make_shared<ConformOutputs>(*command);
  command->callback(
      [its, subject, outputs, command, &result] { result = judge(*its, *subject, *outputs, repeated(*command)); });
}

}  // namespace forceshade::apps
