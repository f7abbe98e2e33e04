#!/usr/bin/env bash
# conform_command_test.sh FORCESHADE: renderers of other programs through the door of processes: right ones, wrong ones, and such that do
# anything else.
python_options=-SE
. "$(dirname "$0")/expect.sh"
renderers=$examples/renderers
conform() { "$forceshade" conform --law wall --points 256 --answer-timeout 120 "$@"; }

# A right one, its files, and a scene that it does not render.
expect 0 "a wall in Python 1 renders wall: correctly rounded 256 of 256 (100 %)
held: 256 of 256 (100 %) within the tolerance, correctly rounded
held: the same path twice gives the same bits, 1500 cases
held: a reset equals a fresh start, 1500 cases" -- conform --command "$renderers/wall.py" --json wall.json
expect 0 '"applicable": true' -- cat wall.json
expect 0 '<testcase' -- conform --command "$renderers/wall.py" --junit -
expect 1 "not applicable: a wall in Python 1 does not render bump-2p: it renders the law wall alone" -- \
  "$forceshade" conform --law bump-2p --command "$renderers/wall.py"
if command -v node > /dev/null; then
  expect 0 "a cylinder in JavaScript" -- "$forceshade" conform --law cylinder --points 1000 --tolerance "1e-6 N" --command "$renderers/cylinder.js"
else
  echo "skipped: cylinder.js, since node is not there (Debian package nodejs)"
fi

# In its own units and frame: metres, millinewtons, impulses, closest points.
in_its_units() { changed "$renderers/wall.py" "${@:2}"; mv mutated.py "$1"; }  # NAME [ORIGINAL REPLACEMENT]...
in_its_units metres.py '"mm"' '"m"' "force(*struct" "metres(*struct" "def hello" "def metres(x, y, z, stiffness):
    return force(1000 * x, 1000 * y, 1000 * z, stiffness)


def hello"
in_its_units upside.py '["x", "y", "z"]' '["y", "-z", "x"]' "force(*struct" "upside(*struct" "def hello" "def upside(y, z, x, stiffness):
    return (0, -force(x, y, -z, stiffness)[2], 0)


def hello"
in_its_units milli.py '"N"' '"mN"' "(0, 0, stiffness *" "(0, 0, 1000 * stiffness *"
in_its_units impulse.py '"answers": "force"' '"answers": "impulse"' '"rate_Hz": None' '"rate_Hz": 1000' "(0, 0, stiffness *" "(0, 0, 0.001 * stiffness *"
in_its_units closest.py '"answers": "force"' '"answers": "closest point"' "return (0, 0, stiffness * -z if z <= -(2.0**-30) else 0)" \
  "return (x, y, 0 if z <= -(2.0**-30) else z)" "return (0, 0, 0)" "return (x, y, z)"
for its in upside metres; do expect 0 "correctly rounded 256 of 256" -- conform --command "python3 $its.py"; done
for its in milli impulse closest; do
  expect 2 "expected at least 1 ulp, or N or %" -- conform --command "python3 $its.py"
done
for its in milli impulse closest; do expect 0 "within the tolerance, 1 ulp" -- conform --command "python3 $its.py" --tolerance "1 ulp"; done
in_its_units near.py '"domain_mm": 10000' '"domain_mm": 20' "<= 10_000" "<= 20"
expect 0 "correctly rounded 256 of 256" -- conform --command "python3 near.py"
in_its_units shy.py '"claims": "definition"' '"claims": "invariants"' "stiffness * -z if" "0.7 * stiffness * -z if"
expect 0 "does not claim the definition, with which it was not compared" -- conform --command "python3 shy.py"

# Wrong in one thing: a line of examples/renderers/wall.py is another one. mutated ORIGINAL REPLACEMENT: writes it.
mutated() { changed "$renderers/wall.py" "$@"; }
finds() { expect 1 "$3" -- sh -c "'$forceshade' conform --law wall --points 1000 --command 'python3 mutated.py'"; }
try() { mutated "$1" "$2"; finds "$@"; }
try "stiffness * -z if" "stiffness * z if" "FAILED: "
try "(0, 0, stiffness * -z" "(1e-9, 0, stiffness * -z" "FAILED: "
try "(0, 0, stiffness * -z" "(0, stiffness * -z, 0" "FAILED: "
try "stiffness * -z if" "stiffness * -z * 1.0000001 if" "FAILED: "
try "stiffness * -z if" "stiffness * -z / 1000 if" "FAILED: "
try "abs(coordinate) <= 10_000" "abs(coordinate) <= 20_000" "aimed at domain end"
try "if not all(abs(coordinate) <= 10_000 for coordinate in (x, y, z)):" "if x != x:" "FAILED: any position gets a finite force"
try "z <= -(2.0**-30)" "z <= 0.25" "  made simpler, as a test to paste:"
try "z <= -(2.0**-30)" "z < 0" "aimed at quantum"
drifts() {  # the stiffness grows at every line of positions for which this holds
  mutated '        elif "positions" in asked:' "        elif \"positions\" in asked:
            stiffness *= 1.5 if $1 else 1"
}
drifts 'asked["positions"][0][0] == "c"'
finds "" "" "FAILED: a reset equals a fresh start"
drifts True
finds "" "" "FAILED: the same path twice gives the same bits"
mutated "import json" "import json, random"; cp mutated.py noisy.py
sed -i 's/stiffness \* -z if/stiffness * -z * (1 + random.choice([0, 2e-7])) if/' noisy.py
expect 1 "without having moved otherwise" -- conform --command "python3 noisy.py" --tolerance "1e-3 N"
also "FAILED: a hand at rest feels a force at rest"

# Programs that are no renderer at all; hostile_renderers.py has the others.
expect 1 "the shell knows no such command" -- conform --command "no-such-program-anywhere"
expect 1 "; it wrote last on standard error: \"no licence\"" -- conform --command "echo no licence >&2; exit 4"
# Two of tests/conformance/planted_defects.md: number_18_memory_is_never_given_back and number_27_half_of_a_message.
try "        elif \"positions\" in asked:" "        elif \"positions\" in asked:
            import mmap; kept = locals().get(\"kept\", []) + [mmap.mmap(-1, 2**20) for _ in asked[\"positions\"]]" "Cannot allocate memory"
try "print(json.dumps(answer)" "print(json.dumps(answer)[:16384]" "expected a JSON object in one line"

# Words that cannot be tried.
expect 2 "--tolerance: expected" -- conform --command true --tolerance 4
expect 2 "--answer-timeout" -- conform --command true --answer-timeout 0
expect 2 "expected two files" -- conform --command true --json a --junit a
# Interrupted once its renderer runs, however long that takes. The renderer is a copy, since other tests run the original meanwhile.
cp "$renderers/wall.py" own.py
"$forceshade" conform --law wall --points 100000000 --command "touch runs; exec $scratch/own.py" > said 2>&1 &
until [ -e runs ]; do sleep 0.1; done
kill -INT $!; wait $!; same 130 $?
expect 0 "interrupted" -- cat said
same "" "$(pgrep -f "$scratch/own.py" || true)"
# Interrupted while a renderer is silent: not a verdict on the renderer.
"$forceshade" conform --law wall --command "touch silent; exec sleep 3600" > said 2>&1 &
until [ -e silent ]; do sleep 0.1; done
kill -INT $!; wait $!; same 130 $?
expect 0 "forceshade: interrupted: the run was not finished, and nothing was written" -- cat said
