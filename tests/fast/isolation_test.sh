#!/usr/bin/env bash
# Objects compiled with -mavx2 or -mavx512 may define one symbol for others: their table. A second one (an inline function
# or a template from some header, say) could be linked into code that runs on every machine.
set -eu
checked=0
for object in "$@"; do
  case "$object" in *_avx2.cpp.o | *_avx512.cpp.o) ;; *) continue ;; esac
  symbols=$(nm --defined-only --extern-only -C "$object" | awk '{$1=""; $2=""; print}' |
    grep -v -E '__(asan|odr_asan|ubsan|tsan)|DW\.ref' || true)
  count=$(printf '%s\n' "$symbols" | grep -c . || true)
  echo "$(basename "$object"): $symbols"
  [ "$count" = 1 ] && printf '%s' "$symbols" | grep -q 'forceshade::fast::kAvx[0-9]*\(Blocks\|SplineFunctions\)$' ||
    { echo "expected one table, got $count symbols"; exit 1; }
  checked=$((checked + 1))
done
[ "$checked" = 4 ] || { echo "expected 4 vector objects, got $checked"; exit 1; }
