// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/timed_calls.h"

#include <pthread.h>

#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <utility>

#include "device/real_time.h"

namespace forceshade::device {

struct TimedCalls::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> call;  // empty: there is none
  std::exception_ptr thrown;
  bool is_over = false;

  void serve() {
    const RealTime real_time(processor_before_last(), RealTime::kFramesPriority);
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return call || is_over; });
      if (!call) return;
      lock.unlock();
      std::exception_ptr caught;
      try {
        call();
      } catch (...) {
        caught = std::current_exception();
      }
      lock.lock();
      thrown = caught;
      call = nullptr;
      changed.notify_all();
    }
  }
};

TimedCalls::TimedCalls() : shared_(std::make_shared<Shared>()) {
  // Signals are for the thread that waits for frames.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([shared = shared_] { shared->serve(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TimedCalls::~TimedCalls() {
  bool returns = false;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->is_over = true;
    returns = !shared_->call;
  }
  shared_->changed.notify_all();
  if (returns)
    thread_.join();
  else
    thread_.detach();
}

bool TimedCalls::run(std::function<void()> call, std::chrono::nanoseconds longest) {
  const auto deadline = std::chrono::steady_clock::now() + longest;
  std::unique_lock lock(shared_->mutex);
  const auto is_free = [&] { return !shared_->call; };
  if (!shared_->changed.wait_until(lock, deadline, is_free)) return false;
  shared_->call = std::move(call);
  shared_->changed.notify_all();
  if (!shared_->changed.wait_until(lock, deadline, is_free)) return false;
  if (const std::exception_ptr thrown = std::exchange(shared_->thrown, nullptr)) std::rethrow_exception(thrown);
  return true;
}

}  // namespace forceshade::device
