// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Progress, interruption and results of a long check.
//
//   std::atomic<bool> stop = false;  // set by a signal handler, or by another thread
//   const Monitor monitor([](double done) { std::printf("%.0f %%\n", 100 * done); }, stop);
//   try {
//     monitor.at(0.5);  // as a long computation does
//   } catch (const Interrupted&) {
//     std::puts("stopped");
//   }
//
// A Monitor is used by one thread at a time; `stop` may be set by any. at() passes on what a report throws.
//
// Not promised: how often a computation reports, and how soon it stops.

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace forceshade {

// The work was interrupted by a signal before it was done. what() names the unfinished work, if known.
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
    // A throw expression would not compile with -fno-exceptions.
    if (stop_ != nullptr && *stop_) std::rethrow_exception(std::make_exception_ptr(Interrupted()));
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

namespace forceshade::properties {

// The result of checking one property of a renderer.
struct PropertyResult {
  std::string name;  // "equivalence", "continuity", "unit normals", "passivity", or that of a further property
  std::uint64_t cases = 0;
  bool held = true;
  std::string counterexample;  // the shrunk one, empty if held
};

// The most energy that simple loops of one depth can give to the hand, and the energy of one of them (docs/energy.md).
struct LoopEnergy {
  double depth_mm = 0;
  std::array<double, 2> bound_mJ{};  // an interval around the supremum
  double witness_mJ = 0;             // around the witness loop by the exact law
  double measured_mJ = 0;            // and by the fast path
};

}  // namespace forceshade::properties
