// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/timed_calls.h"

#include <exception>
#include <utility>

namespace forceshade::device {

// The call belongs to its thread from the moment that it is asked for until it is answered.
struct TimedCalls::Shared {
  system::Number asked = 0, answered = 0;  // calls
  std::atomic<bool> is_over = false;
  std::function<void()> call;  // empty: the thread was woken for its end
  std::exception_ptr thrown;

  bool is_free() const noexcept { return answered == asked; }

  void serve() {
    const system::RealTime real_time(system::processor_before_last(), system::RealTime::kFramesPriority);
    for (std::uint32_t served = 0; !is_over;) {
      system::wait_for_change(asked, served, system::kForever);
      system::step();
      if (asked == served) continue;  // woken by something else
      try {
        if (call) call();
        thrown = nullptr;
      } catch (...) {
        thrown = std::current_exception();
      }
      call = nullptr;
      system::step();
      answered = ++served;
      system::wake(answered);
    }
  }
};

TimedCalls::TimedCalls() : shared_(std::make_shared<Shared>()), thread_("calls", [shared = shared_] { shared->serve(); }) {}

TimedCalls::~TimedCalls() {
  const bool returns = shared_->is_free();
  shared_->is_over = true;
  ++shared_->asked;
  system::wake(shared_->asked);
  if (returns)
    thread_.join();
  else
    thread_.leave();
}

bool TimedCalls::is_free_before(std::int64_t deadline) const noexcept {
  for (;;) {
    system::step();
    const std::uint32_t answered = shared_->answered;
    if (answered == shared_->asked) return true;
    if (system::now() >= deadline) return false;
    system::wait_for_change(shared_->answered, answered, deadline);
  }
}

bool TimedCalls::run_until(std::int64_t deadline, std::function<void()> call) {
  if (!is_free_before(deadline)) return false;
  shared_->call = std::move(call);
  system::step();
  ++shared_->asked;
  system::wake(shared_->asked);
  if (!is_free_before(deadline)) return false;
  if (const std::exception_ptr thrown = std::exchange(shared_->thrown, nullptr)) std::rethrow_exception(thrown);
  return true;
}

}  // namespace forceshade::device
