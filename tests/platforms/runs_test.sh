#!/usr/bin/env bash
# runs_test.sh [EMULATOR...] PROGRAM: the program must exit with 0 in an empty folder, in which it may write. Exits 77 where the
# emulator is not installed.
set -euo pipefail
[ "$1" != no_emulator ] || { echo "skipped: no emulator is installed for this target (docs/platforms.md)"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$@" || { echo "FAILED: exit code $?"; exit 1; }
