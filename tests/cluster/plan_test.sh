#!/usr/bin/env bash
# plan_test.sh FORCESHADE [SHIM]: the units of a plan done by many processes that are killed, stopped, starved and fooled: the
# evidence has the bytes of one process's. SHIM: the library made of late_attributes.cpp.
shim=${2:+$(realpath "$2")}
. "$(dirname "$0")/../apps/expect.sh"

certify() { "$forceshade" certify "$@"; }
# Half a second of work for one thread, in units that take about 30 ms.
what=(--law wall,bump-2p-shaded --points 100000 --cases 100)
plan() { certify plan "${what[@]}" --units 20 --lease 2 --out "$1" > "$1.txt" || exit 1; }
# Only in a process of its own: a command substitution, or with &.
work() { exec "$forceshade" certify work "$@" --threads 1; }
# same_bytes NAME: the evidence and every result are those of one process.
same_bytes() {
  expect 0 "held" -- certify merge "$1" --out "$1-merged" --overwrite
  cmp "$1-merged/evidence.json" one-merged/evidence.json || { echo "FAILED: $1: another evidence"; exit 1; }
  diff -r -x '.*' one/results "$1/results" || { echo "FAILED: $1: other results"; exit 1; }
  checks=$((checks + 2))
}

plan one
expect 1 "0 of 24 units done" -- certify merge one
expect 0 "the plan is complete" -- work one
same_bytes one
# Without a plan.
certify "${what[@]}" --out direct > direct.txt || exit 1
cmp direct/evidence.json one-merged/evidence.json || { echo "FAILED: certify without a plan has another evidence"; exit 1; }

# Three at once, each killed after a while, until those that are left end.
plan killed
for round in 1 2; do
  for delay in 0.06 0.09 0.13; do
    (work killed > /dev/null 2>&1 & pid=$!; sleep $delay; kill -9 $pid 2> /dev/null; wait $pid 2> /dev/null)
  done
  certify merge killed --out "killed-$round" > killed.txt 2>&1  # at any time
  ! grep -q incomplete killed.txt || grep -q '"complete": false' "killed-$round/evidence.json" ||
    { echo "FAILED: it does not say that it is incomplete"; exit 1; }
done
for i in 1 2 3; do work killed > "killed-$i.txt" & done
wait
same_bytes killed
expect 0 "0 taken" -- certify merge killed

# Stopped with SIGINT: no claim is left, and it says how to go on.
plan stopped
work stopped > stopped.txt 2>&1 & pid=$!
until ls stopped/results/*/*.json > /dev/null 2>&1; do sleep 0.01; done
kill -INT $pid; wait $pid; same 130 $?
grep -q "the same command goes on" stopped.txt || { echo "FAILED: $(cat stopped.txt)"; exit 1; }
same "" "$(ls stopped/claims)"
expect 0 "the plan is complete" -- work stopped
same_bytes stopped

# No room, and a folder that cannot be written to: words and exit code 2; nothing half-written is taken for a result.
plan full
if unshare -m true 2> /dev/null && [ "$(id -u)" = 0 ]; then
  unshare -m bash -c '
    mount -t tmpfs -o size=80k,nr_inodes=18 none full/results && mkdir full/results/0
    "$0" certify work full --threads 1; echo $? > code; cp -r full/results/0 kept' "$forceshade" > full.txt 2>&1
  same 2 "$(cat code)"
  grep -q "No space left on device" full.txt || { echo "FAILED: $(cat full.txt)"; exit 1; }
  cp -r kept full/results/0
  expect 0 "the plan is complete" -- work full
  same_bytes full
else
  echo "no test of a full disk: mounting one needs root"
fi
plan closed
rmdir closed/claims; touch closed/claims
expect 2 "closed/claims" -- work closed

# Damaged and truncated results are named; without them the units are done again.
plan damaged
expect 0 "the plan is complete" -- work damaged
truncate -s 100 damaged/results/0/5.json; : > damaged/results/0/6.json; sed -i 's/"unit":7/"unit":8/' damaged/results/0/7.json
for unit in 5 6 7; do
  expect 2 "damaged/results/0/$unit.json: is damaged" -- certify merge damaged --out no
  rm damaged/results/0/$unit.json
done
expect 1 "missing: units 5 to 7 of" -- certify merge damaged
expect 0 "3 units done here" -- work damaged
same_bytes damaged

# A machine that computes wrongly: both results are kept, and nothing is merged.
plan wrong
mkdir -p wrong/results/0
line=$(head -1 one/results/0/3.json | sed 's/"mismatches":0/"mismatches":1/')
printf '%s\nsha256 %s\n' "$line" "$(printf %s "$line" | sha256sum | cut -d' ' -f1)" > wrong.json
work wrong > wrong.txt 2>&1 & pid=$!
ln wrong.json wrong/results/0/3.json 2> /dev/null
wait $pid
rm -f wrong/results/0/3.json; cp one/results/0/3.json wrong/results/0/3.differs-0123456789abcdef.json; ln wrong.json wrong/results/0/3.json
expect 1 "ALARM" -- certify merge wrong
expect 1 "3.differs-0123456789abcdef.json differs from the result of the same unit" -- certify merge wrong --out no

# Files that are no run among the runs are left out.
cp -r one odd; mkfifo odd/runs/pipe
for text in '{"plan": 1}' '{"plan": null}' '[' ''; do
  echo "$text" > odd/runs/odd.json
  expect 0 "" -- certify merge odd --out odd-out --overwrite
done

# Another build, another plan, no plan.
plan other
sed -i 's/"instruction_set": "[a-z0-9]*"/"instruction_set": "scalar"/' other/plan.json
expect 2 "the plan is for another instruction set: expected scalar" -- work other
sed -i 's/"library_digest": "0/"library_digest": "1/; t; s/"library_digest": "./"library_digest": "0/' other/plan.json
expect 2 "the plan is for another build of the library" -- certify merge other
expect 2 "one/plan.json: is there already" -- certify plan --law wall --out one
expect 2 "no/plan.json" -- work no
printf 'OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n' > $'\xff.off'
expect 2 '--mesh: expected a name in UTF-8, as a plan'"'"'s file is, got "' -- certify plan --mesh $'\xff.off' --unit mm --out latin
also '\xff.off"'
[ ! -e latin ] || { echo "FAILED: a plan that was refused left a folder"; exit 1; }
certify plan "${what[@]}" --seed 2 --units 20 --out seed > /dev/null; rm -r seed/results; cp -r one/results seed
expect 2 "the digest of the plan" -- certify merge seed --out no

# Sweeps: the same units as without a plan.
certify plan --exhaustive directions --law bump-1p-shaded --radius 20mm --units 16 --out sweep > sweep.txt 2>&1 ||
  grep -q "expected a kind of sweep" sweep.txt || { echo "FAILED: $(cat sweep.txt)"; exit 1; }

# Attributes that come late, and links whose answer is lost.
if [ -n "$shim" ]; then
  plan late
  for i in 1 2 3; do LATE_MS=1000 LD_PRELOAD=$shim work late > "late-$i.txt" 2>&1 & done
  (sleep 0.3; LATE_MS=1000 LD_PRELOAD=$shim work late > /dev/null 2>&1 & pid=$!; sleep 0.3; kill -9 $pid; wait $pid) 2> /dev/null
  wait
  grep -L "the plan is complete" late-?.txt | grep . && { echo "FAILED: $(cat late-?.txt)"; exit 1; }
  grep -h ALARM late-?.txt && { echo "FAILED: an alarm"; exit 1; }
  same_bytes late
fi
echo "$checks checks"
