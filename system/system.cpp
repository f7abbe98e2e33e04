// SPDX-License-Identifier: BSD-3-Clause
#include "system/system.h"

#include <linux/futex.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <random>
#include <thread>
#include <utility>

#include "system/crash_signals.h"

namespace forceshade::system {
namespace {

std::int64_t read_clock(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

timespec time_of(std::int64_t ns) noexcept {
  return {.tv_sec = ns / kSecond, .tv_nsec = ns % kSecond};
}

std::optional<int> last_of(const cpu_set_t& cpus) noexcept {
  for (int cpu = CPU_SETSIZE; cpu-- > 0;)
    if (CPU_ISSET(cpu, &cpus)) return cpu;
  return std::nullopt;
}

}  // namespace

std::int64_t now() noexcept {
  return read_clock(CLOCK_MONOTONIC);
}

std::int64_t processor_time() noexcept {
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}

std::string date(const char* format) {
  const std::time_t seconds = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[64];
  return {text, std::strftime(text, sizeof text, format, &utc)};
}

std::uint32_t random() {
  return std::random_device{}();
}

bool sleep_until(std::int64_t due) noexcept {
  const timespec time = time_of(due);
  return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != EINTR;
}

void wait_for_change(const Number& number, std::uint32_t seen, std::int64_t deadline) noexcept {
  const timespec until = time_of(deadline);
  syscall(SYS_futex, &number, FUTEX_WAIT_BITSET, seen, deadline == kForever ? nullptr : &until, nullptr,
          FUTEX_BITSET_MATCH_ANY);
}

void wake(const Number& number) noexcept {
  syscall(SYS_futex, &number, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

void step() noexcept {}

struct Thread::Implementation {
  std::thread thread;
};

Thread::Thread() noexcept = default;
Thread::Thread(Thread&& other) noexcept = default;
Thread& Thread::operator=(Thread&& other) noexcept = default;
Thread::~Thread() = default;

Thread::Thread(const char* name, std::function<void()> body) : it_(std::make_unique<Implementation>()) {
  sigset_t masked, before;
  sigfillset(&masked);
  for (const int crash : kCrashSignals) sigdelset(&masked, crash);
  pthread_sigmask(SIG_SETMASK, &masked, &before);  // the thread inherits it
  try {
    it_->thread = std::thread(std::move(body));
  } catch (...) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    throw;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_setname_np(it_->thread.native_handle(), name);
}

void Thread::join() noexcept {
  it_->thread.join();
  it_.reset();
}

void Thread::leave() noexcept {
  it_->thread.detach();
  it_.reset();
}

RealTime::RealTime(std::optional<int> cpu, int priority) noexcept {
  const pthread_t self = pthread_self();
  pthread_getschedparam(self, &old_policy_, &old_parameters_);
  const sched_param parameters{.sched_priority = priority};
  granted_.scheduling = pthread_setschedparam(self, SCHED_FIFO, &parameters) == 0;
  granted_.memory_locked = mlockall(MCL_CURRENT) == 0;

  if (pthread_getaffinity_np(self, sizeof old_cpus_, &old_cpus_) != 0) return;
  if (!cpu) cpu = last_of(old_cpus_);
  if (!cpu || *cpu < 0 || *cpu >= CPU_SETSIZE) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(*cpu, &one);
  if (pthread_setaffinity_np(self, sizeof one, &one) == 0) granted_.cpu = cpu;
}

RealTime::~RealTime() {
  if (granted_.cpu) pthread_setaffinity_np(pthread_self(), sizeof old_cpus_, &old_cpus_);
  if (granted_.memory_locked) munlockall();
  if (granted_.scheduling) pthread_setschedparam(pthread_self(), old_policy_, &old_parameters_);
}

std::optional<int> processor_before_last() noexcept {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return std::nullopt;
  const std::optional<int> last = last_of(allowed);
  if (!last) return std::nullopt;
  CPU_CLR(*last, &allowed);
  const std::optional<int> before = last_of(allowed);
  return before ? before : last;
}

}  // namespace forceshade::system
