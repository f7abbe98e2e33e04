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
  if (type.find('|') == std::string::npos) return {};
  std::string words = type;
  std::replace(words.begin(), words.end(), '|', ' ');
  return {words, "", optional};
}

// The branches of three case commands, which bash and zsh read alike.
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

constexpr const char* kZshHead = R"(#compdef forceshade
# zsh completion for forceshade: written by 'forceshade completion zsh'
_forceshade_values() {  # words, -f or -d or nothing
  case "$2" in
    -f) _files ;;
    -d) _files -/ ;;
  esac
  [[ -z $1 ]] || compadd -- ${=1}
}
_forceshade() {
  local command=forceshade before=${words[CURRENT-1]} i word value= known= files= optional=1
  for ((i = 2; i < CURRENT; i++)); do
    word=${words[i]}
    case "$command $word" in
)";
constexpr const char* kZshBetween = R"(    esac
  done
  # --option=value is one word to zsh.
  if [[ $PREFIX == --*=* ]]; then
    before=${PREFIX%%=*}
    compset -P '*='
  fi
  case "$command $before" in
)";
constexpr const char* kZshThen = R"(    *) value=none ;;
  esac
  if [[ $value == none ]]; then
    optional=1
  else
    _forceshade_values "$value" "$files"
  fi
  if [[ $optional == 1 ]]; then
    files=
    case "$command" in
)";
constexpr const char* kZshTail = R"(    esac
    _forceshade_values "$known" "$files"
  fi
}
# Found by its name in $fpath, this file is the function; read with `source`, it has to register it.
if [[ ${funcstack[1]} == _forceshade ]]; then _forceshade "$@"; else compdef _forceshade forceshade; fi
)";

// In single quotes, for fish.
std::string quoted(const std::string& text) {
  std::string in_quotes = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') in_quotes += '\\';
    in_quotes += c;
  }
  return in_quotes + '\'';
}

// The words of fish for the values of an option or of a word without a name.
std::string fish_values(const Values& values) {
  std::string words = values.words.empty() ? "" : " -a " + quoted(values.words);
  if (std::string(values.files) == "-f") return words + " -F";
  if (std::string(values.files) == "-d") return words + " -a '(__fish_complete_directories)'";
  return words;
}

// A line for each verb, option and positional word of the command, and of its verbs.
void add_for_fish(const CLI::App& command, std::ostream& names, std::ostream& lines) {
  const std::string name = full_name(command);
  const std::string line = of_program("complete -c forceshade -n '__forceshade_is \"") + name + "\"'";
  for (const CLI::Option* option : command.get_options()) {
    const bool has_value = option->get_expected_max() > 0;
    const Values values = has_value ? values_of(*option) : Values{};
    if (option->get_positional() && !fish_values(values).empty()) lines << line << fish_values(values) << '\n';
    if (option->get_positional() && option->get_type_name() == "COMMAND")
      for (const CLI::App* other : verbs_of(*command.get_parent())) lines << line << " -a " << other->get_name() << '\n';
    for (const std::string& long_name : option->get_lnames()) {
      lines << line << " -l " << long_name;
      if (has_value && !values.optional) lines << (std::string(values.files) == "-f" ? " -r" : " -x") << fish_values(values);
      lines << " -d " << quoted(option->get_description()) << '\n';
      // fish has no option whose value may be left out: what may follow is a word without a name.
      if (has_value && values.optional)
        lines << of_program("complete -c forceshade -n '__forceshade_is \"") << name << "\" --" << long_name << '\''
              << fish_values(values) << '\n';
    }
  }
  for (const CLI::App* verb : verbs_of(command)) {
    names << ' ' << quoted(name + ' ' + verb->get_name());
    lines << line << " -a " << verb->get_name() << " -d " << quoted(verb->get_description()) << '\n';
    add_for_fish(*verb, names, lines);
  }
}

constexpr const char* kFishHead = R"(# fish completion for forceshade: written by 'forceshade completion fish'
# __forceshade_is COMMAND [OPTION]: whether the words before the cursor name this command, and the option is the last of them.
function __forceshade_is
    set -l before (commandline -opc)
    set -l command forceshade
    for word in $before[2..]
        contains -- "$command $word")";
constexpr const char* kFishThen = R"(
        and set command "$command $word"
    end
    test "$command" = "$argv[1]"; and begin
        not set -q argv[2]; or test "$before[-1]" = "$argv[2]"
    end
end
complete -c forceshade -f
)";

}  // namespace

std::string bash_completion(const CLI::App& program) {
  Tables tables;
  add(program, tables);
  return of_program(kBashHead) + tables.commands.str() + kBashBetween + tables.values.str() + kBashThen + tables.words.str() +
         of_program(kBashTail);
}

std::string zsh_completion(const CLI::App& program) {
  Tables tables;
  add(program, tables);
  return of_program(kZshHead) + tables.commands.str() + kZshBetween + tables.values.str() + of_program(kZshThen) +
         tables.words.str() + of_program(kZshTail);
}

std::string fish_completion(const CLI::App& program) {
  std::ostringstream names, lines;
  add_for_fish(program, names, lines);
  return of_program(kFishHead) + names.str() + of_program(kFishThen) + lines.str();
}

void add_completion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", of_program("Print what a shell loads to complete forceshade's commands and options"));
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "the shell")
      ->type_name("bash|zsh|fish")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  command->callback([&app, shell] {
    const auto completion = *shell == "bash" ? bash_completion : *shell == "zsh" ? zsh_completion : fish_completion;
    std::fputs(completion(app).c_str(), stdout);
  });
}

}  // namespace forceshade::apps
