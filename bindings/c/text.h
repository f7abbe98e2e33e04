// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Texts that go out of the C interface.

#include <cstddef>
#include <string_view>

#include "bindings/c/errors.h"
#include "forceshade.h"

namespace forceshade::c {

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
