// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A vendor's shared library, found when the program runs: it builds and starts without.

#include <functional>
#include <string>
#include <vector>

namespace forceshade::device {

// How messages call it.
struct LibraryWords {
  const char* what;    // "the PHANToM's driver library (HDAPI, part of the vendor's OpenHaptics)"
  const char* is_not;  // "the HDAPI": what a file that lacks functions is not
  const char* advice;  // a sentence: what to install, and which environment variable names the file
};

// The first of these names or paths that loads and has every function. `take` looks them up and returns those that are missing.
// The library is never unloaded: a driver's threads outlive the last call, and it may not load twice. Throws DeviceError, with
// what was tried and why each failed.
void load_first(const std::vector<std::string>& names, const LibraryWords& words,
                const std::function<std::string(void* library)>& take);

// The file that the environment's variable names, or the usual names.
std::vector<std::string> library_names(const char* variable, const std::vector<std::string>& usual);

}  // namespace forceshade::device

// For `take`: looks up the function of this name, and appends it to `missing` where it is not there.
#define FORCESHADE_LOOK_UP(functions, library, function, missing)                                 \
  functions.function = reinterpret_cast<decltype(functions.function)>(dlsym(library, #function)); \
  if (!functions.function) missing.append(missing.empty() ? "" : ", ").append(#function);
