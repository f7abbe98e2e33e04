#!/usr/bin/env bash
# conform_report_test.sh FORCESHADE: what a conformance run writes.
python_options=-SE
. "$(dirname "$0")/expect.sh"
schema=$examples/../docs/conformance-schema.json
renderer() {  # FILE VERSION FORCE: the wall in Python with another force
  sed "s/\"version\": \"1\"/\"version\": \"$2\"/; s/stiffness \* -z if/$3 if/" "$examples/renderers/wall.py" > "$1"
}
renderer right.py 1 "stiffness * -z"
renderer off.py 2 "stiffness * -z * 1.0000001"
conform() { "$forceshade" conform --law wall --points 1000 "$@"; }

# The page, which is there whole, with pictures or, without gnuplot, with a warning; and the command that it names.
expect 1 "FAILED: " -- conform --command "python3 off.py" --out page.html --json off.json
expect 1 "</html>" -- conform --command "python3 off.py" --out -
grep -q "<svg role=\"img\"" page.html || { echo "no pictures"; exit 1; }
grep -q ">Failed</p>" page.html || exit 1
expect 2 "page.html" -- conform --command "python3 off.py" --out page.html
expect 2 "--out: expected a name that ends in .html" -- conform --command "python3 off.py" --out page.png
expect 2 "--out: expected a file in a folder that can be written to" -- conform --command "python3 off.py" --out no/page.html
mkdir path
printf '#!/bin/sh\necho no fonts >&2\nexit 1\n' > path/gnuplot
chmod +x path/gnuplot
expect 1 "bare.html has no pictures: " -- env PATH="$PWD/path:$PATH" "$forceshade" conform --law wall --points 1000 --command "python3 off.py" --out bare.html
grep -q "A test to paste" bare.html || exit 1
again=$(python3 -c 'import json; print(json.load(open("off.json"))["command"])')
same "forceshade conform --law wall --command 'python3 off.py' --points 1000 --seed 1" "$again"
expect 1 "" -- sh -c "${again/forceshade/"$forceshade"} --json again.json"
cmp off.json again.json || exit 1

# The JSON of whatever can come of a run fits the schema.
expect 0 "" -- conform --command "python3 right.py" --json right.json
expect 0 "time of an answer: half within " -- conform --command "python3 right.py" --timing --json timed.json
expect 0 "held: an answer takes at most 60 s, 4000 cases" -- conform --command "python3 right.py" --timing 60
expect 1 "FAILED: an answer takes at most 1e-09 s" -- conform --command "python3 right.py" --timing 1e-9
expect 2 "--timing: expected a number" -- conform --command "python3 right.py" --timing 0
expect 1 "" -- conform --command "exit 3" --json ended.json
expect 1 "" -- "$forceshade" conform --law bump-2p --points 1000 --command "python3 right.py" --json refused.json
fits "$schema" off.json right.json timed.json ended.json refused.json
if "$python" -c "import jsonschema" 2> /dev/null; then
  "$python" -c 'import json, jsonschema, sys
run = json.load(open(sys.argv[2]))
for key in run:
    assert not jsonschema.Draft7Validator(json.load(open(sys.argv[1]))).is_valid(run | {key: []} if key != "invariants" else run | {key: {}}), key' "$schema" timed.json || exit 1
fi

same "" "$(ls | grep partial || true)"
