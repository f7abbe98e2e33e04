// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calls of a library that may not return: each runs in a thread of its own, and is waited for no longer than its deadline.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "system/system.h"

namespace forceshade::device {

class TimedCalls {
 public:
  TimedCalls();
  // Does not wait for a call that has not returned. Its thread then ends with the process, or once it returns.
  ~TimedCalls();
  TimedCalls(const TimedCalls&) = delete;
  TimedCalls& operator=(const TimedCalls&) = delete;

  // Runs the call, after all those before it and in the same thread, and throws what it throws. False where it has not returned
  // by then: it may return later, so what it refers to must live as long as the call itself; and until it has, every further
  // call is late, too, and is not run.
  bool run_until(std::int64_t deadline, std::function<void()> call);
  bool run(std::function<void()> call, std::chrono::nanoseconds longest) {
    return run_until(system::now() + system::in_ns(longest), std::move(call));
  }

 private:
  struct Shared;
  bool is_free_before(std::int64_t deadline) const noexcept;

  std::shared_ptr<Shared> shared_;
  system::Thread thread_;
};

}  // namespace forceshade::device
