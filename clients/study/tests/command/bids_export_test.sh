#!/usr/bin/env bash
# bids_export_test.sh FORCESHADE-STUDY: exports of both experiments, of finished, interrupted and resumed sessions, as the community's
# validators judge them. FORCESHADE_BIDS_VALIDATOR names a folder in which `npm install bids-validator@1.15.0` was run. Exit code 77, which CTest
# takes for skipped, where it or node is lacking.
judge=$(realpath "$(dirname "$0")/../experiments/bids_validators.mjs")
skip() { echo "skipped: $1"; exit 77; }
command -v node > /dev/null || skip "no node in PATH"
[ -n "${FORCESHADE_BIDS_VALIDATOR:-}" ] ||
  skip "FORCESHADE_BIDS_VALIDATOR does not name a folder in which npm install bids-validator@1.15.0 was run"
[ -d "$FORCESHADE_BIDS_VALIDATOR/node_modules/bids-validator" ] ||
  skip "no node_modules/bids-validator in $FORCESHADE_BIDS_VALIDATOR"
packages=$(realpath "$FORCESHADE_BIDS_VALIDATOR")
. "$(dirname "$0")/../../../../tests/apps/expect.sh"

# Few trials, and a break after each.
cp "$examples"/*.toml .
sed -i 's/^repetitions = .*/repetitions = 1/; s/^reference_radii_mil = .*/reference_radii_mil = [1000]/
        s/^radii_mil = .*/radii_mil = [1000]/; s/^practice_trials = .*/practice_trials = 1/
        s/^trials_before_break = .*/trials_before_break = 1/' matching.toml classification.toml

# run KEYS COMMAND...: a part of a session, which the end of its input interrupts.
run() {
  local keys=$1; shift
  printf "$keys" | "$forceshade" experiment "$@" --device simulated --terminal --certificates none > out.txt 2>&1 ||
    { echo "FAILED: experiment $*: $(cat out.txt)"; exit 1; }
}
for experiment in matching classification; do
  expect 0 "every trial done" -- "$forceshade" experiment virtual $experiment.toml --participants 1 --seed 1 --certificates none --out whole-$experiment
  answer='2\n'
  [ $experiment = matching ] && answer='kjkl7\n'
  # Interrupted at once; in the practice; in a trial; in a break; in a trial again.
  run '' run $experiment.toml --participant B-2 --seed 3 --session cut-$experiment
  run '\n\n' resume cut-$experiment
  run "\\n$answer\\n$(echo "$answer" | cut -c1)" resume cut-$experiment
  run "\\n$answer" resume cut-$experiment
  run '\n' resume cut-$experiment
  grep -q break-started cut-$experiment/trials.jsonl || { echo "FAILED: no break in cut-$experiment"; exit 1; }
  # The first run alone, without an answer and without a tick of a trial.
  run '' run $experiment.toml --participant C3 --seed 4 --session empty-$experiment
done
sessions="whole-matching/V1 whole-classification/V1 cut-matching cut-classification empty-matching empty-classification"
judged() {
  checks=$((checks + 1))
  local output; output=$(node "$judge" "$packages" "$@" 2> /dev/null) || { echo "FAILED: $*:"; echo "$output"; exit 1; }
  echo "$1: $output"
}
# On all together the legacy validator warns (38) that some participants have runs that others lack, which is true of them: B-2 was
# interrupted more often.
"$forceshade" experiment export $sessions --bids nobody || exit 1
judged "$PWD/nobody" legacy-warning=113 legacy-warning=38
"$forceshade" experiment export $sessions --bids authors --authors 'Ada Lovelace' --authors 'Müller, Jörg' || exit 1
judged "$PWD/authors" legacy-warning=38
for part in whole-matching/V1 cut-matching cut-classification empty-matching empty-classification; do
  "$forceshade" experiment export $part --bids "alone-${part%%/*}" --authors 'Ada Lovelace' --authors 'Grace Hopper' || exit 1
  judged "$PWD/alone-${part%%/*}"
done
"$forceshade" experiment export whole-matching/V1 whole-classification/V1 --bids both || exit 1
judged "$PWD/both" legacy-warning=113
for name in nobody authors; do
  for run in 1 2 3 4 5; do
    [ -s "$name/sub-B2/beh/sub-B2_task-matching_run-${run}_events.tsv" ] || { echo "FAILED: no run $run in $name"; exit 1; }
  done
done

# The judge is able to fail.
refuses() {
  cp -r both broken
  sed -i "$2" broken/$1 || exit 1
  expect 1 "$3" -- node "$judge" "$packages" "$PWD/broken"
  rm -r broken
}
motion=sub-V1/motion/sub-V1_task-matching_tracksys-stylus_run-1
refuses sub-V1/beh/sub-V1_task-matching_run-1_events.json '1s/{/{"TaskName": "matching",/' "['TaskName'] should be object"
refuses ${motion}_channels.json 's/"Description": "x to/"RotationRule": "n\/a", &/' "RotationRule should be equal"
refuses ${motion}_motion.json '1s/{/{"SpatialAxes": "RFU",/' "should NOT have additional properties"
refuses ${motion}_motion.json '/"SamplingFrequency"/d' "schema error"
refuses dataset_description.json 's/"1.9.0"/19/' "schema error"
echo "$checks checks"
