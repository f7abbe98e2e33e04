// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Man pages and shell completion, written from the definitions of the commands themselves, so that neither can lack an option.

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::apps {

// The help that holds for every command, in lines of at most 100 characters.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 held, 1 a check failed or driving is not allowed, 2 bad usage or input, 3 device\n"
    "fault or safety trip, 130 interrupted; a run on a device that has begun ends with 0.";
inline constexpr const char* kQuantities =
    "A LENGTH is in mm, a STIFFNESS in N/mm, an ANGLE in degrees, or has a unit: 25.4mm, 2.54cm, 0.01m,\n"
    "1000mil, 1in; 0.5N/mm, 500N/m; 30deg, 0.5rad.";
inline constexpr const char* kFiles =
    "The file - is standard input or output. A file that is there already is replaced only with\n"
    "--overwrite.";
inline constexpr const char* kWhereMoreIs =
    "'forceshade help' explains units, files and exit codes; 'forceshade man' prints pages.";

std::vector<const CLI::App*> verbs_of(const CLI::App& command);

// "forceshade device check"
std::string full_name(const CLI::App& command);

// It begins with a capital, unless with a symbol such as w, and ends with a full stop.
std::string sentence(std::string text);

// The option's purpose, whether it is required, its default, and the options that it needs or excludes, in sentences.
std::string words_of(const CLI::Option& option);

// A command line as it may be typed, and what it shows.
struct Example {
  std::string_view command;  // its full name without that of the program
  const char *line, *what;
};
std::vector<Example> examples_of(std::string_view full_name);

// The text with the name of the program that runs in the place of "forceshade".
std::string of_program(std::string text);

// The text of --help.
std::string help_text(const CLI::App& command);

// The page of one command in roff (man macros). It has no date, so that the same program writes the same page.
std::string man_page(const CLI::App& command, const std::string& version);

// For bash: commands, options, and the values of options that are words, files or folders.
std::string bash_completion(const CLI::App& program);

// forceshade man and forceshade completion. Call last: they describe what was added before and themselves.
void add_man(CLI::App& app);
void add_completion(CLI::App& app);

}  // namespace forceshade::apps
