// SPDX-License-Identifier: BSD-3-Clause
#include "device/real_time.h"

#include <pthread.h>
#include <sys/mman.h>

namespace forceshade::device {
namespace {

std::optional<int> last_of(const cpu_set_t& cpus) noexcept {
  for (int cpu = CPU_SETSIZE; cpu-- > 0;)
    if (CPU_ISSET(cpu, &cpus)) return cpu;
  return std::nullopt;
}

}  // namespace

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

}  // namespace forceshade::device
