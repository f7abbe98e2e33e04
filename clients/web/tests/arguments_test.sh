#!/usr/bin/env bash
# arguments_test.sh FOLDER: arguments_test.mjs with its interface.js. Exits 77 where node is not installed.
set -eu
command -v node > /dev/null || { echo "skipped: node is not installed"; exit 77; }
exec node "$(dirname "$0")/arguments_test.mjs" "$1"
