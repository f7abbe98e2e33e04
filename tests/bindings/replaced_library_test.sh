#!/usr/bin/env bash
# replaced_library_test.sh COMMAND PROGRAM LIBRARY: a program whose shared library is exchanged after certification is refused.
set -eu
command=$1 program=$2 library=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$1"; cat "$scratch/said"; exit 1; }
certify() {  # the radius, the points, and the folder
  "$command" certify --law bump-2p --radius "$1" --width 25.4mm --stiffness 0.5N/mm --points "$2" --out "$3" > "$scratch/said" ||
    fail "no certificate was made"
}
# The library that is loaded instead of the one in LD_LIBRARY_PATH would be that of the program's own run path.
said_by() {  # the folder of the library, and the certificate
  LD_LIBRARY_PATH=$1 LD_PRELOAD=$1/libforceshade.so.0 "$program" "$2" > "$scratch/said" 2>&1
}

certify 15.24mm 1000000 "$scratch/bump"
mkdir "$scratch/same" "$scratch/other"
cp "$library" "$scratch/same/libforceshade.so.0"
said_by "$scratch/same" "$scratch/bump/certificate.json" || fail "the library itself is refused"
[ "$(cat "$scratch/said")" = "2.51375 N" ] || fail "expected the force of the covered bump"

# The same library but for its digest, as one has that was compiled of other code (install.digest_is_that_of_the_compiled_code).
digest=$(jq -r .build.library_digest "$scratch/bump/certificate.json")
other=$(echo "$digest" | tr 0123456789abcdef 123456789abcdef0)
[ "$(grep -c "$digest" "$library")" = 1 ] || fail "the library does not hold its digest once"
sed "s/$digest/$other/" "$library" > "$scratch/other/libforceshade.so.0"
said_by "$scratch/other" "$scratch/bump/certificate.json" && fail "an exchanged library is driven"
grep -q "the certificate is for another build of the renderer: expected digest $other, got $digest" "$scratch/said" ||
  fail "expected the reason"

sed 's/"renderer": "library"/"renderer": "program"/' "$scratch/bump/certificate.json" > "$scratch/own.json"
said_by "$scratch/same" "$scratch/own.json" && fail "a certificate of a program's own renderer covers the bump"
grep -q "is of a program's own renderer for bump-2p" "$scratch/said" || fail "expected whose renderer it is"

said_by "$scratch/same" "$scratch/absent.json" && fail "a certificate that is not there covers the bump"
grep -q 'absent.json' "$scratch/said" || fail "expected the name of the file"
certify 20mm 5000 "$scratch/wide"
said_by "$scratch/same" "$scratch/wide/certificate.json" && fail "a certificate of another radius covers the bump"
grep -q 'with other parameters: expected .*15.24 mm.*; got .*20 mm' "$scratch/said" || fail "expected the parameters"
