#!/usr/bin/env bash
# same_bits_test.sh COMPILER SOURCE_DIR INCLUDE_DIR EIGEN_DIR: builds fast/ and the program same_bits with other flags than the
# library's; each build must make tests/golden/hashes.txt again, and a build that may round otherwise must be refused.
# Exits 77 where there is no such compiler.
set -euo pipefail
compiler=$1 source=$2 include=$3 eigen=$4
command -v "$compiler" > /dev/null || { echo "$compiler is not installed"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

compile() {  # directory, file, flags...
  local vector=()
  case $2 in
    fast/batch_avx2) vector=(-mavx2 -mfma) ;;
    fast/batch_avx512) vector=(-mavx512f -mavx512dq -mavx512vl -mavx512bw) ;;
  esac
  "$compiler" -std=c++20 -w -I"$include" -isystem "$eigen" "${@:3}" "${vector[@]}" -c "$source/$2.cpp" -o "$1/$(basename "$2").o"
}
link() { "$compiler" "${@:2}" "$1"/*.o -o "$1/same_bits"; }  # directory, flags...

same() {  # flags...
  local place="$scratch/same $*"
  mkdir "$place"
  for file in fast/instruction_set fast/law fast/batch_avx2 fast/batch_avx512 tests/same_bits; do
    compile "$place" $file "$@" -ffp-contract=off
  done
  link "$place" "$@"
  SECONDS=0
  "$place/same_bits" > "$place/hashes"
  diff <(grep -v '^#' "$source/tests/golden/hashes.txt") "$place/hashes" || { echo "FAILED: other bits with $*"; exit 1; }
  echo "same bits with $* ($SECONDS s)"
}

refused() {  # WORDS, file, flags...: the first build of `same`, but for one file
  local place="$scratch/refused $(basename "$2")" words
  cp -r "$scratch/same -O3" "$place"
  compile "$place" "$2" -O3 "${@:3}"
  link "$place"
  words=$("$place/same_bits" 2>&1 > "$place/hashes") && { echo "FAILED: $2 with ${*:3} was not refused"; exit 1; }
  case $words in "refused: $1"*) echo "$2 with ${*:3} $words" ;; *) echo "FAILED: $2 with ${*:3}: $words"; exit 1 ;; esac
}

not_compiled() {  # flags...
  local words
  words=$(compile "$scratch" fast/law "$@" 2>&1) && { echo "FAILED: compiled with $*"; exit 1; }
  case $words in *"#error \"forceshade proves"*) ;; *) echo "FAILED: $*: $words"; exit 1 ;; esac
}

same -O3
same -O3 -march=native
same -O0
same -O1 -fsanitize=address,undefined -fno-sanitize-recover=all

for flag in -ffast-math -Ofast -ffinite-math-only; do not_compiled $flag; done
if grep -qw avx512dq /proc/cpuinfo; then
  for file in fast/law fast/batch_avx2 fast/batch_avx512; do refused "fused" $file -ffp-contract=fast -mfma; done
else
  echo "refusal of contraction not tried: this machine lacks AVX-512"
fi
