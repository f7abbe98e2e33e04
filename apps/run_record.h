// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What --record names. A recording, FILE.fsr, is written while the loop runs; a table, CSV or
// NPY, is a recording, kept beside it until the run is over and then exported, so that no run is too long for it.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "forceshade/apps/output_options.h"
#include "forceshade/recorder/recorder.h"

namespace forceshade::apps {

class RunRecord {
 public:
  // `path` ends in .fsr, or is a table (recorder::export_table). A run that is not paced waits for the disk instead of losing
  // ticks. A recording that is there already is refused, or where `replaces` goes now. Throws RecordingError or
  // csv::OutputError.
  RunRecord(std::string path, recorder::Metadata metadata, bool paced, bool replaces);

  // A recording that was never closed is of a run that never began, and goes; one that could not be exported is kept, and its
  // name was said.
  ~RunRecord();
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;

  device::SampleSink& sink() { return *recorder_; }

  // Call once, when the run is over. Whether every tick was written; says so on standard error where not.
  bool close(const std::string& end_reason);

 private:
  bool is_table() const { return format_ending(path_) != ".fsr"; }
  std::string recording() const { return is_table() ? directory_ / "run.fsr" : std::filesystem::path(path_); }

  std::string path_;
  std::filesystem::path directory_;  // of the recording behind a table
  std::optional<recorder::Recorder> recorder_;
  bool closed_ = false, kept_ = false;
};

}  // namespace forceshade::apps
