// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The time that each part of a check takes, from the calls that report its progress.

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace forceshade::apps {

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
