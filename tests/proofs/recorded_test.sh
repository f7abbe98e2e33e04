#!/usr/bin/env bash
# recorded_test.sh PROGRAM FILE [WORD]: what the program prints, the first stage or the form of every law, must be what the file holds.
set -euo pipefail
"$1" ${3:-} | diff "$2" - || { echo "$2 is not what the headers do: write it anew as its head says, and look at the proofs again"; exit 1; }
