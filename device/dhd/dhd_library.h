// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force Dimension's library, found when the program runs: it builds and starts without.

#include <string>
#include <vector>

#include "device/dhd/dhd_abi.h"
#include "device/loaded_library.h"

namespace forceshade::device::dhd {

struct Functions {
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define FORCESHADE_MEMBER(name) LibraryFunction<decltype(&dhd::name)> name;
  FORCESHADE_DHD_FUNCTIONS(FORCESHADE_MEMBER)
#undef FORCESHADE_MEMBER
};

// load_first() of loaded_library.h, with its errors.
Functions load(const std::vector<std::string>& names);

// The file named in the environment's FORCESHADE_DHD_LIBRARY, or libdhd.so.3, libdhd.so and libdrd, which includes it.
std::vector<std::string> names_to_try();

inline constexpr const char* kToInstall =
    "Install Force Dimension's SDK, or name the library's file in FORCESHADE_DHD_LIBRARY.";

// The name of the file that has this function, "libdhd.so.3.17.5": the library has no other word for its version here.
std::string file_of(const Functions& functions);

}  // namespace forceshade::device::dhd
