// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The state that a test and the process with the driver share: plain data under a lock that outlives who holds it.

#include <pthread.h>

#include "tests/device/stand_in_hd/stand_in_hd.h"

namespace forceshade::stand_in_hd {

inline constexpr const char* kMemory = "STAND_IN_HD_MEMORY";  // in the environment: a file

struct Memory {
  struct Noted {
    std::uint64_t frames = 0;
    bool initialised = false, scheduler = false, output = false;
    pid_t pid = 0;
    Vector force;  // on the arm
    Clock::time_point pushed_until{}, struck{};
  };

  pthread_mutex_t mutex;
  Orders orders;
  Noted noted;
};

static_assert(std::is_trivially_copyable_v<Memory::Noted>);

// In a new file without a name, or, without a file, in this process alone. Never unmapped; throws std::system_error.
Memory& made(int* file);

// In the file of this name, made by another process or by another part of this one.
Memory& opened(const std::string& path);

// Holds the memory's lock. Of a process that died with it the lock is taken over, and what it was about to write is as it is;
// one that stands still with it is waited for two seconds and then passed by.
class Lock {
 public:
  explicit Lock(Memory& memory);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  Memory& memory_;
  bool held_;
};

// Returns true if a process runs or could; false for one that ended and was not waited for.
bool lives(pid_t process);

// The default, but for the environment's STAND_IN_HD_INIT.
Orders first_orders();

}  // namespace forceshade::stand_in_hd
