#!/usr/bin/env bash
# renderers_test.sh FORCESHADE PART: the examples of renderers that are wrong in known ways, and what conform finds of each. PART is laws
# or meshes, whose god-object in Python is slow. Exit code 77, which CTest takes for skipped, where what they need is lacking.
skip() { echo "skipped: $1"; exit 77; }
for python in python3 /usr/bin/python3 none; do "$python" -c 'import numpy' 2> /dev/null && break; done
[ "$python" != none ] || skip "no python3 with NumPy"
command -v cc > /dev/null || skip "no cc in PATH"
. "$(dirname "$0")/expect.sh"
renderers=$examples/renderers

# finds WORDS SUBJECT... -- COMMAND: what conform prints of a renderer that fails.
finds() {
  local words=$1 subject=(); shift
  while [ "$1" != -- ]; do subject+=("$1"); shift; done
  expect 1 "$words" -- "$forceshade" conform "${subject[@]}" --command "$2"
}

# The errata of reference/laws/errata.md: its section, the law, what is found, and that nothing else is.
printed() {
  local section=$1 law=$2 aim=$3 failures=$4 output
  output=$("$forceshade" conform --law "$law" --tolerance "1e-5 N" --command "$python $renderers/thesis_as_printed.py $section")
  checks=$((checks + 1))
  same "$failures" "$(echo "$output" | sed -n 's/^FAILED: \([a-z][^,:]*\).*/\1/p' | paste -sd '|')"
  case "$output" in *"wrong, $aim"*"FAILED: "*" within the tolerance"*) ;; *) echo "FAILED: $section: $output"; exit 1 ;; esac
}

laws() {
  cc -O2 -o naive "$renderers/naive.c" -lm || exit 1
  finds "correctly rounded 7516 of 20000" --law bump-2p -- ./naive
  finds "FAILED: any position gets a finite force" --law bump-2p -- ./naive
  finds "not applicable: a bump in naive C 1 does not render wall" --law wall -- ./naive
  numpy="$python $renderers/naive_numpy.py"
  finds "FAILED: without a position there is no force after 10 ms" --law bump-3p-shaded -- "$numpy"

  expect 0 "correctly rounded 4000 of 4000" -- "$forceshade" conform --law wall --points 4000 --json damped.json --overwrite \
    --command "$python $renderers/damped_wall.py"
  sed 's/self.since > 16/self.since > 99/' "$renderers/damped_wall.py" > pauses.py
  expect 1 "FAILED: after a pause no speed is left" -- "$forceshade" conform --law wall --points 4000 --json pauses.json --overwrite \
    --command "PYTHONPATH=$renderers $python pauses.py"
  also "const unsigned periods[] = {"
  fits "$examples/../docs/conformance-schema.json" damped.json pauses.json

  printed 2.2.1 wall "aimed at volume: 7126 of 7547" "no force out of contact|contact gives a force"
  printed 2.2.2 cylinder "aimed at volume: 7126 of 7547" "no force out of contact|contact gives a force"
  printed 2.5 bump-2p "aimed at volume: 5967 of 7547" "the surface does not attract"
  printed 2.5.1 bump-2p "aimed at volume: 1159 of 7547" "no force out of contact|the surface does not attract"
  printed 3.2 bump-1p-shaded "aimed at volume: 5967 of 7547" "contact gives a force"
  printed kinks bump-1p-shaded "aimed at facet line: 59 of 1939" ""
  printed 4.4.2 bump-2p "aimed at axis: 346 of 928" ""
  echo "$checks checks"
}

# The number of answers of the edge scheme are within the tolerance.
within() {
  "$forceshade" conform --mesh roof.off --unit mm --sides front --shading edge --points 2000 --tolerance "1e-3 N" \
    --command "$python $renderers/edge_scheme_as_printed.py $1" | sed -n 's/^FAILED: \([0-9]*\) of .*/\1/p'
}

meshes() {
  # 3.3, by a god-object with epsilons: on a roof its normal is too short beside the ridge, and one of length 1 is not.
  local as_printed normalised
  printf 'OFF\n6 4 0\n-9000 -9000 -2000\n-9000 9000 -2000\n0 -9000 0\n0 9000 0\n9000 -9000 -2000\n9000 9000 -2000\n' > roof.off
  printf '3 0 2 1\n3 2 3 1\n3 2 4 3\n3 4 5 3\n' >> roof.off
  as_printed=$(within ""); normalised=$(within --normalised)
  checks=$((checks + 1))
  [ "$as_printed" -lt "$normalised" ] || { echo "FAILED: $as_printed right as printed, $normalised with a normal of length 1"; exit 1; }

  expect 0 "held: a flat plate feels flat however it is triangulated" -- "$forceshade" conform --mesh "$examples/vectors/tetrahedron.off" \
    --unit mm --shading none --points 1000 --command "$python $renderers/god_object_epsilon.py"
  echo "$checks checks; of the edge scheme $as_printed are right as printed, $normalised with a normal of length 1"
}

"$2"
