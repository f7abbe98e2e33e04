// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The errors of the C interface: a result, and a sentence in the thread's message.

#include <cstddef>
#include <string_view>

#include "forceshade.h"
#include "forceshade/law.h"

namespace forceshade::c {

// Keeps the sentence, shortened to what there is room for. Allocates nothing.
forceshade_result fail(forceshade_result result, std::string_view words) noexcept;

// The result of the exception that is being handled, with its words.
forceshade_result fail_with_exception() noexcept;

// The last sentence of this thread.
const char* last_message() noexcept;

// The result for a parameter outside its domain, or for this thread's arithmetic, after setting the error text.
inline forceshade_result fail_with(const ParameterError& error) {
  return fail(error.arithmetic_fault == nullptr ? FORCESHADE_BAD_VALUE : FORCESHADE_BAD_ARITHMETIC, error.message());
}

// Ends the work that guarded() calls, unless the result of a check is OK.
struct Refused {
  forceshade_result result;
};
inline void require(forceshade_result result) {
  if (result != FORCESHADE_OK) throw Refused{result};
}

// Calls a function that may throw.
template <class Work>
forceshade_result guarded(const Work& work) noexcept {
  try {
    return work();
  } catch (...) {
    return fail_with_exception();
  }
}

// Texts that go out of the C interface.

// Returns OK, or an error code after setting the error text, if there is no room for a text.
inline forceshade_result check_room(const char* text, std::size_t size) noexcept {
  return text == nullptr && size > 0 ? fail(FORCESHADE_NULL_POINTER, "text is NULL, and size is not 0") : FORCESHADE_OK;
}

// Writes as much as there is room for, with a zero at its end; `length`, where it is not null, gets the length of all of it.
inline void give(std::string_view words, char* text, std::size_t size, std::size_t* length) noexcept {
  if (size > 0) text[words.copy(text, size - 1)] = '\0';
  if (length != nullptr) *length = words.size();
}

}  // namespace forceshade::c
