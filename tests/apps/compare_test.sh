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
expect 1 "off.csv:2: at x = 0x1.8p+1 (3)" -- judge off.csv
expect 0 "held: 1 of 1 (100 %) within the tolerance, 1 ulp" -- judge off.csv --tolerance "1 ulp"
expect 0 "held: 1 of 1 (100 %) within the tolerance, 4e-07 N" -- judge off.csv --tolerance 4e-7N
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
same 8 "$(ls made | wc -l)"
fits "$vectors/schema.json" made/*.json
expect 0 "0 wrong of 200" -- "$vectors/check.py" made/wall.json

# Damping: the positions have periods, and forces that a program in fractions wrote beside them are judged with it.
damped=(--law wall --stiffness 0.5 --damping 0.002)
damped+=(--damping-filter 0.25 --rate 1000)
expect 0 "" -- "$forceshade" conform positions "${damped[@]}" --points 5000 --out damped.csv
expect 0 "" -- "$forceshade" conform positions "${damped[@]}" --points 5000 --out damped.npy
same x_mm,y_mm,z_mm,reset,aim,periods "$(head -1 damped.csv)"
python3 - "$examples/renderers" << 'end'
import csv, struct, sys
sys.path.insert(0, sys.argv[1])
from wall import force
source = open(sys.argv[1] + "/damped_wall.py").read()
exec(source[: source.rindex("main()")])
with open("damped.csv") as file, open("damped_mine.csv", "w") as mine, open("no_periods.csv", "w") as other:
    rows = list(csv.reader(file))
    for out in (mine, other):
        print("x_mm,y_mm,z_mm,reset," + ("periods," if out is mine else "") + "fx_N,fy_N,fz_N", file=out)
    for x, y, z, reset, aim, periods in rows[1:]:
        if reset == "1":
            damper = Damper()
        at = [struct.unpack("f", struct.pack("f", float(one)))[0] for one in (x, y, z)]
        damped = damper.damped(at, int(periods), force(*at, 0.5)[2])
        print(x, y, z, reset, periods, 0, 0, float(damped).hex(), sep=",", file=mine)
        print(x, y, z, reset, 0, 0, float(damped).hex(), sep=",", file=other)
end
judged() { "$forceshade" conform judge "$@" --json judged.json --overwrite; }
expect 0 "held: 5000 of 5000 (100 %) within the tolerance, correctly rounded" -- judged damped_mine.csv "${damped[@]}"
python3 -c 'import json, sys
schema = json.load(open(sys.argv[1]))
json.dump(schema["definitions"]["judgement"] | {"definitions": schema["definitions"]}, open("judgement_schema.json", "w"))' \
  "$examples/../docs/conformance-schema.json"
fits judgement_schema.json judged.json
same '{"damping": 0.0020000000949949026, "drag": 0.0, "full_at": 0.25, "most": 2.0, "rate_Hz": 1000.0, "share": 0.25}' \
  "$(python3 -c 'import json; print(json.dumps(json.load(open("judged.json"))["damping"], sort_keys=True))')"
# Another rate, filter, limit or damping is found, and so are periods that were left out.
for other in "--rate 500" "--damping-filter 0.5" "--damping 0.002,3" "--damping 0.003" "--drag 0.001"; do
  case $other in --drag*) of=("${damped[@]}") ;; *) of=(); skip=; for word in "${damped[@]}"; do
    if [ "$skip" ]; then skip=; elif [ "$word" = "${other%% *}" ]; then skip=1; else of+=("$word"); fi; done ;; esac
  expect 1 "FAILED: " -- judged damped_mine.csv "${of[@]}" $other
done
expect 1 "FAILED: " -- judged damped_mine.csv --law wall --stiffness 0.5
expect 1 "FAILED: " -- judged no_periods.csv "${damped[@]}"
expect 1 "114 wrong of 200" -- "$vectors/check.py" made/bump-2p.json
expect 0 '"id":5000' -- bash -c "'$forceshade' conform positions --law wall --points 5000 --out vectors.json && cat vectors.json"

# Tables that cannot be judged.
expect 2 "asked.npy: has no field fx_N" -- judge asked.npy
same "" "$(ls | grep partial || true)"
