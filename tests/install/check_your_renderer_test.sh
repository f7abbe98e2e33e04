#!/usr/bin/env bash
# check_your_renderer_test.sh BUILD SOURCE: docs/check-your-renderer.md can be typed in an empty folder, beside the installed package.
set -eu
build=$(realpath "$1") source=$(realpath "$2")
. "$source/tests/apps/page.sh"
PATH=/usr/bin:$PATH python3 -c "import numpy, pytest" 2> /dev/null ||
  { echo "skipped: python3-numpy or python3-pytest is not there"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix
cmake --install "$build" --prefix "$prefix" > "$scratch/log"
site=$(find "$prefix" -type d -path '*-packages/forceshade')
[ -n "$site" ] || { echo "skipped: this build has no package for Python"; exit 77; }
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name forceshade-c.pc)") PYTHONPATH=$(dirname "$site") PATH=$prefix/bin:/usr/bin:$PATH
export PKG_CONFIG_PATH PYTHONPATH PATH
mkdir "$scratch/empty"
cd "$scratch/empty"
type_page "$source/docs/check-your-renderer.md"
