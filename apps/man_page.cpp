// SPDX-License-Identifier: BSD-3-Clause
// forceshade man: the pages of section 1.

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

#include "apps/command.h"
#include "apps/documentation.h"
#include "apps/output_options.h"
#include "apps/tell.h"
#include "certificate/build.h"
#include "files/output_folder.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

// As text of roff: no character of it is a request, an escape, or a dash or quote that would be set as another one.
std::string roff(const std::string& text) {
  std::string all;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) all += "\\&";
    switch (c) {
      case '\\': all += "\\e"; break;
      case '-': all += "\\-"; break;
      case '\'': all += "\\(aq"; break;
      case '`': all += "\\(ga"; break;
      case '^': all += "\\(ha"; break;
      case '~': all += "\\(ti"; break;
      case '"': all += "\\(dq"; break;
      default: all += c;
    }
    begins_line = c == '\n';
  }
  return all;
}

std::string joined_names(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;  // in the same order every time
  for (const CLI::Option* option : options) names.insert(option->get_name());
  return joined(names, ", ");
}

bool is_positional(const CLI::Option& option) {
  return option.get_positional();
}

// "-h, --help" or "--law ID"; a positional is its type.
std::string synopsis(const CLI::Option& option) {
  const std::string type = option.get_expected_max() > 0 ? option.get_type_name() : "";
  if (is_positional(option)) return "\\fI" + roff(type) + "\\fR" + (option.get_expected_max() > 1 ? "..." : "");
  std::string names;
  for (const std::string& name : option.get_snames())
    names += (names.empty() ? "" : ", ") + ("\\fB" + roff("-" + name) + "\\fR");
  for (const std::string& name : option.get_lnames())
    names += (names.empty() ? "" : ", ") + ("\\fB" + roff("--" + name) + "\\fR");
  return type.empty() ? names : names + " \\fI" + roff(type) + "\\fR";
}

std::string described(const CLI::Option& option) {
  return ".TP\n" + synopsis(option) + '\n' + roff(words_of(option)) + '\n';
}

std::string page_name(const CLI::App& command) {
  std::string name = full_name(command);
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

// The command and all below it.
std::vector<const CLI::App*> tree(const CLI::App& command) {
  std::vector<const CLI::App*> all{&command};
  for (const CLI::App* verb : verbs_of(command))
    for (const CLI::App* below : tree(*verb)) all.push_back(below);
  return all;
}

// Its own; where it has none, those of the commands below it, of which the program shows one each.
std::vector<Example> examples_for_page(const CLI::App& command) {
  std::vector<Example> all = examples_of(full_name(command));
  if (!all.empty()) return all;
  for (const CLI::App* verb : verbs_of(command)) {
    const std::vector<Example> its = examples_for_page(*verb);
    all.insert(all.end(), its.begin(), command.get_parent() == nullptr && !its.empty() ? its.begin() + 1 : its.end());
  }
  return all;
}

const CLI::App& found(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* command = &program;
  for (const std::string& word : words) {
    const std::vector<const CLI::App*> verbs = verbs_of(*command);
    const auto verb = std::ranges::find(verbs, word, [](const CLI::App* each) { return each->get_name(); });
    if (verb == verbs.end()) throw Error("man: expected the name of a command, got \"" + word + '"');
    command = *verb;
  }
  return *command;
}

}  // namespace

std::vector<const CLI::App*> verbs_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : full_name(*parent) + ' ') + command.get_name();
}

std::string of_program(std::string text) {
  constexpr std::string_view kName = "forceshade";
  for (std::size_t at = text.find(kName); at != std::string::npos; at = text.find(kName, at + program_name().size()))
    text.replace(at, kName.size(), program_name());
  return text;
}

std::string sentence(std::string text) {
  const bool is_symbol = text.size() > 1 && text[1] == ',';
  if (!text.empty() && !is_symbol) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') || text.empty() ? text : text + '.';
}

std::string words_of(const CLI::Option& option) {
  std::string words = sentence(option.get_description());
  const bool has_optional_value = option.get_expected_min() == 0;
  if (option.get_required()) words += " Required.";
  if (!option.get_default_str().empty() && !has_optional_value) words += " Default: " + option.get_default_str() + '.';
  if (const std::string needs = joined_names(option.get_needs()); !needs.empty()) words += " Only with " + needs + '.';
  if (const std::string others = joined_names(option.get_excludes()); !others.empty()) words += " Not with " + others + '.';
  return words;
}

std::string man_page(const CLI::App& command, const std::string& version) {
  const std::string name = page_name(command);
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string page = ".TH " + roff(title) + " 1 \"\" \"" + roff(program_name() + ' ' + version) + "\" \"User Commands\"\n";
  page += ".SH NAME\n" + roff(name) + " \\- " + roff(command.get_description()) + '\n';
  page += ".SH SYNOPSIS\n.B " + roff(full_name(command)) + '\n';
  const std::vector<const CLI::App*> verbs = verbs_of(command);
  std::string options, arguments;
  for (const CLI::Option* option : command.get_options()) {
    (is_positional(*option) ? arguments : options) += described(*option);
    if (!is_positional(*option)) continue;
    page += option->get_required() ? synopsis(*option) + '\n' : '[' + synopsis(*option) + "]\n";
  }
  page += "[\\fIOPTIONS\\fR]\n";
  if (!verbs.empty())
    page += (command.get_require_subcommand_min() > 0 ? "\\fICOMMAND\\fR" : "[\\fICOMMAND\\fR]") + std::string("\n");
  page += ".SH DESCRIPTION\n" + roff(sentence(command.get_description())) + '\n';
  if (!arguments.empty()) page += ".SH ARGUMENTS\n" + arguments;
  page += ".SH OPTIONS\n" + options;
  if (!verbs.empty()) page += ".SH COMMANDS\n";
  for (const CLI::App* verb : verbs)
    page += ".TP\n.B " + roff(verb->get_name()) + '\n' + roff(sentence(verb->get_description())) + '\n';
  if (const std::vector<Example> examples = examples_for_page(command); !examples.empty()) {
    page += ".SH EXAMPLES\n";
    for (const Example& example : examples)
      page += ".PP\n" + roff(sentence(example.what)) + "\n.PP\n.nf\n.RS\n" + roff(example.line) + "\n.RE\n.fi\n";
  }
  page += std::string(".SH QUANTITIES AND FILES\n") + roff(kQuantities) + '\n' + roff(kFiles) + '\n';
  page += std::string(".SH EXIT STATUS\n") + roff(kExitCodes) + '\n';
  std::string others;
  if (command.get_parent() != nullptr) others = ".BR " + roff(page_name(*command.get_parent())) + " (1)";
  for (const CLI::App* verb : verbs) others += (others.empty() ? "" : ",\n") + (".BR " + roff(page_name(*verb)) + " (1)");
  return page + ".SH SEE ALSO\n" + others + '\n';
}

void add_man(CLI::App& app) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page of a command, for man -l -, or write all of them");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *words, "for instance: device check; default: the program itself")->type_name("COMMAND");
  const auto out = std::make_shared<OutFolder>(*command, "directory for the pages of all commands, instead of printing one");
  command->callback([&app, words, out] {
    const std::string version = properties::current_build().version;
    if (out->path().empty()) {
      std::fputs(man_page(found(app, *words), version).c_str(), stdout);
      return;
    }
    if (!words->empty()) throw Error("--out: expected no command beside it, got \"" + words->front() + '"');
    std::vector<std::string> names;
    for (const CLI::App* each : tree(app)) names.push_back(page_name(*each) + ".1");
    out->expect_room_for(names);
    files::OutputFolder& folder = out->folder();
    for (const CLI::App* each : tree(app)) folder.write(page_name(*each) + ".1", man_page(*each, version));
    folder.commit();
  });
}

}  // namespace forceshade::apps
