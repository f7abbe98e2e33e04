// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A fiber: a stack of its own in one thread of the system. Which fiber goes on is decided by the program alone, so that a run
// of several is the same to the bit every time. The sanitizers are told of each change.

#include <ucontext.h>

#include <array>
#include <cstddef>
#include <functional>

namespace forceshade::world {

class Fiber {
 public:
  // The thread that makes it goes on as this fiber.
  Fiber();
  // Runs this once it is gone to. The body must not return, but go to another fiber at its end, with `last`.
  explicit Fiber(std::function<void()> body);
  // It is not the one that runs. The objects on its stack are not destroyed.
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  // Leaves this fiber, which runs, for another one; returns when this one is gone to. last: it never is.
  void go_to(Fiber& other, bool last = false) noexcept;

 private:
  static void begin();
  void arrived() noexcept;

  std::function<void()> body_;  // empty: the thread's own
  ucontext_t context_{};
  void* stack_ = nullptr;
  std::size_t size_ = 0;
  std::array<std::byte, 16> exceptions_{};  // the runtime's record of those being handled, for each thread
  void *fake_stack_ = nullptr, *tsan_ = nullptr;
};

// For the thread sanitizer, to which a change of fibers orders nothing: who acquires sees what was done before the same was
// released, as when a thread begins or is joined, and where the system passes a packet on.
void release(void* what) noexcept;
void acquire(void* what) noexcept;

}  // namespace forceshade::world
