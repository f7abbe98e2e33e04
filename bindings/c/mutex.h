// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mutex: one whose constructor is constant, so that a table is there before the first function runs. That of mingw-w64's std::mutex
// is not.

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
#else
#include <mutex>
#endif

namespace forceshade::c {

#ifdef _WIN32
class Mutex {
 public:
  void lock() noexcept { AcquireSRWLockExclusive(&lock_); }
  void unlock() noexcept { ReleaseSRWLockExclusive(&lock_); }

 private:
  SRWLOCK lock_ = SRWLOCK_INIT;
};
#else
using Mutex = std::mutex;
#endif

}  // namespace forceshade::c
