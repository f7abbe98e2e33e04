// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Of a long computation: how far it is, for somebody who waits for it, and an order to stop.

#include <atomic>
#include <functional>
#include <stdexcept>
#include <utility>

namespace forceshade::reference {

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

class Watch {
 public:
  using Report = std::function<void(double done)>;

  Watch() = default;  // nobody waits, and it is not stopped
  // Reports are made by the thread that computes, some thousand a second. `stop` must outlive it.
  Watch(Report report, const std::atomic<bool>& stop) : report_(std::move(report)), stop_(&stop) {}

  // done: in [0, 1]. Throws Interrupted once stop is set.
  void at(double done) const {
    if (stop_ != nullptr && *stop_) throw Interrupted();
    if (report_) report_(from_ + done * (to_ - from_));
  }

  // For a part of the computation, which takes it from one share of the whole to another.
  Watch part(double from, double to) const {
    Watch watch = *this;
    watch.from_ = from_ + from * (to_ - from_);
    watch.to_ = from_ + to * (to_ - from_);
    return watch;
  }

 private:
  Report report_;
  const std::atomic<bool>* stop_ = nullptr;
  double from_ = 0, to_ = 1;
};

}  // namespace forceshade::reference
