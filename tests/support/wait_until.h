// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waits for what another thread or process does, for as long as it takes: CTest's limit ends a test that waits in vain.

#include <chrono>
#include <exception>
#include <thread>

namespace forceshade::tests {

// Looks once per pause. A condition that throws is not true yet.
template <class Condition>
void wait_until(Condition condition, std::chrono::milliseconds pause = std::chrono::milliseconds(1)) {
  for (;; std::this_thread::sleep_for(pause)) {
    try {
      if (condition()) return;
    } catch (const std::exception&) {
    }
  }
}

// Ends without it after the limit, for tests that time decides.
template <class Condition>
bool comes_true_within(std::chrono::milliseconds limit, Condition condition) {
  bool has_come = false;
  const auto end = std::chrono::steady_clock::now() + limit;
  wait_until([&] { return (has_come = condition()) || std::chrono::steady_clock::now() > end; });
  return has_come;
}

}  // namespace forceshade::tests
