// SPDX-License-Identifier: BSD-3-Clause
// forceshade completion: what a shell completes.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "apps/command.h"
#include "apps/documentation.h"
#include "apps/options.h"
#include "device/kinds.h"

namespace forceshade::apps {
namespace {

// The values that an option may have.
struct Values {
  std::string words;       // between spaces
  const char* files = "";  // -f files, -d folders
  bool optional = false;
};

std::string law_names(const CLI::Option& option) {
  std::string names = option.get_description().starts_with("all") ? "all" : "";
  for (const LawName& law : kLaws) names += ' ' + std::string(law.name);
  return names;
}

// "null replay: simulated phantom": a colon where more has to follow.
std::string device_words() {
  std::string words;
  for (const device::Kind& kind : device::kinds())
    words += (words.empty() ? "" : " ") + std::string(kind.name) + (kind.rest.starts_with(':') ? ":" : "");
  return words;
}

Values values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const bool optional = option.get_expected_min() == 0;
  if (type == "FILE" || type == "SPEC" || type == "[FILE]") return {"", "-f", optional};
  if (type == "DIR") return {"", "-d", optional};
  if (type == "DEVICE") return {device_words(), "", optional};
  if (type == "ID") return {law_names(option), "", optional};
  if (type == "[LIST]") return {"directions heights lines", "", optional};
  if (type == "bash") return {"bash", "", optional};
  if (type.find('|') == std::string::npos) return {};
  std::string words = type;
  std::replace(words.begin(), words.end(), '|', ' ');
  return {words, "", optional};
}

// The branches of three case commands.
struct Tables {
  std::ostringstream commands, values, words;
};

void add(const CLI::App& command, Tables& tables) {
  const std::string name = full_name(command);
  std::string words;
  Values positional;
  for (const CLI::Option* option : command.get_options()) {
    const Values values = option->get_expected_max() > 0 ? values_of(*option) : Values{};
    if (option->get_positional()) positional = values;
    if (option->get_positional() && option->get_type_name() == "COMMAND")
      for (const CLI::App* other : verbs_of(*command.get_parent())) positional.words += ' ' + other->get_name();
    for (const std::string& long_name : option->get_lnames()) {
      words += " --" + long_name;
      if (option->get_expected_max() > 0)
        tables.values << "    '" << name << " --" << long_name << "') value='" << values.words << "' files='" << values.files
                      << "' optional=" << (values.optional ? 1 : 0) << " ;;\n";
    }
  }
  for (const CLI::App* verb : verbs_of(command)) {
    words += ' ' + verb->get_name();
    tables.commands << "      '" << name << ' ' << verb->get_name() << "') command+=\" $word\" ;;\n";
    add(*verb, tables);
  }
  tables.words << "    '" << name << "') known='" << words.substr(words.empty() ? 0 : 1)
               << (positional.words.empty() ? "" : " ") << positional.words << "' files='" << positional.files << "' ;;\n";
}

constexpr const char* kBashHead = R"(# bash completion for forceshade: written by 'forceshade completion bash'
_forceshade() {
  local current=${COMP_WORDS[COMP_CWORD]} at=$((COMP_CWORD - 1)) command=forceshade i word value= known= files= optional=1
  # --option=value is three words to bash.
  if [ "$current" = '=' ]; then current=; elif [ "${COMP_WORDS[at]}" = '=' ]; then at=$((at - 1)); fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    case "$command $word" in
)";
constexpr const char* kBashBetween = R"(    esac
  done
  case "$command ${COMP_WORDS[at]}" in
)";
constexpr const char* kBashThen = R"(    *) value=none ;;
  esac
  local found=
  if [ "$value" = none ]; then
    value=; optional=1
  else
    [ -z "$files" ] || found=$(compgen "$files" -- "$current")
    found+=$'\n'$(compgen -W "$value" -- "$current")
  fi
  if [ "$optional" = 1 ]; then
    files=
    case "$command" in
)";
constexpr const char* kBashTail = R"(    esac
    [ -z "$files" ] || found+=$'\n'$(compgen "$files" -- "$current")
    found+=$'\n'$(compgen -W "$known" -- "$current")
  fi
  COMPREPLY=()
  while IFS= read -r i; do [ -z "$i" ] || COMPREPLY+=("$i"); done <<< "$found"
  compopt -o filenames 2> /dev/null
}
complete -F _forceshade forceshade
)";

}  // namespace

std::string bash_completion(const CLI::App& program) {
  Tables tables;
  add(program, tables);
  return of_program(kBashHead) + tables.commands.str() + kBashBetween + tables.values.str() + kBashThen + tables.words.str() +
         of_program(kBashTail);
}

void add_completion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", of_program("Print what a shell loads to complete forceshade's commands and options"));
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "the shell; zsh reads what is written for bash, after compinit and bashcompinit")
      ->type_name("bash")
      ->required()
      ->check(one_of({"bash"}));
  command->callback([&app, shell] { std::fputs(bash_completion(app).c_str(), stdout); });
}

}  // namespace forceshade::apps
