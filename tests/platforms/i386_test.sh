#!/usr/bin/env bash
# i386_test.sh SOURCE COMPILER: a build for i386 is refused when it is configured, with the reason; one whose numbers are rounded, by
# SSE2, is refused too, for want of 128-bit products. Nothing is linked, so that no library for i386 is needed.
set -euo pipefail
source=$1 compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/i386.cmake" << END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i386)
set(CMAKE_CXX_COMPILER $compiler)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
END

refused() {  # words, flags
  local folder="$scratch/build $2"
  if cmake -G Ninja -S "$source" -B "$folder" -DCMAKE_TOOLCHAIN_FILE="$scratch/i386.cmake" -DCMAKE_C_FLAGS="$2" -DCMAKE_CXX_FLAGS="$2" \
    -DFORCESHADE_FEATURES= > "$scratch/log" 2>&1; then
    echo "FAILED: $2 was configured"
    exit 1
  fi
  tr -s '\n ' ' ' < "$scratch/log" | grep -qF "$1" || { cat "$scratch/log"; echo "FAILED: $2: expected \"$1\""; exit 1; }
  echo "refused with $2: $1"
}
refused "the registers of the x87 round each result twice" "-m32 -mfpmath=387"
refused "has no unsigned __int128" "-m32 -msse2 -mfpmath=sse"
