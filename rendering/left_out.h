// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The features that a build was configured without: cmake/features.cmake.

#include <stdexcept>
#include <string>

namespace forceshade {

// Thrown by what would need the feature.
struct LeftOut : std::runtime_error {
  // what: the act that cannot be done, as a sentence without its end.
  LeftOut(const std::string& what, const char* feature)
      : std::runtime_error(what + ": this build was configured without the feature " + feature) {}
};

}  // namespace forceshade
