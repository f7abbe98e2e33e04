#!/usr/bin/env bash
# package_test.sh PACKAGE FORCES.csv: packs the folder as npm does, installs it into an empty folder, runs its example and
# interface_test.mjs there. Exits 77 where npm is not installed.
set -euo pipefail
command -v npm > /dev/null || { echo "skipped: npm is not installed"; exit 77; }
package=$1 forces=$(realpath "$2") here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
(cd "$package" && npm pack --silent --pack-destination "$folder") > "$folder/name"
mkdir "$folder/clean" && cd "$folder/clean"
npm init --yes > /dev/null
npm install --silent --offline --no-audit --no-fund "$folder/$(cat "$folder/name")"
cp node_modules/forceshade/example.mjs "$here/interface_test.mjs" "$here/wrong_arguments.mjs" "$here/golden.js" .
node example.mjs | tee example.txt
grep -qx "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm: contact, 0.5615893602371216 0 2.797053337097168 N" example.txt
grep -qx "cube: contact, 0 0 0.25 N, .*" example.txt
node interface_test.mjs "$forces"
