#!/usr/bin/env bash
# same_bits_test.sh COMPILER SOURCE_DIR EIGEN_DIR [every_flag_set]: builds fast/ and the program same_bits with other flags than
# the library's: with every set of flags below, or with the first alone. Each build must make tests/golden/hashes.txt again, and a
# build that may round otherwise must be refused, whichever of the files that evaluate is built so; of clang++ one file is tried
# so, and each with every set of flags. Exits 77 where there is no such compiler.
set -euo pipefail
compiler=$1 source=$2 eigen=$3 sets=${4:-first_flag_set}
command -v "$compiler" > /dev/null || { echo "skipped: $compiler is not installed"; exit 77; }
cache=$(command -v ccache || true)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The files that look at their own arithmetic (fast/numbers/arithmetic.h); the bounds of soups/ hold
# for fused terms too.
evaluating="damping/damping law height_map_field heights/exact heights/grid heights/spline_force_avx2 heights/spline_force_avx512
  meshes/force meshes/mesh meshes/session numbers/root_field scenes/scene simd/batch_avx2 simd/batch_avx512"
every=$(cd "$source/fast" && find . -name '*.cpp' | sed 's|^\./||; s/\.cpp$//' | sort)
checks="box_tree check lines numbers predicates readers"  # of rendering/meshes/, because only a checked mesh is rendered

vector_flags() {  # file
  case $1 in
    fast/*_avx2) echo -mavx2 -mfma ;;
    fast/*_avx512) echo -mavx512f -mavx512dq -mavx512vl -mavx512bw ;;
  esac
}
compile() {  # directory, file, flags...
  $cache "$compiler" -std=c++20 -w -I"$source" -I"$source/include" -isystem "$eigen" "${@:3}" $(vector_flags "$2") -c "$source/$2.cpp" \
    -o "$1/${2//\//_}.o"
}
link() { "$compiler" "${@:2}" "$1"/*.o "$1"/meshes/*.o -o "$1/same_bits"; }  # directory, flags...

same() {  # flags...
  local place="$scratch/same $*"
  mkdir "$place"
  for file in $every; do compile "$place" fast/$file "$@" -ffp-contract=off; done
  mkdir "$place/meshes"
  for file in $checks; do compile "$place/meshes" rendering/meshes/$file "$@" -ffp-contract=off; done
  compile "$place/meshes" files/decimal "$@" -ffp-contract=off
  compile "$place" tests/fast/same_bits "$@" -ffp-contract=off
  link "$place" "$@"
  SECONDS=0
  "$place/same_bits" > "$place/hashes"
  diff <(grep -v '^#' "$source/tests/golden/hashes.txt") "$place/hashes" || { echo "FAILED: other bits with $*"; exit 1; }
  echo "same bits with $* ($SECONDS s)"
}

refused() {  # WORDS, file, flags...: the first build of `same`, but for one file
  local place="$scratch/refused" words
  rm -rf "$place"
  cp -r "$scratch/same $first" "$place"
  compile "$place" "$2" -O2 "${@:3}"  # less does not contract
  link "$place"
  words=$("$place/same_bits" 2>&1 > "$place/hashes") && { echo "FAILED: $2 with ${*:3} was not refused"; exit 1; }
  case $words in "refused: found $1"*) echo "$2 with ${*:3} $words" ;; *) echo "FAILED: $2 with ${*:3}: $words"; exit 1 ;; esac
}

not_compiled() {  # file, flags...: the preprocessor refuses
  local words
  words=$(compile "$scratch" "$1" -E -Wfatal-errors "${@:2}" 2>&1) && { echo "FAILED: $1 compiled with ${*:2}"; exit 1; }
  case $words in *"#error \"forceshade proves"*) ;; *) echo "FAILED: $1 with ${*:2}: $words"; exit 1 ;; esac
}

first="-O3 -march=native"
same $first
if [ "$sets" = every_flag_set ]; then
  same -O3
  same -O0
  same -O1 -fsanitize=address,undefined -fno-sanitize-recover=all
fi

for file in $every; do
  [ "$file" = instruction_set ] && continue  # computes nothing
  for flag in -ffast-math -Ofast -ffinite-math-only; do not_compiled fast/$file $flag; done
done
echo "the preprocessor refuses -ffast-math, -Ofast and -ffinite-math-only in every file that computes"
tried=$evaluating
# The files that are tried by default: every one where g++ contracts. Only g++ has macros for the parts of -ffast-math.
if [[ $compiler = *clang* && $sets != every_flag_set ]]; then tried=law; fi
for file in $tried; do
  case $file in *_avx2) needs=avx2 ;; *_avx512) needs=avx512dq ;; *) needs=fma ;; esac
  if grep -qw $needs /proc/cpuinfo; then
    refused "fused" fast/$file -ffp-contract=fast -mfma
  else
    echo "skipped: contraction in fast/$file, since this machine has no $needs"
  fi
done
for file in $tried; do
  case $compiler in
    *clang*) refused "reordered" fast/$file -funsafe-math-optimizations -ffp-contract=off ;;
    *) not_compiled fast/$file -funsafe-math-optimizations ;;
  esac
done
