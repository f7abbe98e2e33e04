// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The inside of a World: its threads and processes.

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "system/process.h"
#include "tests/world/fiber.h"
#include "tests/world/world.h"

namespace forceshade::world {

struct World::Thread {
  Thread(const char* its_name, std::function<void()> body) : name(its_name), fiber(std::move(body)) {}

  std::string name;
  Fiber fiber;
  enum class State { ready, waiting, over, dead } state = State::ready;
  Ns due = 0, held_until = 0;  // of one that waits; of one that is held up
  long held_steps = 0;         // of the others
  const void* number = nullptr;
  int joined = -1;
  Ns computed = 0;
  int process = 0;
  bool allows_interrupt = false, is_interrupted = false, is_stopped = false;
};

// A process, and the packets between it and the one that made it.
struct World::Process {
  int parent = -1;
  std::optional<int> code = std::nullopt;  // once it has ended
  system::LastAct* act = nullptr;
  // First the end of the parent's, then its own.
  std::array<std::deque<std::vector<std::byte>>, 2> received = {};
  std::array<bool, 2> closed = {};
};

}  // namespace forceshade::world
