#!/usr/bin/env bash
# documentation_test.sh FORCESHADE: every command and option that --help shows stands in the man pages and is completed by bash;
# man, mandoc and zsh are tried where they are installed.
set -u
forceshade=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
checks=0
fail() { echo "FAILED: $*"; exit 1; }

"$forceshade" man --out pages || fail "no man pages were written"
"$forceshade" completion bash > forceshade.bash || fail "no completion was written"
. ./forceshade.bash || fail "bash cannot read the completion"

# complete_words WORD...: sets COMPREPLY to what bash completes after the words; the last one is begun, and may be empty. The same
# words again are not completed again.
completed=
complete_words() {
  [ "$*" != "$completed" ] || return 0
  COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=() completed=$*
  _forceshade
}
# completes EXPECTED WORD...: EXPECTED is among them.
completes() {
  local expected=$1 word; shift
  checks=$((checks + 1))
  complete_words "$@"
  for word in "${COMPREPLY[@]}"; do [ "$word" != "$expected" ] || return 0; done
  fail "bash completes $* with: ${COMPREPLY[*]}; expected $expected"
}
# has_line PATTERN TEXT: whether a line of the text matches the extended regular expression as a whole. Without a process, of
# which this test would start thousands.
has_line() { [[ $'\n'$2$'\n' =~ $'\n'($1)$'\n' ]]; }

# helped COMMAND: sets `help` to its help, for which the command is asked once, and `verbs` to those that this lists.
declare -A helps
helped() {
  [ -n "${helps[-$1]-}" ] || helps[-$1]=$("$forceshade" $1 --help)
  help=${helps[-$1]} verbs=$(sed -n '/^Commands:/,/^$/ s/^  \([a-z]*\) .*/\1/p' <<< "$help")
}
commands=("")
helped ""
for command in $verbs; do
  commands+=("$command")
  helped "$command"
  for verb in $verbs; do commands+=("$command $verb"); done
done
[ ${#commands[@]} -ge 21 ] || fail "found only these commands: ${commands[*]}"

for tool in groff mandoc zsh; do
  command -v $tool > /dev/null || echo "skipped: what needs $tool, which is not there (Debian package $tool)"
done
for command in "${commands[@]}"; do
  read -ra words <<< "$command"
  page=pages/$(echo forceshade $command | tr ' ' -).1
  [ -s "$page" ] || fail "$page is missing"
  [ "$("$forceshade" man "${words[@]}")" = "$(< "$page")" ] || fail "man $command prints another page than $page"
  plain=$(sed -e 's/\\-/-/g' -e 's/\\f[BIR]//g' "$page")
  helped "$command"
  options=$(grep -o '^  \(-[hv], \)\?--[a-z-]*' <<< "$help" | sed 's/.*--/--/' | sort)
  for option in $options; do
    has_line "(-[hv], )?$option( [^"$'\n'"]*)?" "$plain" || fail "$page lacks $option"
    completes "$option" forceshade "${words[@]}" "${option:0:4}"
    checks=$((checks + 1))
  done
  for verb in $verbs; do
    has_line "\\.B $verb" "$plain" || fail "$page lacks $verb"
    completes "$verb" forceshade "${words[@]}" "${verb:0:2}"
  done
  ! LC_ALL=C grep -q '[^ -~]' "$page" || fail "$page has something that is not ASCII"
  checks=$((checks + 1))
  if command -v groff > /dev/null; then
    warnings=$(groff -man -Tutf8 -ww "$page" 2>&1 > rendered) || fail "groff cannot render $page"
    [ -z "$warnings" ] || fail "groff: $page: $warnings"
    [ -s rendered ] || fail "groff renders nothing of $page"
  fi
  if command -v mandoc > /dev/null; then mandoc -Tlint -W warning "$page" > lint || fail "mandoc: $(cat lint)"; fi
done

# Values: words, laws, files, folders; after =; and of an option whose value may be left out.
mkdir folder; touch 'a file.csv'
completes observer forceshade drive --passivity o
completes bump-2p-shaded forceshade energy --law bump-2p-
completes all forceshade certify --law a
completes bump-1p forceshade energy --law = bump-1
completes 'a file.csv' forceshade force a
completes folder forceshade plot --out f
completes 'a file.csv' forceshade energy --json a
completes --depth forceshade energy --json --de
completes recording forceshade man rec
completes bash forceshade completion b
completes 'a file.csv' forceshade recording check a
completes simulated forceshade drive --device s
completes simulated forceshade device check s
complete_words forceshade energy --law wal
[ "${COMPREPLY[*]}" = wall ] || fail "after --law wal is completed: ${COMPREPLY[*]}"
complete_words forceshade energy --depth ''
[ ${#COMPREPLY[@]} = 0 ] || fail "a number is completed: ${COMPREPLY[*]}"

# zsh reads the same after bashcompinit; what it adds is printed here instead.
if command -v zsh > /dev/null; then
  cat > called.zsh << 'EOF'
autoload -Uz compinit bashcompinit; compinit -u -D; bashcompinit
source ./forceshade.bash
compadd() { print -l -- "$@"; }
words=("$@") CURRENT=$# PREFIX=${@[-1]}
_bash_complete -F _forceshade
EOF
  added() {  # EXPECTED WORD...
    checks=$((checks + 1))
    zsh -f called.zsh "${@:2}" | grep -qxF -e "$1" || fail "zsh completes ${*:2} with: $(zsh -f called.zsh "${@:2}" | tr '\n' ' '); expected $1"
  }
  added observer forceshade drive --passivity ''
  added bump-2p-shaded forceshade energy --law ''
  added --depth forceshade energy --json ''
  added check forceshade device ''
fi
echo "$checks checks passed"
