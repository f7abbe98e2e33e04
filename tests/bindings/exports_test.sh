#!/usr/bin/env bash
# exports_test.sh LIBRARY HEADER SONAME LEAST: the library exports the functions that the header declares, LEAST or more, and nothing
# else, and has this name.
set -eu
exported=$(nm -D --defined-only "$1" | awk '$2 != "A" { print $3 }' | sed 's/@.*//' | LC_ALL=C sort)
declared=$(grep -o 'forceshade_[a-z_]*(' "$2" | grep -v '^forceshade_[a-z_]*()$' | tr -d '(' | LC_ALL=C sort -u |
  grep -Fx -f <(grep -oE '^FORCESHADE_API .* \*?forceshade_[a-z_]+\(' "$2" | grep -oE 'forceshade_[a-z_]+\($' | tr -d '('))
[ "$(echo "$declared" | wc -l)" -ge "$4" ] || { echo "found only: $declared"; exit 1; }
diff <(echo "$declared") <(echo "$exported") || { echo "the library exports (>) other functions than the header declares (<)"; exit 1; }
[ "$(objdump -p "$1" | awk '/SONAME/ { print $2 }')" = "$3" ] || { echo "the library has another name than $3"; exit 1; }
