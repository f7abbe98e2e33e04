#!/usr/bin/env bash
# The digest of the real-time library depends on the compiled code and nothing else. Without optimisation, because that
# compiles in a quarter of the time, and without a compiler cache, which would hide a difference.
set -eu
source=$1 compiler=$2 command=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export CCACHE_DISABLE=1
fail() { echo "$1" >&2; exit 1; }

build() {  # the sources, the folder of the build, flags
  [ -d "$2" ] || cmake -G Ninja -S "$1" -B "$2" -DFORCESHADE_FEATURES=device-loop -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS_RELEASE="$3" > "$scratch/log" || { cat "$scratch/log"; exit 1; }
  cmake --build "$2" --target forceshade_fast > "$scratch/log" || { cat "$scratch/log"; exit 1; }
}
digest() { grep -o '[0-9a-f]\{64\}' "$1/fast/library_digest.cpp"; }
expect() {  # same | another, what, the build
  local got=another
  [ "$(digest "$3")" != "$first" ] || got=same
  echo "$got: $2"
  [ "$got" = "$1" ] ||
    fail "$2: expected $([ "$1" = same ] && echo "the same digest" || echo "another digest"), got $(digest "$3") beside $first"
}

copy=$scratch/a/longer/path/to/the/sources
mkdir -p "$copy"
(cd "$source" && cp -RP CMakeLists.txt bindings cmake include rendering fast subjects system files text device tests LICENSE "$copy")
build "$source" "$scratch/b" -O0
first=$(digest "$scratch/b")
build "$copy" "$copy/build" -O0
expect same "another folder" "$copy/build"
sed -i '1s|$|\n// A comment.|' "$copy/fast/instruction_set.cpp"
build "$copy" "$copy/build" -O0
expect same "a comment" "$copy/build"
sed -i 's/kLargestStiffness = 1e3F/kLargestStiffness = 2e3F/' "$copy/fast/law.cpp"
cmp -s "$copy/fast/law.cpp" "$source/fast/law.cpp" && fail "fast/law.cpp: expected a constant kLargestStiffness = 1e3F"
build "$copy" "$copy/build" -O0
expect another "a constant" "$copy/build"
sed -i 's/kLargestStiffness = 2e3F/kLargestStiffness = 1e3F/' "$copy/fast/law.cpp"
sed -i 's/poses_\[i\] = motions_\[i\]/poses_[i] = motions_[0]/' "$copy/subjects/renderer/moving_renderer.cpp"
cmp -s "$copy/subjects/renderer/moving_renderer.cpp" "$source/subjects/renderer/moving_renderer.cpp" && fail "expected motions_[i] there"
build "$copy" "$copy/build" -O0
expect another "the way from a description to the library" "$copy/build"

strip -o "$scratch/stripped" "$command"
digest_of() { "$1" --version | grep -o '[0-9a-f]\{64\}'; }
[ "$(digest_of "$scratch/stripped")" = "$(digest_of "$command")" ] || fail "strip: expected the same digest"
echo "same: strip"
