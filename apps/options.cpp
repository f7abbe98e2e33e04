// SPDX-License-Identifier: BSD-3-Clause
#include "apps/options.h"

#include <algorithm>
#include <utility>

#include "apps/documentation.h"
#include "apps/tell.h"
#include "apps/troubleshooting.h"
#include "files/shell.h"
#include "files/suggestion.h"
#include "subjects/file.h"
#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::apps {
namespace {

std::string written(double value) {
  return without_exponent(value);
}
std::string written(std::uint64_t value) {
  return std::to_string(value);
}

template <class Range>
std::string words_of(const Range& range) {
  return written(range.least) + " to " + written(range.most);
}

template <class T, class Range>
T parse(const std::string& name, const std::string& text, const Range& range, const char* kind) {
  if (const auto value = number_in<T>(text); value && *value >= range.least && *value <= range.most) return *value;
  throw CLI::ValidationError(name, std::string("expected a ") + kind + " from " + words_of(range) + ", got \"" + text + '"');
}

CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& help, const std::string& range,
                        std::function<void(const std::string&)> keep) {
  return command.add_option_function<std::string>(name, std::move(keep), help)->type_name("N (" + range + ")");
}

constexpr const char* kSection = "--section";

// Reads a range on one axis, a place on the other, or both, in any order.
Section parse_section(const std::string& text) {
  const auto refuse = [&] {
    return CLI::ValidationError(
        kSection, "expected a range on x or y and a place on the other axis, such as x=-9mm..9mm,y=2mm, got \"" + text + '"');
  };
  Section section;
  char ranged = 0, placed = 0;  // the axes that were given
  for (const std::string& part : files::at_commas(text)) {
    const std::size_t dots = part.find("..");
    char& axis = dots == std::string::npos ? placed : ranged;
    if (axis != 0 || (!part.starts_with("x=") && !part.starts_with("y="))) throw refuse();
    axis = part[0];
    if (dots == std::string::npos) {
      section.at = files::parse_length(kSection, part.substr(2));
    } else {
      section.from = files::parse_length(kSection, part.substr(2, dots - 2));
      section.to = files::parse_length(kSection, part.substr(dots + 2));
    }
  }
  if (ranged == placed) throw refuse();
  if (ranged == 'y' || placed == 'x') section.along = 'y';
  return section;
}

// The command that was being read.
const CLI::App* command_of(const CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return app;
}

bool is_option(const std::string& word) {
  return word.starts_with("-");
}

// "mesh check: "; empty for the program, which is named in front of every message.
std::string named(const CLI::App& command) {
  const std::string program = "forceshade", name = full_name(command);
  if (name == program) return "";
  return (name.starts_with(program + ' ') ? name.substr(program.size() + 1) : name) + ": ";
}

std::vector<std::string> names_of_verbs(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* verb : command.get_subcommands([](const CLI::App*) { return true; })) names.push_back(verb->get_name());
  return names;
}

// Describes a word that was left over: an option that the command does not have, or a word that it has no place for.
std::string words_of_extra(const CLI::App& command) {
  const std::vector<std::string> extras = command.remaining();
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option == extras.end())
    return named(command) + "expected no further word, got \"" + (extras.empty() ? "" : extras.front()) + '"' +
           (extras.empty() ? "" : files::suggestion(extras.front(), names_of_verbs(command)));
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options())
    for (const std::string& known_name : known->get_lnames()) names.push_back("--" + known_name);
  return named(command) + "unknown option \"" + name + '"' + files::suggestion(name, names);
}

std::string words_of_missing(const CLI::App& command, const std::string& what) {
  const std::vector<std::string> verbs = names_of_verbs(command);
  const std::vector<std::string> extras = command.remaining();
  // Behind a misspelt command, its options are unknown too.
  const bool has_misspelt_command = !verbs.empty() && !extras.empty() && !is_option(extras.front());
  if (!has_misspelt_command && std::any_of(extras.begin(), extras.end(), is_option)) return words_of_extra(command);
  if (what.find("subcommand") == std::string::npos)
    return named(command) + "expected " + what.substr(0, what.find(" is required")) + ", got none";
  const std::string words = named(command) + "expected a command: " + joined(verbs, ", ") + "; got ";
  return extras.empty() ? words + "none" : words + '"' + extras.front() + '"' + files::suggestion(extras.front(), verbs);
}

template <class E>
bool is_a(const CLI::Error& error) {
  return dynamic_cast<const E*>(&error) != nullptr;
}

// In the form of this file: where, what was expected, what was got.
std::string words_of_error(const CLI::App& command, const CLI::Error& error) {
  std::string words = error.what();
  if (is_a<CLI::ExtrasError>(error)) return words_of_extra(command);
  if (is_a<CLI::RequiredError>(error)) return words_of_missing(command, words);
  if (const std::size_t at = words.find(" requires "); is_a<CLI::RequiresError>(error))
    return words.substr(0, at) + ": expected " + words.substr(at + 10) + " beside it, got it alone";
  if (const std::size_t at = words.find(" excludes "); is_a<CLI::ExcludesError>(error))
    return words.substr(0, at) + ": expected without " + words.substr(at + 10) + ", got both";
  if (is_a<CLI::ArgumentMismatch>(error)) {
    const bool repeated = words.find("received") != std::string::npos;
    return words.substr(0, words.find(':')) +
           (repeated ? ": expected once, got several times" : ": expected a value after it, got none");
  }
  // The value of an option is converted by its own function, so this is of a flag: "Could not convert: --free-run = x".
  if (const std::string got = " = "; is_a<CLI::ConversionError>(error)) {
    const std::size_t name = words.find("--"), value = words.find(got, name);
    if (name != std::string::npos && value != std::string::npos)
      return words.substr(name, value - name) + ": expected no value, got \"" + words.substr(value + got.size()) + '"';
  }
  return words;
}

CLI::Option* add_quantity(CLI::App& command, const std::string& name, std::string& value, const std::string& help,
                          const char* type) {
  CLI::Option* option = command.add_option(name, value, help)->type_name(type);
  if (!value.empty()) option->capture_default_str();
  return option;
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
  return add_parsed(command, name, help, words_of(range),
                    [=](const std::string& text) { keep(parse_whole(name, text, range)); });
}

CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& help, NumberRange range,
                        std::function<void(double)> keep) {
  return add_parsed(command, name, help, words_of(range),
                    [=](const std::string& text) { keep(parse_number(name, text, range)); });
}

CLI::Option* add_length(CLI::App& command, const std::string& name, std::string& value, const std::string& help) {
  return add_quantity(command, name, value, help, "LENGTH");
}

CLI::Option* add_stiffness(CLI::App& command, std::string& value, const std::string& help) {
  return add_quantity(command, "--stiffness", value, help, "STIFFNESS");
}

CLI::Option* add_angle(CLI::App& command, const std::string& name, const std::string& help, NumberRange degrees,
                       std::function<void(double, const files::Angle&)> keep) {
  const auto read = [=](const std::string& text) { keep(parse_angle(name, text, degrees), files::exact_angle(name, text)); };
  return command.add_option_function<std::string>(name, read, help)->type_name("ANGLE (" + words_of(degrees) + ")");
}

double parse_angle(const std::string& name, const std::string& text, NumberRange degrees) {
  const double angle = files::parse_angle(name, text);
  if (angle >= degrees.least && angle <= degrees.most) return angle;
  throw CLI::ValidationError(name, "expected an angle from " + words_of(degrees) + " degrees, got \"" + text + '"');
}

CLI::Option* add_section(CLI::App& command, Section& section, const std::string& help) {
  const auto read = [&section](const std::string& text) { section = parse_section(text); };
  return command.add_option_function<std::string>(kSection, read, help)
      ->type_name("x=FROM..TO,y=AT")
      ->default_str("x=-12.7mm..12.7mm,y=0");
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
            return "expected one of " + joined(words, ", ") + "; got \"" + got + '"' + files::suggestion(got, words);
          },
          ""};
}

void refuse_empty_values(CLI::App& command) {
  for (CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_expected_max() > 0; }))
    option->check([](const std::string& text) { return text.empty() ? "expected a value, got an empty one" : ""; });
  for (CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) refuse_empty_values(*subcommand);
}

void refuse_options_before_verbs(CLI::App& command) {
  for (CLI::App* verb : command.get_subcommands([](const CLI::App*) { return true; })) {
    verb->preparse_callback([&command, verb](std::size_t) {
      for (const CLI::Option* option : command.get_options())
        if (!option->empty() && option != command.get_help_ptr())
          throw Error(option->get_name() + ": expected after '" + command.get_name() + ' ' + verb->get_name() +
                      "' or not at all, got before it");
    });
    refuse_options_before_verbs(*verb);
  }
}

std::string repeated(const CLI::App& command) {
  std::string line = full_name(command);
  for (const CLI::Option* option : command.get_options()) {
    const std::string& group = option->get_group();
    if (group != kSubjectGroup && group != kEvidenceGroup) continue;
    std::vector<std::string> values = option->results();
    // The word for a value that --timing lacks is not its default.
    if (values.empty() && group == kEvidenceGroup && option->get_expected_min() > 0 && !option->get_default_str().empty())
      values = {option->get_default_str()};
    if (values.empty()) continue;
    if (!option->get_positional()) line += ' ' + option->get_name();
    if (option->get_expected_max() > 0)
      for (const std::string& value : values) line += ' ' + files::quoted_for_shell(value);
  }
  return line;
}

std::string reason_of(const CLI::App& app, const CLI::Error& error) {
  return words_of_error(*command_of(&app), error);
}

std::string failure_message(const CLI::App& app, const CLI::Error& error) {
  const CLI::App& command = *command_of(&app);
  std::string name = command.get_name();
  for (const CLI::App* parent = command.get_parent(); parent != nullptr && parent->get_parent() != nullptr;
       parent = parent->get_parent())
    name = parent->get_name() + ' ' + name;
  const std::string help = command.get_parent() == nullptr ? "" : ' ' + name;
  return with_page(reason_of(app, error)) + "\n'" + program_name() + " help" + help + "' shows what is expected.\n";
}

}  // namespace forceshade::apps
