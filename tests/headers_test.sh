#!/usr/bin/env bash
# headers_test.sh COMPILER SOURCE_DIR SYSTEM_INCLUDE_DIR...: every header that an installed program can include
# compiles by itself. One that a source file of its name includes first is compiled so by every build (structure_test.py looks
# that it is first, in these folders and the others). One that another header includes before anything else is compiled by itself
# with that header. The rest is compiled here.
set -euo pipefail
compiler=$1 source=$2
shift 2
options=(-std=c++20 -fsyntax-only -Wall -Wextra -Werror -Wno-unused-function -Wno-unknown-warning-option)
options+=("-I$source" "-I$source/include")
for folder in "$@"; do options+=(-isystem "$folder"); done

compiles() {
  local header=$1 flags=()
  case $header in
    */*avx512*) flags=(-mavx512f -mavx512dq -mavx512vl -mavx512bw -Wno-uninitialized -Wno-maybe-uninitialized) ;;
    */*avx2*) flags=(-mavx2 -mfma) ;;
  esac
  case $header:$(uname -m) in
    */*avx*:x86_64 | */*avx*:amd64) ;;
    */*avx*:*) return 0 ;;
  esac
  echo "#include \"$header\"" | "$compiler" "${options[@]}" "${flags[@]}" -x c++ - 2>&1 || { echo "FAILED: $header"; return 1; }
}
if [ "${FORCESHADE_HEADER:-}" ]; then compiles "$FORCESHADE_HEADER"; exit; fi

cd "$source"
all=$(find include rendering fast system files device -name "*.h" | sort)
# Those of an instruction set are left out: another machine does not compile them.
# shellcheck disable=SC2086
first=$(for header in $(grep -v avx <<<"$all"); do
  sed -nE '/^#include/{s|^#include "(.*)".*|\1|p;q}; \%^//|^$|^#pragma once%!q' "$header"
done | sort -u)
headers="" with_another=0
for header in $all; do
  [ ! -f "${header%.h}.cpp" ] || continue
  if grep -qxF "$header" <<<"$first"; then with_another=$((with_another + 1)); else headers+=" $header"; fi
done
[ "$(wc -w <<<"$headers")" -ge 45 ] || { echo "expected 45 headers or more, found:$headers"; exit 1; }
# A program without exceptions includes the public ones.
printf '#include "%s"\n' include/forceshade/*.h | "$compiler" "${options[@]}" -fno-exceptions -x c++ - ||
  { echo "FAILED: -fno-exceptions"; exit 1; }
# shellcheck disable=SC2086
printf '%s\n' $headers | xargs -P "$(nproc)" -I{} env FORCESHADE_HEADER={} "$0" "$compiler" "$source" "$@" || exit 1
echo "$(wc -w <<<"$headers") headers compile by themselves, and $with_another that these include first"
