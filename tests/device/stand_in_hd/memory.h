// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The state that a test and the process with the driver share: plain data under a lock that outlives who holds it.

#include <pthread.h>
#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <type_traits>

#include "tests/device/stand_in_hd/orders.h"

namespace forceshade::stand_in_hd {

inline constexpr const char* kMemory = "STAND_IN_HD_MEMORY";  // in the environment: a file

struct Memory {
  using Time = std::chrono::steady_clock::time_point;
  struct Frame {
    Vector position, force;
    Time time;
    bool output;
  };
  struct Noted {
    std::array<std::array<char, 128>, 64> breaches{};
    std::uint64_t breach_count = 0;
    std::array<char, 256> name{};
    bool named = false, initialised = false, scheduler = false, output = false;
    pid_t pid = 0;
    int updates = 0;
    double rate = 1000;
    Vector force;  // on the arm
    Time changed{}, pushed_until{}, killed{}, crashed{};
    Vector killed_under;
    std::uint64_t frame_count = 0;
  };
  static constexpr std::uint64_t kMark = 0x48442d6f72646572;

  pthread_mutex_t mutex;
  std::uint64_t resets = 0, tellings = 0;
  Orders orders;
  Noted noted;
  std::array<Frame, 65536> frames;  // frame n at n modulo the size
  std::uint64_t mark = kMark;
};

static_assert(std::is_trivially_copyable_v<Memory::Noted> && std::is_trivially_copyable_v<Memory::Frame>);

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
