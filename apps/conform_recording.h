// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// forceshade conform --recording: what another system did, judged.

#include <CLI/CLI.hpp>
#include <string>

#include "apps/subject_option.h"
#include "properties/conformance/recordings/columns.h"
#include "properties/conformance/recordings/judged_recording.h"

namespace forceshade::apps {

class RecordingOption {
 public:
  // Adds --recording and the options that go with it.
  explicit RecordingOption(CLI::App& command);

  bool is_given() const { return !file_.empty(); }

  // Judges the recording beside the subject, where one is given; the results go to the files or standard output. Returns the
  // exit code. tolerance: as it was given; empty where it was not.
  int run(const SubjectOption& subject, const std::string& tolerance, const std::string& json, const std::string& junit) const;

 private:
  std::string file_, columns_, frame_;
  conformance::Units units_;
  conformance::RecordingOptions options_;
};

}  // namespace forceshade::apps
