// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The supervisor's rules as a sample holds them, by name.

#include <cstdint>
#include <string>
#include <vector>

#include "device/supervisor.h"
#include "text/joined.h"

namespace forceshade::run {

// The names of the rules in Sample::limited.
inline std::vector<std::string> rule_names(std::uint16_t rules) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < device::kRules; ++i) {
    const auto rule = static_cast<device::Rule>(i);
    if (device::Rules::limits(rule) && (rules >> device::Rules::bit_of(rule) & 1U) != 0) names.emplace_back(name_of(rule));
  }
  return names;
}

inline std::string joined_rule_names(std::uint16_t rules) {
  return joined(rule_names(rules), ", ");
}

}  // namespace forceshade::run
