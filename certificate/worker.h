// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Works on the units of a plan's folder until all are done, beside however many other processes.

#include <atomic>
#include <cstdint>
#include <functional>

#include "certificate/plan_folder.h"
#include "forceshade/certify.h"

namespace forceshade::properties {

struct WorkerOptions {
  unsigned threads = 1;
  double lease = 300;  // s
  bool waits = true;   // for units that others have taken, so that those of one that was lost are done
};

// result(unit): its text; empty where `stop` was set in the meantime. progress(units that are known to be done) from one thread
// at a time. Rethrows what a thread threw, when every claim was given back.
Worked work_through(const PlanFolder& folder, Claims& claims, const WorkerOptions& options,
                    const std::function<std::string(std::uint64_t)>& result, const std::function<void(const Worked&)>& progress,
                    const std::atomic<bool>& stop);

}  // namespace forceshade::properties
