// SPDX-License-Identifier: BSD-3-Clause
// The text of --help: at most 100 columns, the options by what they are for.

#include <sstream>

#include "apps/documentation.h"
#include "apps/options.h"

namespace forceshade::apps {
namespace {

constexpr std::size_t kWidth = 100, kIndent = 30;

// In lines that begin at the column `indent`, where the first one stands already, and end before kWidth.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string all;
  std::size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word; column += word.size()) {
    if (column > indent && column + 1 + word.size() > kWidth) {
      all += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      all += ' ';
      ++column;
    }
    all += word;
  }
  return all;
}

// `left` in a column of its own, the text beside or below it.
std::string help_row(const std::string& left, const std::string& text) {
  const std::string first = "  " + left;
  const bool fits = first.size() + 2 <= kIndent;
  return first + (fits ? std::string(kIndent - first.size(), ' ') : '\n' + std::string(kIndent, ' ')) + wrapped(text, kIndent) +
         '\n';
}

std::string plain_synopsis(const CLI::Option& option) {
  const std::string type = option.get_expected_max() > 0 ? option.get_type_name() : "";
  if (option.get_positional()) return type + (option.get_expected_max() > 1 ? "..." : "");
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  return type.empty() ? names : names + ' ' + type;
}

std::string help_rows(const std::string& title, const std::vector<const CLI::Option*>& options) {
  std::string all;
  for (const CLI::Option* option : options) all += help_row(plain_synopsis(*option), words_of(*option));
  return all.empty() ? "" : '\n' + title + ":\n" + all;
}

std::string usage_of(const CLI::App& command) {
  std::string words = "Usage: " + full_name(command);
  const std::vector<const CLI::App*> verbs = verbs_of(command);
  if (!verbs.empty()) words += command.get_require_subcommand_min() > 0 ? " COMMAND" : " [COMMAND]";
  for (const CLI::Option* option : command.get_options([](const CLI::Option* each) { return each->get_positional(); }))
    words += option->get_required() ? ' ' + plain_synopsis(*option) : " [" + plain_synopsis(*option) + ']';
  return words + " [OPTIONS]\n";
}

}  // namespace

std::string help_text(const CLI::App& command) {
  std::string text = wrapped(sentence(command.get_description()), 0) + '\n' + usage_of(command);
  const auto options_where = [&](const auto& is_shown) {
    std::vector<const CLI::Option*> all;
    for (const CLI::Option* option : command.get_options())
      if (is_shown(*option)) all.push_back(option);
    return all;
  };
  text += help_rows("Arguments", options_where([](const CLI::Option& each) { return each.get_positional(); }));
  std::string commands;
  for (const CLI::App* verb : verbs_of(command)) commands += help_row(verb->get_name(), verb->get_description());
  if (!commands.empty()) text += "\nCommands:\n" + commands;
  for (const std::string_view group : kOptionGroups)
    text +=
        help_rows(std::string(group),
                  options_where([&](const CLI::Option& each) { return !each.get_positional() && each.get_group() == group; }));
  if (const std::vector<Example> examples = examples_of(full_name(command)); !examples.empty()) {
    text += "\nExamples:\n";
    for (const Example& example : examples) text += std::string("  ") + example.line + '\n';
  }
  return text + '\n' + command.get_footer() + '\n';
}

}  // namespace forceshade::apps
