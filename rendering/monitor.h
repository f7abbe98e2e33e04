// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Progress reports and cancellation of a long computation.

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace forceshade {

// The work was interrupted by a signal before it was done. what() says what was not done, where whoever throws it knows.
struct Interrupted : std::runtime_error {
  explicit Interrupted(const std::string& undone = "interrupted") : std::runtime_error(undone) {}
};

class Monitor {
 public:
  using Report = std::function<void(double done)>;

  Monitor() = default;  // no reports, no cancellation
  // Reports are made by the thread that computes, up to some thousand a second. `stop` must outlive the monitor.
  Monitor(Report report, const std::atomic<bool>& stop) : report_(std::move(report)), stop_(&stop) {}

  // done: in [0, 1]. Throws Interrupted once stop is set.
  void at(double done) const {
    if (stop_ != nullptr && *stop_) throw Interrupted();
    if (report_) report_(from_ + done * (to_ - from_));
  }

  // A monitor for a part of the computation, which takes it from one share of the whole to another.
  Monitor part(double from, double to) const {
    Monitor monitor = *this;
    monitor.from_ = from_ + from * (to_ - from_);
    monitor.to_ = from_ + to * (to_ - from_);
    return monitor;
  }

 private:
  Report report_;
  const std::atomic<bool>* stop_ = nullptr;
  double from_ = 0, to_ = 1;
};

}  // namespace forceshade
