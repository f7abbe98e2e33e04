// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The progress of a long computation on standard error: on a terminal a line that is drawn over itself and removed at the end;
// elsewhere a line each minute, so that a log shows that it goes on and for how long.

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "apps/signals.h"
#include "forceshade/checks.h"

namespace forceshade::apps {

class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ProgressLine(std::string name);
  // For tests: another clock, and what standard error is.
  ProgressLine(std::string name, bool is_terminal, std::function<Clock::time_point()> now);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  // done: in [0, 1]; that of the first call is what an earlier run had done. details: more words, for instance the rate. Draws
  // nothing in the first half second.
  void draw(double done, const std::string& details = "");

 private:
  std::string words(double done, const std::string& details) const;

  std::string name_;
  bool is_terminal_;
  std::function<Clock::time_point()> now_;
  Clock::time_point start_, drawn_;
  std::optional<double> begun_;  // done when the first call came
  std::string shown_;            // on the terminal
};

// Returns check(monitor), whose progress a line of this name draws; a signal that is to end the work ends it by Interrupted.
template <class Check>
auto with_progress(const std::string& name, const Check& check) {
  ProgressLine line(name);
  return check(Monitor([&](double done) { line.draw(done); }, interrupted()));
}

// The time that each part of a check takes, from the calls that report its progress.

class PartTimes {
 public:
  // The time since the last call, or since this was made, belongs to this part of this subject. From any thread.
  void add(const std::string& subject, const std::string& part) {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    seconds_[{subject, part}] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  // 0 of a part that was never reported.
  double seconds(const std::string& subject, const std::string& part) const {
    const auto found = seconds_.find({subject, part});
    return found == seconds_.end() ? 0 : found->second;
  }

 private:
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::map<std::pair<std::string, std::string>, double> seconds_;
};

}  // namespace forceshade::apps
