// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The record of a run. A recording, FILE.fsr, is written while the loop runs; a table, CSV or
// NPY, is a recording, kept beside it until the run is over and then exported, so that no run is too long for it.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "forceshade/recording.h"

namespace forceshade::run {

class Record {
 public:
  // `path` ends in .fsr, or is a table (recorder::export_table). A run that is not paced waits for the disk instead of losing
  // ticks. A recording that is there already is refused, or where `replaces` goes now, unless another process writes it. Throws
  // Error or files::OutputError.
  Record(std::string path, recorder::Metadata metadata, bool paced, bool replaces);

  // A recording that was never closed is of a run that never began, and goes; one that could not be exported is kept, and
  // close() named it.
  ~Record();
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  device::SampleSink& sink() { return *recorder_; }

  // Call once, when the run is over. Why some ticks were not written, each reason a line; none where all were.
  std::vector<std::string> close(const std::string& end_reason);

 private:
  bool is_table() const { return files::format_ending(path_) != ".fsr"; }
  std::string recording() const { return is_table() ? directory_ / "run.fsr" : std::filesystem::path(path_); }

  std::string path_;
  std::filesystem::path directory_;  // of the recording behind a table
  std::optional<recorder::Recorder> recorder_;
  bool closed_ = false, kept_ = false;
};

}  // namespace forceshade::run
