#!/usr/bin/env bash
# headers_test.sh COMPILER SOURCE_DIR INCLUDE_DIR SYSTEM_INCLUDE_DIR...: every header that a program can include compiles by
# itself. Those of reference/, properties/ and recorder/ have heavy libraries below them and are left to structure_test, which
# wants each included first by its own source file.
set -euo pipefail
compiler=$1 source=$2 include=$3
shift 3
options=(-std=c++20 -fsyntax-only -Wall -Wextra -Werror -Wno-unused-function "-I$include")
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
  echo "#include \"forceshade/$header\"" | "$compiler" "${options[@]}" "${flags[@]}" -x c++ - 2>&1 || { echo "FAILED: $header"; return 1; }
}
if [ "${HEADER:-}" ]; then compiles "$HEADER"; exit; fi

cd "$source"
headers=$(ls {vocabulary,fast,csv,heights,device}/*.h)
[ "$(wc -w <<<"$headers")" -ge 80 ] || { echo "expected 80 headers or more, found: $headers"; exit 1; }
# shellcheck disable=SC2086
printf '%s\n' $headers | xargs -P "$(nproc)" -I{} env HEADER={} "$0" "$compiler" "$source" "$include" "$@" || exit 1
echo "$(wc -w <<<"$headers") headers compile by themselves"
