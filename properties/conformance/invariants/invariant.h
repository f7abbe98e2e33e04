// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An invariant needs no definition: one thing that must hold of every renderer, with what a hand would feel where it does not.

#include <cstdint>
#include <optional>
#include <string>

namespace forceshade::conformance {

struct Invariant {
  std::string name;
  std::uint64_t cases = 0;
  std::optional<std::string> violation = {};       // the first case, with what a hand would feel
  std::optional<std::string> not_applicable = {};  // why it was not looked at, which does not count as held
  std::optional<std::string> largest = {};         // where it is held: the largest deviation and its place, if it was measured
  std::optional<double> share_of_allowed = {};     // that deviation; infinite where an answer is no number

  // Keeps the first.
  void violated(const std::string& words) {
    if (!violation) violation = words;
  }
};

}  // namespace forceshade::conformance
