// SPDX-License-Identifier: BSD-3-Clause
// forceshade record: what a recording says of itself, whether it is whole, and its ticks for other programs.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/csv/printable.h"
#include "forceshade/recorder/export.h"
#include "forceshade/recorder/recording.h"

namespace forceshade::apps {
namespace {

struct Options {
  std::string file, csv, npy, json;
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

int info(const Options& options) {
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

int verify(const Options& options) {
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

int write(const Options& options) {
  if (options.csv.empty() && options.npy.empty()) throw BadInput("expected --csv FILE or --npy FILE, got neither");
  if (options.csv == options.npy) throw BadInput("--csv and --npy: expected two files, got \"" + options.csv + "\" for both");
  recorder::Recording recording(options.file);
  if (!options.csv.empty()) export_csv(recording, options.csv);
  if (!options.npy.empty()) export_npy(recording, options.npy);
  if (!recording.ended()) complain(options.file + ": the recording has no end: cut off, or still being made");
  return kHeld;
}

}  // namespace

void add_record(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand("record", "Look into, check and export what drive recorded");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, int (*run)(const Options&)) {
    const auto options = std::make_shared<Options>();
    CLI::App* verb = command->add_subcommand(name, help);
    verb->add_option("file", options->file, "a recording, FILE.fsr")->type_name("FILE")->required();
    verb->callback([options, run, &result] { result = run(*options); });
    return std::pair(verb, options);
  };
  const auto [info_verb, info_options] = add("info", "What was recorded, with what", info);
  info_verb->add_option("--json", info_options->json, "for programs, - for standard output")->type_name("FILE");
  add("verify", "Whether it is whole: 0 if so, 1 if cut off, damaged or with ticks missing", verify);
  const auto [export_verb, export_options] = add("export", "The ticks for other programs", write);
  export_verb->add_option("--csv", export_options->csv, "CSV, - for standard output")->type_name("FILE");
  export_verb->add_option("--npy", export_options->npy, "NPY, a structured array for numpy.load")->type_name("FILE");
}

}  // namespace forceshade::apps
