// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The errors of the C interface: a result, and a sentence in the thread's message.

#include <cstddef>
#include <string_view>

#include "forceshade.h"

namespace forceshade::c {

// Keeps the sentence, shortened to what there is room for. Allocates nothing.
forceshade_result fail(forceshade_result result, std::string_view words) noexcept;

// The result of the exception that is being handled, with its words.
forceshade_result fail_with_exception() noexcept;

// The last sentence of this thread.
const char* last_message() noexcept;

// Calls a function that may throw.
template <class Work>
forceshade_result guarded(const Work& work) noexcept {
  try {
    return work();
  } catch (...) {
    return fail_with_exception();
  }
}

}  // namespace forceshade::c
