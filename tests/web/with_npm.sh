#!/usr/bin/env bash
# with_npm.sh FOLDER COMMAND...: runs the command where node finds the packages of package-lock.json, which npm brings to FOLDER/npm by
# their hashes. Exits 77 with the reason where node or the packages are missing.
set -eu
folder=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v node > /dev/null || skip "node is not there (Debian package nodejs)"
node -e 'process.exit(Number(process.versions.node.split(".")[0]) < 18 ? 1 : 0)' || skip "node $(node --version) is older than 18"
command -v npm > /dev/null || skip "npm is not there (Debian package npm)"
mkdir -p "$folder/npm"
folder=$(cd "$folder" && pwd)
(
  flock 9
  cd "$folder/npm"
  cmp -s "$here/package-lock.json" installed-lock.json && exit 0
  cp "$here/package.json" "$here/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1 || exit 1
  cp package-lock.json installed-lock.json
) 9> "$folder/npm.lock" || skip "npm cannot bring the packages of package-lock.json: $(grep -m 1 "^npm err" "$folder/npm/npm.log")"
NODE_PATH=$folder/npm/node_modules exec "$@"
