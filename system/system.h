// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time, waiting, threads and luck: the only place where the code of devices, recordings and sessions asks the operating system
// for them. The functions are chosen at the link: system.cpp calls Linux, tests/world/world.cpp a simulated world in which a
// test decides what happens when. So the objects that ship are those that are tested. All times are in ns.

#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace forceshade::system {

inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::int64_t kForever = INT64_MAX;
inline constexpr std::int64_t in_ns(std::chrono::nanoseconds time) noexcept {
  return time.count();
}

// CLOCK_MONOTONIC, the one clock of all processes. A signal handler may call it.
std::int64_t now() noexcept;

// The time that this thread has computed, whoever else had the processor meanwhile.
std::int64_t processor_time() noexcept;

// The date in UTC, for names and records; nothing is decided by it. The format is that of strftime().
std::string date(const char* format = "%Y-%m-%dT%H:%M:%SZ");

// A number that cannot be foreseen.
std::uint32_t random();

// False where a signal ended the sleep early.
bool sleep_until(std::int64_t due) noexcept;
inline bool sleep_for(std::chrono::nanoseconds time) noexcept {
  return sleep_until(now() + in_ns(time));
}

// A number that threads wait for, also those of two processes that map it.
using Number = std::atomic<std::uint32_t>;

// Waits until the number is another than `seen`, the deadline is over, or a signal comes; the caller looks which.
void wait_for_change(const Number& number, std::uint32_t seen, std::int64_t deadline) noexcept;
// Wakes one thread that waits for this number, after it was changed.
void wake(const Number& number) noexcept;

// Does nothing. It stands before each access to what two threads share, and there a simulated world lets another thread go on.
void step() noexcept;

// A thread that takes no signals but those of its own crash: the others are for the program's first thread.
class Thread {
 public:
  Thread() noexcept;
  // name: at most 15 characters, for the tools that list threads.
  Thread(const char* name, std::function<void()> body);
  Thread(Thread&& other) noexcept;
  Thread& operator=(Thread&& other) noexcept;
  // The thread was joined or left before.
  ~Thread();

  bool is_joinable() const noexcept { return it_ != nullptr; }
  // Waits for its end.
  void join() noexcept;
  // Lets it go on alone.
  void leave() noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

// Takes what the system grants a thread that must not be late, for as long as it lives, and gives it back.
class RealTime {
 public:
  // Above the interrupt threads of a real-time kernel (50), below its watchdogs (99).
  static constexpr int kPriority = 80;
  // A device's frames come before the servo loop: each takes some µs, and one that is late holds an old force.
  static constexpr int kFramesPriority = kPriority + 5;

  struct Granted {
    bool scheduling = false;  // SCHED_FIFO
    bool memory_locked = false;
    std::optional<int> cpu;  // the one that the thread is pinned to
  };

  // Pins to this processor; without one, to the last that the thread may run on, since the first serves most interrupts.
  explicit RealTime(std::optional<int> cpu, int priority = kPriority) noexcept;
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  const Granted& granted() const noexcept { return granted_; }

 private:
  int old_policy_ = SCHED_OTHER;
  sched_param old_parameters_{};
  cpu_set_t old_cpus_{};
  Granted granted_;
};

// For a device's frames: another processor than the servo loop's, which is the last, where there are two.
std::optional<int> processor_before_last() noexcept;

}  // namespace forceshade::system
