// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options whose value is a number, a quantity with a unit, or one of several words. The whole text is read; what is refused is
// reported as `--cases: expected a whole number from 1 to 1000, got "1e3"`.

#include <CLI/CLI.hpp>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "files/quantity.h"

namespace forceshade::apps {

// The titles of groups of options in --help, in this order.
inline constexpr const char *kSubjectGroup = "Subject", *kPlaceGroup = "Placement", *kEvidenceGroup = "Evidence",
                            *kDeviceGroup = "Device and loop", *kOutputGroup = "Output", *kOtherGroup = "Options";
inline constexpr std::array<std::string_view, 6> kOptionGroups{kSubjectGroup, kPlaceGroup,  kEvidenceGroup,
                                                               kDeviceGroup,  kOutputGroup, kOtherGroup};

struct WholeRange {
  std::uint64_t least, most;
};
struct NumberRange {
  double least, most;
};

inline constexpr WholeRange kDigits{1, 10000};
inline constexpr WholeRange kCases{1, 1000000000};
inline constexpr WholeRange kSeeds{0, std::numeric_limits<std::uint64_t>::max()};

// Decimal digits and nothing else. `name` is what a message calls it. Throws CLI::ValidationError.
std::uint64_t parse_whole(const std::string& name, const std::string& text, WholeRange range);
// As from_chars reads it, so neither a hexfloat nor a sign in front but -. Throws CLI::ValidationError.
double parse_number(const std::string& name, const std::string& text, NumberRange range);

CLI::Option* add_whole(CLI::App& command, const std::string& name, const std::string& help, WholeRange range,
                       std::function<void(std::uint64_t)> keep);
CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& help, NumberRange range,
                        std::function<void(double)> keep);

// A length or a stiffness stays as it was written until parse_length() or parse_stiffness() reads it; the help shows what it is
// unless the option is given.
CLI::Option* add_length(CLI::App& command, const std::string& name, std::string& value, const std::string& help);
CLI::Option* add_stiffness(CLI::App& command, std::string& value, const std::string& help);
// In degrees, or with a unit: the nearest binary64 number of degrees, and the angle as it was typed.
CLI::Option* add_angle(CLI::App& command, const std::string& name, const std::string& help, NumberRange degrees,
                       std::function<void(double, const files::Angle&)> keep);
double parse_angle(const std::string& name, const std::string& text, NumberRange degrees);

// A line across a height map: along x or y from one place to another, at a place on the other axis. mm.
struct Section {
  char along = 'x';
  float from = -12.7F, to = 12.7F, at = 0;
};
// --section x=FROM..TO,y=AT, or y=FROM..TO,x=AT. help: of what.
CLI::Option* add_section(CLI::App& command, Section& section, const std::string& help);

// `value` is what it is unless the option is given, and the help says so.
template <std::integral T>
CLI::Option* add_whole(CLI::App& command, const std::string& name, T& value, const std::string& help, WholeRange range) {
  return add_whole(command, name, help, range, [&value](std::uint64_t given) { value = static_cast<T>(given); })
      ->default_str(std::to_string(value));
}

CLI::Option* add_word(CLI::App& command, const std::string& name, std::string& value, const std::string& help,
                      std::vector<std::string> words);

// For ->check(): one of the words.
CLI::Validator one_of(std::vector<std::string> words);

// Every option of the command and of its subcommands then refuses an empty value, and one that is given twice says so.
void refuse_empty_values(CLI::App& command);

// Every verb of the command then throws Error where an option of the command stands before it.
void refuse_options_before_verbs(CLI::App& command);

// The command as it is typed to do the same again: its subject and evidence, what was given and what holds unless it is.
std::string repeated(const CLI::App& command);

// The message on standard error about a command line that cannot be read; it may begin with an option's name.
std::string failure_message(const CLI::App& app, const CLI::Error& error);

// Its first line, without the hint at the help.
std::string reason_of(const CLI::App& app, const CLI::Error& error);

}  // namespace forceshade::apps
