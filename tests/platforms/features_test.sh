#!/usr/bin/env bash
# features_test.sh FEATURES [EMULATOR...] PROGRAM: the program (features.c) must print these features, and say of the others that this
# build is without them. Exits 77 where the emulator is not installed.
set -euo pipefail
features=$1
shift
[ "$1" != no_emulator ] || { echo "skipped: no emulator is installed for this target (docs/platforms.md)"; exit 77; }
printed=$("$@" | tr -d '\r') || { echo "FAILED: $printed"; exit 1; }
echo "$printed"
has=$(sed -n 's/^features: *//p' <<< "$printed")
[ "$has" = "$features" ] || { echo "FAILED: expected the features \"$features\", got \"$has\""; exit 1; }
