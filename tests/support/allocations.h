// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A trap for allocations: a test that links allocations.cpp has operator new replaced by one that counts.

#include <cstddef>

namespace forceshade::tests {

// The number of allocations that this thread has made, and of bytes that it has asked for in all.
std::size_t allocations() noexcept;
std::size_t allocated_bytes() noexcept;

}  // namespace forceshade::tests
