// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options that are whole numbers, exactly.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace forceshade::apps {

// The option takes digits only, and no number outside [low, high]: what it does not take is refused with what was expected.
// `value` must outlive the command.
inline CLI::Option* add_whole_number(CLI::App& command, const std::string& name, std::uint64_t& value, std::uint64_t low,
                                     std::uint64_t high, const std::string& help) {
  const auto read = [&value, name, low, high](const CLI::results_t& results) {
    const std::string& text = results.back();
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stopped != end || number < low || number > high)
      throw CLI::ValidationError(name, "expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                                           ", in digits; got \"" + text + "\"");
    value = number;
    return true;
  };
  return command.add_option(name, read, help)->type_name("N")->default_str(std::to_string(value));
}

}  // namespace forceshade::apps
