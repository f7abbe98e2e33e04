#!/usr/bin/env bash
# languages_test.sh LANGUAGE LIBRARY SOURCE: the program of examples/languages in this language gives the force that C gives.
set -eu
language=$1 library=$2 source=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
lib=$(dirname "$library")
examples=$source/examples/languages
export LD_LIBRARY_PATH=$lib
needs() { command -v "$1" > /dev/null || { echo "skipped: $1 is not there (Debian package $2)"; exit 77; }; }
expect() { [ "$(cat "$scratch/said")" = "$1" ] || { echo "expected $1, got:"; cat "$scratch/said"; exit 1; }; }
case $language in
  python)
    needs python3 python3
    python3 "$examples/force.py" > "$scratch/said" 2>&1 || true
    expect "2.51375 N"
    sed 's/b"bump-2p"/b"bump-9p"/' "$examples/force.py" > "$scratch/wrong.py"
    python3 "$scratch/wrong.py" > "$scratch/said" 2>&1 && { echo "an unknown law is no error"; exit 1; }
    grep -q 'RuntimeError: law: expected .*, got "bump-9p"' "$scratch/said" || { cat "$scratch/said"; exit 1; }
    ;;
  rust)
    needs rustc rustc
    rustc "$examples/force.rs" -L "$lib" -l forceshade -o "$scratch/force" > "$scratch/said" 2>&1 || { cat "$scratch/said"; exit 1; }
    "$scratch/force" > "$scratch/said" 2>&1 || true
    grep -qE '^2\.5137[0-9]+ N$' "$scratch/said" || { cat "$scratch/said"; exit 1; }
    ;;
  octave)
    needs mkoctfile octave-dev
    cd "$scratch"
    printf 'law = "bump-2p"\nradius = "15.24 mm"\nwidth = "25.4 mm"\nstiffness = "0.5 N/mm"\n' > bump.toml
    cp "$examples/forceshade_forces.c" .
    mkoctfile --mex -I"$source/include" forceshade_forces.c -L"$lib" -lforceshade > said 2>&1 || { cat said; exit 1; }
    octave --no-gui --quiet --eval 'f = forceshade_forces("bump.toml", single([3 0 -0.5; 0 0 90; 3 1 -0.5]));
      printf("%g %g %g %d", f(1, 3), f(2, 3), f(3, 3), isa(f, "single"))' > said 2> errors || cat errors
    expect "2.51375 0 2.51375 1"
    octave --no-gui --quiet --eval 'forceshade_forces("bump.toml", [3 0 -0.5])' > said 2>&1 && { echo "binary64 is no error"; exit 1; }
    grep -q 'positions a single matrix' said || { cat said; exit 1; }
    ;;
esac
