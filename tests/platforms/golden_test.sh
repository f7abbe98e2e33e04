#!/usr/bin/env bash
# golden_test.sh HASHES [EMULATOR...] PROGRAM: the program (tests/fast/same_bits.cpp) must print every line of the file HASHES. Prints
# for each kind how many hashes are the same. Exits 77 where the emulator is not installed, or does so.
set -euo pipefail
hashes=$1
shift
[ "$1" != no_emulator ] || { echo "skipped: no emulator is installed for this target (docs/platforms.md)"; exit 77; }
printed=$("$@" | tr -d '\r') || {
  code=$?
  echo "$printed"
  [ "$code" = 77 ] || echo "FAILED: $* exits with $code"
  exit "$code"
}
same=$(grep -v '^#' "$hashes" | grep -Fxf <(echo "$printed") || true)
of() { grep -c "$1" <<< "$2" || true; }  # how many lines begin so
stored=$(grep -v '^#' "$hashes")
for kind in "laws ^\(wall\|cylinder\|bump\)" "height-maps ^height-map" "meshes ^\(mesh\|scene\|damping\)"; do
  echo "${kind%% *}: $(of "${kind#* }" "$same") of $(of "${kind#* }" "$stored") golden hashes"
done
diff <(echo "$stored") <(echo "$printed") || { echo "FAILED: these are other bits"; exit 1; }
