// SPDX-License-Identifier: BSD-3-Clause
#include "study/command/experiment_virtual.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "apps/command.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "study/apparatus/certificates.h"

namespace forceshade::apps {

int run_virtual(const VirtualOptions& options) {
  watch_for_interrupt();
  for (int number = 1; number <= options.participants; ++number)
    if (const auto session = options.plan.out / ("V" + std::to_string(number)); std::filesystem::exists(session))
      throw Error("--out: expected a folder without a session V" + std::to_string(number) + ", got one that has \"" +
                  session.string() + '"');
  apparatus::VirtualPlan plan = options.plan;
  if (!options.certificates.empty()) {
    apparatus::Bumps bumps(experiments::read_protocol(plan.protocol), read_with_progress);
    plan.certificates = apparatus::certificates_of(bumps, options.certificates);
  }
  std::atomic<int> next = 1;
  std::mutex mutex;
  std::exception_ptr failed;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < options.threads; ++i)
    threads.emplace_back([&] {
      for (int number = next++; number <= options.participants; number = next++) try {
          const std::size_t ticks = apparatus::run_virtual_session(plan, number, interrupted());
          std::printf("V%d: %zu ticks, every trial done\n", number, ticks);
        } catch (...) {
          const std::lock_guard lock(mutex);
          if (!failed) failed = std::current_exception();
          return;
        }
    });
  for (std::thread& thread : threads) thread.join();
  if (failed) std::rethrow_exception(failed);
  return kHeld;
}

}  // namespace forceshade::apps
