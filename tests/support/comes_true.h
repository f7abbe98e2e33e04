// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waits for what another thread or process does.

#include <chrono>
#include <exception>
#include <thread>

namespace forceshade::tests {

// Within twenty seconds, for a busy machine. A condition that throws is not true yet.
template <class Condition>
bool comes_true(Condition condition) {
  using namespace std::chrono_literals;
  for (const auto end = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < end;
       std::this_thread::sleep_for(1ms)) {
    try {
      if (condition()) return true;
    } catch (const std::exception&) {
    }
  }
  return false;
}

}  // namespace forceshade::tests
