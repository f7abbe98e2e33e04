#!/usr/bin/env bash
# compare_test.sh FORCESHADE: positions of a subject go to a program that writes forces beside them, and are judged.
. "$(dirname "$0")/expect.sh"
bump=(--law bump-2p --stiffness 0.5)
expect 0 "" -- "$forceshade" conform positions "${bump[@]}" --points 10000 --seed 3 --out asked.csv
same "x_mm,y_mm,z_mm,reset,aim 10001" "$(head -1 asked.csv) $(wc -l < asked.csv)"
cmp asked.csv <("$forceshade" conform positions "${bump[@]}" --points 10000 --seed 3) || exit 1
! cmp -s asked.csv <("$forceshade" conform positions "${bump[@]}" --points 10000 --seed 4) || exit 1
expect 0 "" -- "$forceshade" conform positions "${bump[@]}" --points 10 --out asked.npy
same NUMPY "$(head -c 6 asked.npy | tail -c 5)"

# The program is ours; its rows are put beside the flags of the positions.
expect 0 "" -- "$forceshade" force asked.csv "${bump[@]}" --out given.csv
paste -d, <(cut -d, -f1-6 given.csv) <(cut -d, -f4,5 asked.csv) > mine.csv
judge() { "$forceshade" conform judge "${bump[@]}" "$@"; }
expect 0 "held: 10000 of 10000 (100 %) within the tolerance, correctly rounded" -- judge mine.csv
expect 0 "held: 10000 of 10000" -- sh -c "'$forceshade' conform judge ${bump[*]} - < mine.csv"
expect 0 "" -- "$forceshade" force asked.csv "${bump[@]}" --out given.npy
expect 0 "held: 10000 of 10000" -- judge given.npy

# One number off.
printf '%s\n' x_mm,y_mm,z_mm,fx_N,fy_N,fz_N 3,0,-0.5,0x1.595c48p+0,0,0x1.41c266p+1 > off.csv
expect 1 "FAILED: 0 of 1 (0 %) within the tolerance, correctly rounded" -- judge off.csv --tolerance "0 ulp"
expect 1 "off.csv:2: at x = 0x1.8p+1 (3)" -- judge off.csv
expect 0 "held: 1 of 1 (100 %) within the tolerance, 1 ulp" -- judge off.csv --tolerance "1 ulp"
expect 0 "held: 1 of 1 (100 %) within the tolerance, 4e-07 N" -- judge off.csv --tolerance 4e-7N
expect 1 "FAILED" -- judge off.csv --tolerance 1e-7N
expect 0 "held" -- judge off.csv --tolerance "0.001 %"
expect 1 '"beyond_tolerance": 1' -- judge off.csv --json
expect 1 "<failure" -- judge off.csv --junit -

# A mesh, along a path that begins again.
expect 0 "" -- "$forceshade" mesh make icosphere --cells 3 --radius 20mm --out sphere.off
mesh=(--mesh sphere.off --unit mm)
expect 0 "" -- "$forceshade" conform positions "${mesh[@]}" --points 60 --out path.csv
expect 0 "" -- "$forceshade" force path.csv "${mesh[@]}" --out given_path.csv
expect 0 "held: " -- "$forceshade" conform judge "${mesh[@]}" given_path.csv
expect 1 "correctly rounded" -- "$forceshade" conform judge "${mesh[@]}" --shading none given_path.csv

# The vectors of examples/vectors/ are those of this build, fit their schema, and serve a test that needs nothing else.
vectors=$examples/vectors
mkdir made
"$vectors/make" "$forceshade" made || exit 1
for file in made/*.json; do cmp "$file" "$vectors/$(basename "$file")" || exit 1; done
same 7 "$(ls made | wc -l)"
fits "$vectors/schema.json" made/*.json
expect 0 "0 wrong of 200" -- "$vectors/check.py" made/wall.json
damped=(conform positions --law wall --damping 0.002)
expect 2 "--rate: expected the periods in a second with damping" -- "$forceshade" "${damped[@]}" --out damped.json
expect 2 "--out: expected FILE.json with damping" -- "$forceshade" "${damped[@]}" --rate 1000 --out damped.csv
expect 2 "--damping: share is" -- "$forceshade" "${damped[@]}" --damping-filter 100s --rate 100000 --out damped.json
expect 1 "114 wrong of 200" -- "$vectors/check.py" made/bump-2p.json
expect 0 '"id":5000' -- bash -c "'$forceshade' conform positions --law wall --points 5000 --out vectors.json && cat vectors.json"
expect 2 "--out: expected a name that ends in .csv or .npy or .json" -- "$forceshade" conform positions --law wall --out vectors.xml
expect 2 "--points: expected at most 1000000 with their forces, got 1000001" -- \
  "$forceshade" conform positions --law wall --points 1000001 --out more.json

# Tables that cannot be judged.
for tolerance in 4 "4 mN" "1.5 ulp" "-1 N" nan; do
  expect 2 "--tolerance: expected a number with ulp (a whole one), N or %" -- judge mine.csv --tolerance "$tolerance"
done
expect 2 "asked.csv:1: no column fx_N" -- judge asked.csv
expect 2 "asked.npy: has no field fx_N" -- judge asked.npy
: > empty.csv
expect 2 "empty.csv:1: expected a header row" -- judge empty.csv
head -1 mine.csv > none.csv
expect 2 "none.csv: expected positions with forces, got none" -- judge none.csv
expect 2 "cannot open" -- judge nowhere.csv
expect 2 "conform judge: expected forces, got none" -- "$forceshade" conform judge "${bump[@]}"
expect 2 "expected two files" -- judge mine.csv --json a --junit a
expect 2 "--points" -- "$forceshade" conform positions "${bump[@]}" --points 0
same "" "$(ls | grep partial || true)"
