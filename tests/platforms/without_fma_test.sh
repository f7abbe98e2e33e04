#!/usr/bin/env bash
# without_fma_test.sh SOURCE BINARY: builds the library for Windows without -mfma in BINARY, where its fma is that of mingw-w64's C library,
# which loses bits of some products. A law must be refused with this reason. Exits 77 where the compiler or wine is not installed.
set -euo pipefail
source=$1 binary=$2
for tool in x86_64-w64-mingw32-g++-posix wine; do
  command -v "$tool" > /dev/null || { echo "skipped: $tool is not installed (docs/platforms.md)"; exit 77; }
done
cmake -S "$source" -B "$binary" -G Ninja --toolchain "$source/cmake/toolchains/windows.cmake" -DCMAKE_BUILD_TYPE=Release \
  -DFORCESHADE_FEATURES= \
  -DCMAKE_CXX_FLAGS="-mprefer-vector-width=128 -mmove-max=128 -mstore-max=128 -DEIGEN_DONT_VECTORIZE" > "$binary.log" 2>&1 &&
  cmake --build "$binary" --target c_features >> "$binary.log" 2>&1 || { tail -n 20 "$binary.log"; exit 1; }
if said=$(WINEDEBUG=-all WINEPREFIX=$binary/wine wine "$binary/bindings/c/c_features.exe" | tr -d '\r'); then
  echo "FAILED: it is not refused: $said"
  exit 1
fi
echo "$said"
grep -q "^law: .*fma that rounds twice" <<< "$said"
