#!/usr/bin/env bash
# replaced_reference_test.sh PROGRAM LIBRARY: properties and certificates are refused where the libforceshade.so.0 that is loaded is of
# another build than libforceshade-reference.so.0; exact forces are not. LIBRARY is libforceshade.so.0.
set -eu
program=$1 library=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$1"; cat "$scratch/said"; exit 1; }
# The library that is loaded instead of the one in LD_LIBRARY_PATH would be that of the program's own run path.
run() {  # the folder of the library, arguments
  local folder=$1
  shift
  LD_LIBRARY_PATH=$folder LD_PRELOAD=$folder/libforceshade.so.0 "$program" "$@" > "$scratch/said" 2>&1
}

mkdir "$scratch/same" "$scratch/other"
cp "$library" "$scratch/same/libforceshade.so.0"
run "$scratch/same" "$scratch/certificate.json" || fail "the library itself is refused"
grep -q '^4 properties, standing 1$' "$scratch/said" || fail "expected a certificate that has too little evidence to drive"
digest=$(jq -r .build.library_digest "$scratch/certificate.json")
other=$(echo "$digest" | tr 0123456789abcdef 123456789abcdef0)
[ "$(grep -c "$digest" "$library")" = 1 ] || fail "the library does not hold its digest once"

# The same library but for its digest, as one has that was compiled of other code (install.digest_is_that_of_the_compiled_code).
sed "s/$digest/$other/" "$library" > "$scratch/other/libforceshade.so.0"
run "$scratch/other" "$scratch/other.json" && fail "an exchanged library is certified"
grep -q "is of another build than libforceshade-reference.so.0.*expected digest $digest, got $other" "$scratch/said" ||
  fail "expected the reason"
[ -z "$(find "$scratch" -name '*.json*' ! -name certificate.json)" ] || fail "a certificate was written"
run "$scratch/other" || fail "exact forces need no library"
grep -q '^-\?[0-9. -]* N$' "$scratch/said" || fail "expected the exact force"
