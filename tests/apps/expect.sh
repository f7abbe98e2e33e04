# Read by the tests of the command: checks of what it prints, its exit code and its files. $1 of the test is the command.
set -u
forceshade=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
examples=$(realpath "$here/../../examples")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/.bin"
cd "$scratch"
checks=0
# If python3 is a script that looks for the program, as pyenv's is, each start of it takes ten times as long. A test whose programs need
# the standard library alone starts them with python_options=-SE, which halves the rest.
if grep -q 'python3\|\.py' "$here/${0##*/}"; then
  python=${python:-$(python3 -c "import sys; print(sys.executable)")}
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$python" "${python_options:-}" > "$scratch/.bin/python3"
  chmod +x "$scratch/.bin/python3"
  PATH=$scratch/.bin:$PATH
fi

# expect CODE WORDS -- COMMAND...: runs it, expects the exit code, and WORDS (a fixed string) in what it prints.
expect() {
  local code=$1 words=$2; shift 3
  printed=$("$@" 2>&1 < /dev/null); local got=$?
  if [ $got -ne "$code" ]; then echo "FAILED: $*: expected exit code $code, got $got: $printed"; exit 1; fi
  also "$words"
}
# also WORDS...: each of them is in what the last command of expect printed, too.
also() {
  local words
  for words; do
    checks=$((checks + 1))
    case "$printed" in *"$words"*) ;; *) echo "FAILED: expected \"$words\", got: $printed"; exit 1 ;; esac
  done
}
# same EXPECTED GOT: two texts.
same() {
  checks=$((checks + 1))
  [ "$1" = "$2" ] || { echo "FAILED: expected: $1"; echo "got: $2"; exit 1; }
}
# stopped SIGNAL: sends it to what was started last in the background, once that has a handler for it, and waits for the end.
stopped() {
  local process=$! caught=0
  until (((16#$caught >> ($(kill -l "$1") - 1)) & 1)); do
    sleep 0.02
    caught=$(sed -n 's/^SigCgt:\t//p; s/^State:\tZ.*/ended/p' "/proc/$process/status")
    case $caught in "" | ended*) echo "FAILED: it ended before signal $1"; exit 1 ;; esac
  done
  kill -"$1" "$process"; wait "$process"
}
# fits SCHEMA FILE...: JSON that is as the schema says, where there is a program that can say so.
fits() {
  checks=$((checks + 1))
  "$python" - "$@" << 'END' || exit 1
import json, sys
try:
    import jsonschema
except ImportError:
    sys.exit(print("skipped: the schema, since jsonschema is not there (Debian package python3-jsonschema)"))
schema, *files = [json.load(open(file)) for file in sys.argv[1:]]
jsonschema.Draft7Validator.check_schema(schema)
for file in files:
    jsonschema.Draft7Validator(schema).validate(file)
END
}
# changed PROGRAM [ORIGINAL REPLACEMENT]...: writes the mutated program, with these words, which are there once, in the place of those.
changed() {
  local text before; text=$(cat "$1"); shift
  while [ $# -gt 0 ]; do
    before=${text%%"$1"*}
    [ "$before" != "$text" ] && [ "$before$1${text##*"$1"}" = "$text" ] || { echo "FAILED: once expected: $1"; exit 1; }
    text=$before$2${text##*"$1"}
    shift 2
  done
  printf '%s\n' "$text" > mutated.py
}
