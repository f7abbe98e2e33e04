// SPDX-License-Identifier: BSD-3-Clause
#include "apps/program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/standard_streams.h"
#include "apps/subject_file.h"
#include "apps/tell.h"
#include "apps/troubleshooting.h"
#include "certificate/build.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/suggestion.h"
#include "forceshade/checks.h"
#include "forceshade/device.h"

namespace forceshade::apps {
namespace {

// The one that runs.
std::span<const Example> examples;

void print_lines(const std::string& text) {
  std::istringstream lines(with_page(text));
  for (std::string line; std::getline(lines, line);) std::cerr << files::printable(line) << '\n';
}

// `help` and `version` are words for --help and --version: forceshade help device check.
std::vector<std::string> with_words_for_flags(std::vector<std::string> words) {
  if (words.empty()) return words;
  if (words.front() == "version") words.front() = "--version";
  if (words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

// The command that the words begin with, and how many of them name it.
std::pair<const CLI::App*, std::size_t> command_in(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::size_t count = 0;
  for (; count < words.size(); ++count) {
    const auto below = command->get_subcommands([&](const CLI::App* each) { return each->get_name() == words[count]; });
    if (below.empty()) break;
    command = below.front();
  }
  return {command, count};
}

// The present words for the first former ones, a verb or an option; empty where no word is a former one.
std::string fault_of_former_words(const CLI::App& app, std::span<const FormerWords> former,
                                  const std::vector<std::string>& words) {
  const auto [command, count] = command_in(app, words);
  std::string name;
  for (std::size_t i = 0; i < count; ++i) name += words[i] + ' ';
  for (std::size_t i = count; i < words.size(); ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (i > count && !word.starts_with("-")) continue;
    const bool is_of_any = word.starts_with("--") && command->get_option_no_throw(word) == nullptr;
    for (const auto& [its, now, remark] : former) {
      const bool is_listed =
          is_of_any && its.starts_with("--") && (std::string(its) + ' ').find(word + ' ') != std::string::npos;
      if (is_listed || its == name + word)
        return '"' + (is_listed ? word : name + word) + "\" is " +
               (now.empty() ? "not needed" : "'" + std::string(now) + "' now") + std::string(remark);
    }
  }
  return "";
}

// The reason why the first word is no command; empty where it is one, or a flag of the program.
std::string fault_of_first_word(const CLI::App& app, std::span<const FormerWords> former,
                                const std::vector<std::string>& words) {
  if (words.empty()) return "";
  if (const std::string now = fault_of_former_words(app, former, words); !now.empty()) return now;
  const std::string& first = words.front();
  std::vector<std::string> names;
  for (const CLI::App* command : verbs_of(app)) names.push_back(command->get_name());
  const auto listed = [&] {
    std::string all;
    for (const std::string& name : names) all += ' ' + name;
    return all;
  };
  if (first.starts_with("-")) {
    if (app.get_option_no_throw(first) != nullptr) return "";
    return "expected a command before the option \"" + first + "\", one of:" + listed();
  }
  if (std::ranges::find(names, first) != names.end()) return "";
  return "unknown command \"" + first + "\"; expected one of:" + listed() + files::suggestion(first, names);
}

// Drops --help where the word behind `mesh` or another group is not one of its commands, so that this is reported.
std::vector<std::string> without_help_of_no_command(const CLI::App& app, std::vector<std::string> words) {
  const auto [command, count] = command_in(app, words);
  if (command->get_require_subcommand_min() > 0 && count < words.size() && !words[count].starts_with("-"))
    std::erase_if(words, [](const std::string& each) { return each == "--help" || each == "-h"; });
  return words;
}

bool takes(const char* option, const CLI::App& app, const std::vector<std::string>& words) {
  return command_in(app, words).first->get_option_no_throw(option) != nullptr;
}

int report(const CLI::App& app, const CLI::ParseError& error, const ExpandedLine& line) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    std::ostringstream text;  // not std::cout: it would be flushed where a failure goes unseen
    app.exit(error, text, std::cerr);
    std::fputs(text.str().c_str(), stdout);
    return kHeld;
  }
  std::cerr << program_name() << ": " << line.placed(failure_message(app, error));
  return kBadInput;
}

// Adds all commands, or the one alone that the first word names: the others would take three milliseconds of each start.
void add_commands(CLI::App& app, std::span<const Command> commands, const std::vector<std::string>& words, int& result) {
  const bool is_one = !words.empty() && std::ranges::count(commands, words.front(), &Command::name) > 0;
  for (const auto& [name, add] : commands)
    if (!is_one || words.front() == name) add(app, result);
  if (is_one) return;
  add_man(app);
  add_completion(app);
}

int run(const Program& program, const std::vector<std::string>& arguments) {
  CLI::App app(program.description, program.name);
  app.set_version_flag("-v,--version", [] {
    const properties::Build build = properties::current_build();
    return program_name() + ' ' + build.version + "\nrevision         " + build.revision + "\ncompiler         " +
           build.compiler + "\ninstruction set  " + build.instruction_set + "\nlibrary digest   " + build.library_digest;
  });
  app.require_subcommand(1);
  app.formatter_fn([](const CLI::App* command, const std::string&, CLI::AppFormatMode) { return help_text(*command); });
  app.footer(of_program(kWhereMoreIs));  // of each command
  int result = kHeld;
  ExpandedLine line{with_words_for_flags(arguments)};
  add_commands(app, program.commands, line.words, result);
  refuse_empty_values(app);
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) refuse_options_before_verbs(*command);
  app.footer(
      std::string(kQuantities) + '\n' + kFiles + '\n' + kExitCodes +
      of_program("\n'forceshade help COMMAND' explains a command,\n'forceshade man COMMAND | man -l -' shows its page.\n") +
      "Pages such as docs/using.md lie in the sources, and in share/doc/forceshade of an installation.");
  if (const std::string fault = fault_of_first_word(app, program.former, line.words); !fault.empty()) {
    tell(fault);
    return kBadInput;
  }
  line.words = without_help_of_no_command(app, std::move(line.words));
  try {
    if (takes("--subject", app, line.words)) line = expand_subject_files(line.words, takes("--damping", app, line.words));
    app.parse(std::vector<std::string>(line.words.rbegin(), line.words.rend()));  // CLI11 takes them from the back
  } catch (const CLI::ParseError& error) {
    return report(app, error, line);
  } catch (const device::DeviceError& error) {
    // Several lines: what was tried and what to check.
    std::cerr << program_name() << ": ";
    print_lines("device fault: " + std::string(error.what()));
    return kDeviceFault;
  } catch (const Interrupted& error) {
    const std::string undone = error.what(), unsaid = Interrupted().what();
    tell("interrupted" + (undone == unsaid ? "" : ": " + undone));
    return kInterrupted;
  } catch (const Error& error) {
    std::cerr << program_name() << ": ";
    print_lines(error.has_lines() ? error.what() : files::printable(line.placed(error.what())));
    return kBadInput;
  } catch (const std::exception& error) {
    tell(line.placed(error.what()));
    return kBadInput;
  }
  return result;
}

}  // namespace

std::vector<Example> examples_of(std::string_view full_name) {
  std::vector<Example> all;
  for (const Example& example : examples)
    if (full_name == program_name() + ' ' + std::string(example.command)) all.push_back(example);
  return all;
}

int run_program(const Program& program, const std::vector<std::string>& arguments) {
  program_name() = program.name;
  examples = program.examples;
  open_standard_streams();
  const int result = run(program, arguments);
  remove_unused_directories();
  try {
    flush_standard_output();
  } catch (const files::OutputError& error) {
    tell(error.what());
    return result == kHeld ? kBadInput : result;
  }
  return result;
}

}  // namespace forceshade::apps
