// SPDX-License-Identifier: BSD-3-Clause
// forceshade completion: what a shell completes.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "forceshade/apps/command.h"
#include "forceshade/apps/documentation.h"
#include "forceshade/apps/options.h"

namespace forceshade::apps {
namespace {

std::vector<const CLI::App*> verbs_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

// What the value of an option may be.
struct Values {
  std::string words;       // between spaces
  const char* files = "";  // of bash's compgen: -f files, -d folders
  bool optional = false;
};

std::string law_names(const CLI::Option& option) {
  std::string names = option.get_description().starts_with("all") ? "all" : "";
  for (const LawName& law : kLaws) names += ' ' + std::string(law.name);
  return names;
}

Values values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const bool optional = option.get_expected_min() == 0;
  if (type == "FILE" || type == "SPEC" || type == "[FILE]") return {"", "-f", optional};
  if (type == "DIR") return {"", "-d", optional};
  if (type == "DEVICE") return {"null replay: simulated phantom", "", optional};
  if (type == "ID") return {law_names(option), "", optional};
  if (type == "bash") return {type, "", optional};
  if (type == "LIST") return {"directions heights lines", "", optional};
  if (type.find('|') == std::string::npos) return {};
  std::string words = type;
  std::replace(words.begin(), words.end(), '|', ' ');
  return {words, "", optional};
}

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
    if (option->get_type_name() == "COMMAND")
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
    tables.commands << "      '" << name << ' ' << verb->get_name() << "') command+=\" ${COMP_WORDS[i]}\" ;;\n";
    add(*verb, tables);
  }
  tables.words << "    '" << name << "') words='" << words.substr(words.empty() ? 0 : 1)
               << (positional.words.empty() ? "" : " ") << positional.words << "' files='" << positional.files << "' ;;\n";
}

constexpr const char* kHead = R"(# bash completion for forceshade: written by 'forceshade completion bash'
_forceshade() {
  local current=${COMP_WORDS[COMP_CWORD]} at=$((COMP_CWORD - 1)) command=forceshade i value= words= files= optional=1
  # --option=value is three words to bash.
  if [ "$current" = '=' ]; then current=; elif [ "${COMP_WORDS[at]}" = '=' ]; then at=$((at - 1)); fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$command ${COMP_WORDS[i]}" in
)";
constexpr const char* kBetween = R"(    esac
  done
  case "$command ${COMP_WORDS[at]}" in
)";
constexpr const char* kThen = R"(    *) value=none ;;
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
constexpr const char* kTail = R"(    esac
    [ -z "$files" ] || found+=$'\n'$(compgen "$files" -- "$current")
    found+=$'\n'$(compgen -W "$words" -- "$current")
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
  return kHead + tables.commands.str() + kBetween + tables.values.str() + kThen + tables.words.str() + kTail;
}

void add_completion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", "Print what a shell loads to complete forceshade's commands and options");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "the shell")->type_name("bash")->required()->check(one_of({"bash"}));
  command->callback([&app, shell] { std::fputs(bash_completion(app).c_str(), stdout); });
}

}  // namespace forceshade::apps
