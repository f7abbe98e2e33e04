// SPDX-License-Identifier: BSD-3-Clause
#include "apps/counted_allocations.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__has_feature)
#define FORCESHADE_HAS_FEATURE(name) __has_feature(name)
#else
#define FORCESHADE_HAS_FEATURE(name) 0
#endif

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&   \
    !FORCESHADE_HAS_FEATURE(address_sanitizer) && !FORCESHADE_HAS_FEATURE(thread_sanitizer) && \
    !FORCESHADE_HAS_FEATURE(memory_sanitizer)
#define FORCESHADE_COUNTS_ALLOCATIONS 1
#else
#define FORCESHADE_COUNTS_ALLOCATIONS 0
#endif

namespace {

// They need no construction, since malloc is called before any.
constinit std::atomic<bool> counting{false};
constinit std::atomic<std::uint64_t> all_calls{0}, all_bytes{0};

#if FORCESHADE_COUNTS_ALLOCATIONS
void count(std::size_t bytes) noexcept {
  if (!counting.load(std::memory_order_relaxed)) return;
  all_calls.fetch_add(1, std::memory_order_relaxed);
  all_bytes.fetch_add(bytes, std::memory_order_relaxed);
}
#endif

}  // namespace

// The program's definitions come before those of the C library, also for what it loads; these have other names there, too.
// free() is here so that a library that is preloaded has either all of them or none.
#if FORCESHADE_COUNTS_ALLOCATIONS
#define FORCESHADE_SEEN __attribute__((visibility("default")))
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void* memory);                                  // NOLINT(bugprone-reserved-identifier)

FORCESHADE_SEEN void* malloc(std::size_t size) noexcept {
  count(size);
  return __libc_malloc(size);
}
FORCESHADE_SEEN void* calloc(std::size_t entries, std::size_t size) noexcept {
  count(entries * size);
  return __libc_calloc(entries, size);
}
FORCESHADE_SEEN void* realloc(void* memory, std::size_t size) noexcept {
  count(size);
  return __libc_realloc(memory, size);
}
FORCESHADE_SEEN void* memalign(std::size_t alignment, std::size_t size) noexcept {
  count(size);
  return __libc_memalign(alignment, size);
}
FORCESHADE_SEEN void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}
FORCESHADE_SEEN int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  const bool is_power = alignment != 0 && (alignment & (alignment - 1)) == 0;
  if (!is_power || alignment % sizeof(void*) != 0) return EINVAL;
  void* const found = memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *memory = found;
  return 0;
}
FORCESHADE_SEEN void free(void* memory) noexcept {
  __libc_free(memory);
}
}
#endif

namespace forceshade::apps {

void count_allocations(bool is_counting) noexcept {
  counting.store(is_counting, std::memory_order_relaxed);
}

std::optional<CountedAllocations> counted_allocations() noexcept {
  if (FORCESHADE_COUNTS_ALLOCATIONS == 0) return std::nullopt;
  return CountedAllocations{all_calls.load(std::memory_order_relaxed), all_bytes.load(std::memory_order_relaxed)};
}

}  // namespace forceshade::apps
