// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A vendor's shared library, found when the program runs: it builds and starts without.

#include <concepts>
#include <functional>
#include <string>
#include <vector>

#include "rendering/control_words.h"

namespace forceshade::device {

// Words for messages about a library.
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

// A function of such a library. Whatever it does to this thread's control words, those are as before when it has returned: a
// library that was linked with -ffast-math, or that rounds for itself, would else change the arithmetic of the servo loop.
template <class Function>
class LibraryFunction;
template <class Result, class... Arguments>
class LibraryFunction<Result (*)(Arguments...)> {
 public:
  using Pointer = Result (*)(Arguments...);

  LibraryFunction() = default;
  template <std::convertible_to<Pointer> Function>
  constexpr LibraryFunction(const Function& function)
      : function_(function) {}  // NOLINT(google-explicit-constructor): it is one

  Result operator()(Arguments... arguments) const {
    const KeptControlWords kept;
    return function_(arguments...);
  }
  Pointer pointer() const { return function_; }

 private:
  Pointer function_ = nullptr;
};

}  // namespace forceshade::device

// For `take`: looks up the function of this name, and appends it to `missing` where it is not there.
#define FORCESHADE_LOOK_UP(functions, library, function, missing)                                          \
  functions.function = reinterpret_cast<decltype(functions.function)::Pointer>(dlsym(library, #function)); \
  if (!functions.function.pointer()) missing.append(missing.empty() ? "" : ", ").append(#function);
