// SPDX-License-Identifier: BSD-3-Clause
// forceshade recording: what a recording says of itself, whether it is whole, and its ticks for other programs.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/apps/output_options.h"
#include "forceshade/csv/printable.h"
#include "forceshade/recorder/export.h"
#include "forceshade/recorder/recording.h"

namespace forceshade::apps {
namespace {

struct RecordOptions {
  std::string file, out = "-", json;
};

void complain(const std::string& words) {
  std::fprintf(stderr, "forceshade: %s\n", csv::printable(words).c_str());
}

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
  if (result == kFailed) complain(recording.path() + ": " + recording.metadata_problem());
  // What is not ASCII is escaped, and what is not UTF-8 replaced, so that the text is JSON and shown by any terminal.
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
      std::printf("%-20s %s\n", csv::printable(key).c_str(), csv::printable(value).c_str());
  if (!recording.ended()) std::printf("%-20s no: cut off, or still being made\n", "ended");
  return result;
}

int verify(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  const std::vector<std::string> problems = problems_of(recording);
  for (const std::string& problem : problems) complain(problem);
  if (!problems.empty()) return kFailed;
  std::printf("whole: %llu samples, every tick and every checksum%s\n",
              static_cast<unsigned long long>(recording.extent().samples),
              recording.has_digest() ? ", and the metadata"
                                     : "; format 2 has no checksum of the metadata: that the law, its parameters, the "
                                       "certificate and the device are those of the run cannot be verified");
  return kHeld;
}

int write(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  options.out.ends_with(".npy") ? export_npy(recording, options.out) : export_csv(recording, options.out);
  if (!recording.ended()) complain(options.file + ": the recording has no end: cut off, or still being made");
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
  const auto [info_verb, info_options] = add("info", "What was recorded, with what", info);
  add_json(*info_verb, info_options->json, "the same");
  add("verify", "Whether it is whole: 0 if so, 1 if cut off, damaged or with ticks missing", verify);
  const auto [export_verb, export_options] = add("export", "The ticks for other programs", write);
  add_output(*export_verb, "--out", export_options->out,
             "FILE.npy, a structured array for numpy.load; else its CSV, - for standard output")
      ->capture_default_str();
}

}  // namespace forceshade::apps
