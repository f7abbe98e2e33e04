#!/usr/bin/env bash
# emulated_avx512_test.sh COMPILER SOURCE_DIR EIGEN_DIR: builds the AVX-512 batch on emulated instructions (tests/fast/emulated/) and
# compares it with single calls, whatever this processor has. Exits 77 without the Debian package libsimde-dev.
set -euo pipefail
compiler=$1 source=$2 eigen=$3
echo '#include <simde/x86/avx512.h>' | "$compiler" -x c++ -fsyntax-only - 2>/dev/null ||
  { echo "skipped: the package libsimde-dev is not installed"; exit 77; }
cache=$(command -v ccache || true)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compile() {  # file, flags...
  $cache "$compiler" -std=c++20 -O1 -w -Wno-psabi -ffp-contract=off -fno-math-errno -I"$source" -I"$source/include" -isystem "$eigen" \
    "${@:2}" \
    -c "$source/$1.cpp" -o "$scratch/$(basename "$1").o"
}
compile fast/simd/batch_avx512 -I"$source/tests/fast/emulated"
compile tests/fast/pack_operations_avx512 -I"$source/tests/fast/emulated"
compile tests/fast/emulated/batch
"$compiler" "$scratch"/*.o -o "$scratch/batch"
"$scratch/batch"
