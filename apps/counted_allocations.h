// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Counts what the process allocates meanwhile, a shared object's calls among them.

#include <cstdint>
#include <optional>

namespace forceshade::apps {

struct CountedAllocations {
  std::uint64_t calls = 0, bytes = 0;  // requested bytes
};

// Begins and ends counting: calls of malloc, calloc, realloc, aligned_alloc, memalign and posix_memalign by any thread. The
// operator new of the standard library calls malloc. What was counted before is kept.
void count_allocations(bool is_counting) noexcept;

// Nothing where they cannot be counted: under sanitizers, which have a malloc of their own, and without the GNU C library.
std::optional<CountedAllocations> counted_allocations() noexcept;

}  // namespace forceshade::apps
