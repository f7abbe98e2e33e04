// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The features that a build was configured without: cmake/features.cmake.

#include <string>

#include "forceshade/error.h"

namespace forceshade {

// Thrown by what would need the feature.
struct LeftOut : Error {
  // what: the act that cannot be done, as a sentence without its end.
  LeftOut(const std::string& what, const char* feature)
      : Error(what + ": this build was configured without the feature " + feature) {}
};

}  // namespace forceshade
