// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waits for what another thread or process does.

#include <chrono>
#include <exception>
#include <thread>

namespace forceshade::tests {

// Within twenty seconds unless said, for a busy machine. A condition that throws is not true yet.
template <class Condition>
bool comes_true(Condition condition, std::chrono::steady_clock::duration timeout = std::chrono::seconds(20),
                std::chrono::steady_clock::duration pause = std::chrono::milliseconds(1)) {
  for (const auto end = std::chrono::steady_clock::now() + timeout; std::chrono::steady_clock::now() < end;
       std::this_thread::sleep_for(pause)) {
    try {
      if (condition()) return true;
    } catch (const std::exception&) {
    }
  }
  return false;
}

}  // namespace forceshade::tests
