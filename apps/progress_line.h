// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How far a long computation is: one line on a terminal's standard error, removed at the end.

#include <chrono>
#include <string>

namespace forceshade::apps {

class ProgressLine {
 public:
  explicit ProgressLine(std::string name);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  // done: in [0, 1]. Draws when the percentage changes, and nothing in the first half second.
  void draw(double done);

 private:
  std::string name_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool is_terminal_;
  int percent_ = -1;
};

}  // namespace forceshade::apps
