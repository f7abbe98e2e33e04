// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A trap for allocations: a test that links allocations.cpp has operator new replaced by one that counts.

#include <cstddef>

namespace forceshade::tests {

// How many this thread has made.
std::size_t allocations() noexcept;

}  // namespace forceshade::tests
