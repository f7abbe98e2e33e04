// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vendor's library, found when the program runs: it builds and starts without.

#include <string>
#include <vector>

#include "device/loaded_library.h"
#include "device/phantom/hdapi_abi.h"

namespace forceshade::device::hdapi {

struct Functions {
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define FORCESHADE_MEMBER(name) LibraryFunction<decltype(&hdapi::name)> name;
  FORCESHADE_HDAPI_FUNCTIONS(FORCESHADE_MEMBER)
#undef FORCESHADE_MEMBER
};

// load_first() of loaded_library.h, with its errors.
Functions load(const std::vector<std::string>& names);

// The files that vendor() tries, in this order.
std::vector<std::string> names_to_try();

// The file named in the environment's FORCESHADE_HD_LIBRARY, or libHD.so.3.4, libHD.so.3.0, libHD.so. Once loaded, the
// process stays with it.
const Functions& vendor();

// The oldest error on the driver's stack, which it empties: those above it are what followed from it.
HDErrorInfo drained(const Functions& hd) noexcept;

}  // namespace forceshade::device::hdapi
