// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/fiber.h"

#include <cxxabi.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

// The world itself is compiled without the thread sanitizer, to which its one thread would look like many:
// tests/world/CMakeLists.txt defines this where the code under test is compiled with it.
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(WORLD_TELLS_TSAN)
#include <sanitizer/tsan_interface.h>
#endif

namespace forceshade::world {
namespace {

constexpr std::size_t kStack = std::size_t{512} << 10U;

// The fiber that a beginning one comes from, and itself: its first function has no argument.
Fiber* leaving = nullptr;
Fiber* arriving = nullptr;

}  // namespace

Fiber::Fiber() {
#if defined(WORLD_TELLS_TSAN)
  tsan_ = __tsan_get_current_fiber();
#endif
}

Fiber::Fiber(std::function<void()> body) : body_(std::move(body)), size_(kStack) {
  stack_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (stack_ == MAP_FAILED) throw std::bad_alloc();
  getcontext(&context_);
  context_.uc_stack.ss_sp = stack_;
  context_.uc_stack.ss_size = size_;
  makecontext(&context_, &Fiber::begin, 0);
#if defined(WORLD_TELLS_TSAN)
  tsan_ = __tsan_create_fiber(0);
#endif
}

Fiber::~Fiber() {
  if (!body_) return;
#if defined(WORLD_TELLS_TSAN)
  __tsan_destroy_fiber(tsan_);
#endif
  ::munmap(stack_, size_);
}

void Fiber::begin() {
  Fiber& self = *arriving;
  self.arrived();
  acquire(&self);
  self.body_();
  std::abort();
}

// Learns where the thread's own stack lies, from which the first change of fibers comes.
void Fiber::arrived() noexcept {
#if defined(__SANITIZE_ADDRESS__)
  const void* bottom = nullptr;
  std::size_t size = 0;
  __sanitizer_finish_switch_fiber(fake_stack_, &bottom, &size);
  if (leaving->body_) return;
  leaving->stack_ = const_cast<void*>(bottom);
  leaving->size_ = size;
#endif
}

void Fiber::go_to(Fiber& other, bool last) noexcept {
  const int error = errno;
  auto* exceptions = reinterpret_cast<std::byte*>(abi::__cxa_get_globals());
  std::memcpy(exceptions_.data(), exceptions, exceptions_.size());
  std::memcpy(exceptions, other.exceptions_.data(), exceptions_.size());
  leaving = this;
  arriving = &other;
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(last ? nullptr : &fake_stack_, other.stack_, other.size_);
#else
  static_cast<void>(last);
#endif
#if defined(WORLD_TELLS_TSAN)
  const bool orders = !body_ || !other.body_;  // the thread that made them all waits for them
  __tsan_switch_to_fiber(other.tsan_, orders ? 0 : __tsan_switch_to_fiber_no_sync);
#endif
  swapcontext(&context_, &other.context_);
  arrived();
  errno = error;
}

void release([[maybe_unused]] void* what) noexcept {
#if defined(WORLD_TELLS_TSAN)
  __tsan_release(what);
#endif
}

void acquire([[maybe_unused]] void* what) noexcept {
#if defined(WORLD_TELLS_TSAN)
  __tsan_acquire(what);
#endif
}

}  // namespace forceshade::world
