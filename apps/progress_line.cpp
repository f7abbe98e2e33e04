// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/progress_line.h"

#include <unistd.h>

#include <utility>

#include "forceshade/apps/live_line.h"

namespace forceshade::apps {

ProgressLine::ProgressLine(std::string name) : name_(std::move(name)), is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (percent_ >= 0) draw_line("");
}

void ProgressLine::draw(double done) {
  const int percent = static_cast<int>(100 * done);
  if (!is_terminal_ || percent == percent_) return;
  if (std::chrono::steady_clock::now() - start_ < std::chrono::milliseconds(500)) return;
  percent_ = percent;
  draw_line(std::to_string(percent) + " %  Ctrl-C stops  " + name_);
}

}  // namespace forceshade::apps
