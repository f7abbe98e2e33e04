// SPDX-License-Identifier: BSD-3-Clause
// forceshade recording: what a recording says of itself, whether it is whole, and its ticks for other programs.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/command_check.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/printable.h"
#include "forceshade/checks.h"
#include "forceshade/recording.h"
#include "properties/binary32.h"
#include "run/words.h"

namespace forceshade::apps {
namespace {

struct RecordOptions {
  std::string file, out = "-", json;
};

constexpr std::uint64_t kListed = 10;  // forces that differ

nlohmann::ordered_json described(recorder::Recording& recording) {
  const auto extent = recording.extent();
  return {{"file", recording.path()},
          {"ended", recording.ended()},
          {"samples", extent.samples},
          {"first_tick", extent.first_tick},
          {"last_tick", extent.last_tick},
          {"missing_ticks", extent.missing},
          {"repeated_samples", extent.repeated},
          {"metadata_problem", recording.metadata_problem()},
          {"metadata", recording.metadata()}};
}

int info(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  const int result = recording.metadata_problem().empty() ? kHeld : kFailed;
  if (result == kFailed) tell(recording.path() + ": " + recording.metadata_problem());
  // Characters beyond ASCII are escaped, and other bytes than UTF-8 replaced, so that the text is JSON that any terminal shows.
  if (!options.json.empty())
    write_file(options.json, described(recording).dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  if (options.json == "-") return result;
  const auto extent = recording.extent();
  std::printf("%-20s %llu (ticks %llu to %llu, %llu missing, %llu repeated)\n", "samples",
              static_cast<unsigned long long>(extent.samples), static_cast<unsigned long long>(extent.first_tick),
              static_cast<unsigned long long>(extent.last_tick), static_cast<unsigned long long>(extent.missing),
              static_cast<unsigned long long>(extent.repeated));
  for (const auto& [key, value] : recording.metadata())
    if (key != "samples" && key != "layout")
      std::printf("%-20s %s\n", files::printable(key).c_str(), files::printable(value).c_str());
  if (!recording.ended()) std::printf("%-20s no: cut off, or still being made\n", "ended");
  return result;
}

int verify(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  const std::vector<std::string> problems = problems_of(recording);
  for (const std::string& problem : problems) tell(problem);
  if (!problems.empty()) return kFailed;
  std::printf("whole: %llu samples, every tick and every checksum%s\n",
              static_cast<unsigned long long>(recording.extent().samples),
              recording.has_digest() ? ", and the metadata"
                                     : "; format 2 has no checksum of the metadata: that the law, its parameters, the "
                                       "certificate and the device are those of the run cannot be verified");
  return kHeld;
}

// Computes the forces again from the recorded positions by the definition: 0 if every force is the same.
int recompute(const RecordOptions& options, const SubjectOption& subject_option) {
  recorder::Recording recording(options.file);
  const auto subject = subject_option.subject();
  for (const auto& [key, expected] : run::metadata_of(subject->identity())) {
    const auto found = recording.metadata().find(key);
    if (found == recording.metadata().end() || found->second != expected)
      throw Error(options.file + ": " + key + " is " + (found == recording.metadata().end() ? "not recorded" : found->second) +
                  "; expected " + expected);
  }
  const std::vector<std::string> problems = problems_of(recording);
  for (const std::string& problem : problems) tell(problem);
  if (!problems.empty()) return kFailed;

  watch_for_interrupt();
  ProgressLine line(subject->identity().name);
  const auto reference = subject->open_reference();
  const std::uint64_t all = recording.extent().samples;
  std::uint64_t samples = 0, contacts = 0, differences = 0;
  CommandCheck commands(recording);
  recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
    if (interrupted()) throw Interrupted(options.file + " was not computed to its end");
    for (const device::Sample& sample : chunk) {
      if (sample.status == device::Sample::kEnd) continue;  // the law was not evaluated
      ++samples;
      if (!commands.is_same(sample) && commands.differences() <= kListed)
        tell("tick " + std::to_string(sample.tick) + ": the command is not what supervisor and controller make of the force");
      const auto& [x, y, z] = sample.position;
      const reference::Rounded exact = reference->step({x, y, z});
      const auto& [fx, fy, fz] = sample.law_force;
      const bool is_same =
          finished(exact.status) == finished(sample.law_status()) && (exact.force.array() == Eigen::Array3f(fx, fy, fz)).all();
      contacts += finished(exact.status) == Status::contact ? 1 : 0;
      if (is_same || ++differences > kListed) continue;
      tell("tick " + std::to_string(sample.tick) + ": recorded " + properties::show(Eigen::Vector3f(fx, fy, fz)) +
           " N, expected " + properties::show(exact.force) + " N");
    }
    line.draw(static_cast<double>(samples) / static_cast<double>(std::max<std::uint64_t>(all, 1)));
  });
  std::printf("computed again: %llu ticks, %llu in contact, %llu differ\n", static_cast<unsigned long long>(samples),
              static_cast<unsigned long long>(contacts), static_cast<unsigned long long>(differences));
  if (!commands.why_not().empty())
    std::printf("commands: not computed: %s\n", commands.why_not().c_str());
  else
    std::printf("commands: %llu ticks, %llu changed by supervisor or controller, %llu differ\n",
                static_cast<unsigned long long>(commands.ticks()), static_cast<unsigned long long>(commands.changed()),
                static_cast<unsigned long long>(commands.differences()));
  return differences == 0 && commands.differences() == 0 ? kHeld : kFailed;
}

int write(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  export_table(recording, options.out);
  if (!recording.ended()) tell(options.file + ": the recording has no end: cut off, or still being made");
  return kHeld;
}

}  // namespace

void add_recording(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand("recording", "Look into, check and export what drive recorded");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, int (*run)(const RecordOptions&)) {
    const auto options = std::make_shared<RecordOptions>();
    CLI::App* verb = command->add_subcommand(name, help);
    verb->add_option("file", options->file, "a recording, FILE.fsr")->type_name("FILE")->required();
    verb->callback([options, run, &result] { result = run(*options); });
    return std::pair(verb, options);
  };
  const auto [info_verb, info_options] = add("info", "Print the subject, the device and the settings of a recording", info);
  add_json(*info_verb, info_options->json, "the same");
  add("verify", "Check that it is whole: 0 if so, 1 if cut off, damaged or with ticks missing", verify);
  const auto recomputed = std::make_shared<RecordOptions>();
  CLI::App* again = command->add_subcommand(
      "recompute",
      "Check that every recorded force of a law, height map or mesh is the exact one, rounded, and every command what "
      "supervisor and controller make of it: 0 if so");
  again->add_option("file", recomputed->file, "a recording, FILE.fsr")->type_name("FILE")->required();
  const auto subject = std::make_shared<SubjectOption>(*again, subjects::Laws::one);
  again->callback([recomputed, subject, &result] { result = recompute(*recomputed, *subject); });
  const auto [export_verb, export_options] = add("export", "The ticks for other programs", write);
  add_output(*export_verb, "--out", export_options->out,
             "FILE.npy, a structured array for numpy.load; else its CSV, - for standard output", {".csv", ".npy"})
      ->capture_default_str();
}

}  // namespace forceshade::apps
