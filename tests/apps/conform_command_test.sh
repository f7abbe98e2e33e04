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
expect 1 "FAILED: a hand at rest feels a force at rest" -- conform --command "python3 noisy.py" --tolerance "1e-3 N"

# Programs that are no renderer at all. A program that greets and then does the rest of the words.
hello='{"forceshade":"conform 1","kind":"renderer","name":"n","version":"1","memory":"none","answers":"force","claims":"definition"'
hello=$hello',"length_unit":"mm","force_unit":"N","frame":["x","y","z"],"domain_mm":10000,"rate_Hz":null,"loop_energy_mJ":0}'
greets() { printf '%s\n' "read line; echo '$hello'; $1" > greets.sh; }
wrong() { expect 1 "$1" -- conform --command "$2"; }
says() { wrong "$1" "read line; $2"; }  # earlier, it would not have been asked
wrong "the renderer ended without an answer" "true"
wrong "ended with exit code 3" "exit 3"
wrong "the shell knows no such command" "no-such-program-anywhere"
wrong "was killed by signal 11" 'kill -SEGV $$'
wrong "; it wrote last on standard error: \"no licence\"" 'echo no licence >&2; exit 4'
says "expected a JSON object in one line" "echo hello"
says "expected a JSON object in one line" "echo '[1]'"
says "expected a JSON object in one line" "printf '\\377\\376\\n'; cat"
says "expected a JSON object in one line" "head -c 1000000 /dev/zero | tr '\\0' '['; echo; cat"
says 'has no key "forceshade"' "echo '{}'; cat"
says 'speaks "conform 9"; expected "conform 1"' "echo '${hello/conform 1/conform 9}'; cat"
# Nothing is guessed: each key without which it has a meaning that nobody declared, and a wrong value of each.
for key in kind name version memory answers claims length_unit force_unit frame domain_mm rate_Hz loop_energy_mJ; do
  says "has no key \"$key\"; expected " "echo '${hello/\"$key\"/\"other\"}'; cat"
done
says 'memory "some"; expected "none" or "path"' "echo '${hello/none/some}'; cat"
says 'answers "work"; expected "force", "impulse" or "closest point"' "echo '${hello/\"force\"/\"work\"}'; cat"
says 'length_unit "inch"; expected "mm" or "m"' "echo '${hello/\"mm\"/\"inch\"}'; cat"
says 'frame ["x","y","y"]; expected a list like' "echo '${hello/\"z\"/\"y\"}'; cat"
says 'domain_mm 0; expected a number from 1 to 10000' "echo '${hello/10000/0}'; cat"
says 'rate_Hz -1; expected a number from 1 to 1e6, or null' "echo '${hello/null/-1}'; cat"
says 'rate_Hz null; expected a number where it answers with an impulse' "echo '${hello/\"force\"/\"impulse\"}'; cat"
says "has name 7; expected a text" "echo '${hello/\"n\"/7}'; cat"
expect 1 "closed its output" -- "$forceshade" conform --law wall --command "exec >&-; sleep 100" --answer-timeout 1
greets "exit 0"; wrong "ended without an answer" "sh greets.sh"
greets "cat"; wrong 'answered without a list "answers"' "sh greets.sh"
greets "echo x; sleep 100"; wrong "wrote" "sh greets.sh"
greets "read line; echo '{\"answers\":[]}'; cat"; wrong "answered 256 positions with 0 entries" "sh greets.sh"
greets "read line; printf '{\"answers\":['; for i in \$(seq 255); do printf 1,; done; echo '1]}'"; wrong "the renderer's answer 0 is 1;" "sh greets.sh"
greets "read line; printf '{\"answers\":['; for i in \$(seq 255); do printf '\"zz\",'; done; echo '\"zz\"]}'"; wrong "24 hexadecimal digits" "sh greets.sh"
mutated 'print(json.dumps(answer), flush=True)' 'print(json.dumps(answer) + "\n" + json.dumps(answer), flush=True)'
finds "" "" "wrote without having been asked"
expect 1 "a line of more than 16777216 bytes" -- conform --command "yes | tr -d '\\n'"
for late in "sleep 100" "cat > /dev/null" "trap '' TERM INT HUP; sleep 100"; do
  expect 1 "did not answer within 0.3 s" -- "$forceshade" conform --law wall --command "$late" --answer-timeout 0.3
done
mutated "        print(json" "        import time; time.sleep(0.5 if \"positions\" in asked else 0)
        print(json"
expect 1 "did not answer within 0.3 s" -- "$forceshade" conform --law wall --command "python3 mutated.py" --answer-timeout 0.3
wrong "" "python3 -c 'x = bytearray(10**11)'"
mutated "        else:
            return  # goodbye" "        else:
            import time; time.sleep(100)"
expect 1 "did not answer within 1 s" -- "$forceshade" conform --law wall --points 100 --command "python3 mutated.py" --answer-timeout 1
mutated "            return  # goodbye" "            sys.exit(5)"
finds "" "" "ended with exit code 5"
# Two of tests/conformance/planted_defects.md: number_18_memory_is_never_given_back and number_27_half_of_a_message.
try "        elif \"positions\" in asked:" "        elif \"positions\" in asked:
            import mmap; kept = locals().get(\"kept\", []) + [mmap.mmap(-1, 2**20) for _ in asked[\"positions\"]]" "Cannot allocate memory"
try "print(json.dumps(answer)" "print(json.dumps(answer)[:16384]" "expected a JSON object in one line"

# Whatever it has started is gone with it.
mark=forceshade_left_over_$$
expect 1 "" -- conform --command "for i in 1 2 3; do setsid sh -c 'exec -a $mark sleep 1000' & done; sleep 0.2; exit 1"
expect 1 "" -- conform --command "setsid setsid bash -c 'exec -a $mark sleep 1000' > /dev/null 2>&1 & sleep 0.2; kill -9 \$\$"
same "" "$(pgrep -f $mark || true)"

# Words that cannot be tried.
expect 2 "--command" -- "$forceshade" conform --law wall
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
