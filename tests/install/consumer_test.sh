#!/usr/bin/env bash
# Installs the build into a fresh prefix, builds the consumer against it with find_package, and runs it.
set -eu
build=$1 compiler=$2 flags=$3
source=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" > "$scratch/install.log"
cmake -S "$source" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release > "$scratch/configure.log"
cmake --build "$scratch/build" > "$scratch/build.log" || { cat "$scratch/build.log"; exit 1; }
"$scratch/build/consumer"
"$scratch/prefix/bin/forceshade" --version
for file in man/man1/forceshade.1 man/man1/forceshade-device-check.1 bash-completion/completions/forceshade; do
  [ -s "$scratch/prefix/share/$file" ] || { echo "FAILED: share/$file was not installed"; exit 1; }
done
