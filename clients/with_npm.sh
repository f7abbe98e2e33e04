#!/usr/bin/env bash
# with_npm.sh PACKAGES FOLDER COMMAND...: runs the command where node finds the packages of PACKAGES/package-lock.json, which npm brings
# to FOLDER/node_modules by their hashes. Exits 77 with the reason where node or the packages are missing.
set -eu
packages=$1 folder=$2
shift 2
skip() { echo "skipped: $1"; exit 77; }
command -v node > /dev/null || skip "node is not there (Debian package nodejs)"
node -e 'process.exit(Number(process.versions.node.split(".")[0]) < 18 ? 1 : 0)' || skip "node $(node --version) is older than 18"
command -v npm > /dev/null || skip "npm is not there (Debian package npm)"
mkdir -p "$folder"
(
  flock 9
  cmp -s "$packages/package-lock.json" "$folder/installed-lock.json" && exit 0
  cp "$packages/package.json" "$packages/package-lock.json" "$folder"
  cd "$folder"
  npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1 || exit 1
  cp package-lock.json installed-lock.json
) 9> "$folder/npm.lock" || skip "npm cannot bring the packages of package-lock.json: $(grep -m 1 "^npm err" "$folder/npm.log")"
NODE_PATH=$folder/node_modules exec "$@"
