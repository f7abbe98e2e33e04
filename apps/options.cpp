// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

namespace forceshade::apps {
namespace {

// Without an exponent, so that 100000 is not 1e+05.
std::string written(double value) {
  std::array<char, 400> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr};
}
std::string written(std::uint64_t value) {
  return std::to_string(value);
}

template <class T, class Range>
T parse(const std::string& name, const std::string& text, const Range& range, const char* kind) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc{} && rest == end && value >= range.least && value <= range.most) return value;
  throw CLI::ValidationError(name, std::string("expected a ") + kind + " from " + written(range.least) + " to " +
                                       written(range.most) + ", got \"" + text + '"');
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& help, const std::string& range,
                        std::function<void(const std::string&)> keep) {
  return command.add_option_function<std::string>(name, std::move(keep), help)->type_name("N (" + range + ")");
}

}  // namespace

std::uint64_t parse_whole(const std::string& name, const std::string& text, WholeRange range) {
  return parse<std::uint64_t>(name, text, range, "whole number");
}

double parse_number(const std::string& name, const std::string& text, NumberRange range) {
  return parse<double>(name, text, range, "number");
}

CLI::Option* add_whole(CLI::App& command, const std::string& name, const std::string& help, WholeRange range,
                       std::function<void(std::uint64_t)> keep) {
  return add_parsed(command, name, help, written(range.least) + " to " + written(range.most),
                    [=](const std::string& text) { keep(parse_whole(name, text, range)); });
}

CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& help, NumberRange range,
                        std::function<void(double)> keep) {
  return add_parsed(command, name, help, written(range.least) + " to " + written(range.most),
                    [=](const std::string& text) { keep(parse_number(name, text, range)); });
}

CLI::Option* add_word(CLI::App& command, const std::string& name, std::string& value, const std::string& help,
                      std::vector<std::string> words) {
  return command.add_option(name, value, help)
      ->type_name(joined(words, "|"))
      ->capture_default_str()
      ->check(one_of(std::move(words)));
}

CLI::Validator one_of(std::vector<std::string> words) {
  return {[words = std::move(words)](const std::string& got) {
            if (std::find(words.begin(), words.end(), got) != words.end()) return std::string();
            return "expected one of " + joined(words, ", ") + "; got \"" + got + '"';
          },
          ""};
}

void refuse_empty_values(CLI::App& command) {
  for (CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_expected_max() > 0; }))
    option->check([](const std::string& text) { return text.empty() ? "expected a value, got an empty one" : ""; });
  for (CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) refuse_empty_values(*subcommand);
}

std::string failure_message(const CLI::App*, const CLI::Error& error) {
  std::string words = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const bool repeated = words.find("received") != std::string::npos;
    words =
        words.substr(0, words.find(':')) + (repeated ? ": expected once, got several times" : ": expected a value after it");
  }
  // The value of an option is converted by its own function, so this is of a flag: "Could not convert: --unpaced = x".
  if (const std::string got = " = "; dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    const std::size_t name = words.find("--"), value = words.find(got, name);
    if (name != std::string::npos && value != std::string::npos)
      words = words.substr(name, value - name) + ": expected no value, got \"" + words.substr(value + got.size()) + '"';
  }
  return "forceshade: " + words + "\nRun with --help for more information.\n";
}

}  // namespace forceshade::apps
