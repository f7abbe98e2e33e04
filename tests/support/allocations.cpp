// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/allocations.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t count = 0, bytes = 0;

// In a simulated world several fibers of one thread count here, which the thread sanitizer takes for threads.
[[gnu::no_sanitize_thread]] void counted(std::size_t size) noexcept {
  ++count;
  bytes += size;
}
}  // namespace

void* operator new(std::size_t size) {
  counted(size);
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  counted(size);
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace forceshade::tests {

std::size_t allocations() noexcept {
  return count;
}
std::size_t allocated_bytes() noexcept {
  return bytes;
}

}  // namespace forceshade::tests
