// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// forceshade conform --recording: what another system did, judged.

#include <CLI/CLI.hpp>
#include <string>

#include "apps/subject_option.h"
#include "properties/conformance/recordings/columns.h"
#include "properties/conformance/recordings/judged_recording.h"

namespace forceshade::apps {

// Files for what was found, empty where none is wanted; repeated: the command that repeats the run, for the page.
struct RecordingOutputs {
  std::string out, json, junit, repeated;
};

class RecordingOption {
 public:
  // Adds --recording and the options that go with it.
  explicit RecordingOption(CLI::App& command);

  bool is_given() const { return !file_.empty(); }

  // Judges the recording beside the subject, where one is given; the results go to the files or standard output. Returns the
  // exit code. tolerance: as it was given; empty where it was not.
  int run(const SubjectOption& subject, const std::string& tolerance, const RecordingOutputs& outputs) const;

 private:
  std::string file_, columns_, frame_, offset_;
  conformance::Units units_;
  conformance::RecordingOptions options_;
};

}  // namespace forceshade::apps
