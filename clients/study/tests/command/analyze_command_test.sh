#!/usr/bin/env bash
# analyze_command_test.sh FORCESHADE-STUDY: forceshade-study analyze as its users call it: tables, JSON, figures, messages, and what is left behind.
. "$(dirname "$0")/../../../../tests/apps/expect.sh"
analyze() { "$forceshade" analyze "$@"; }

# Two participants, as computed by hand in clients/study/tests/analysis/statistics_test.cpp.
mkdir hand
{
  echo participant,trial,vision,stimulus,initial,repetition,reference_radius_mil,initial_radius_mil,final_radius_mil,satisfaction,steps,seconds
  trial=0
  row() { trial=$((trial + 1)); echo "$1,$trial,no,bump-cylinder,same,1,$2,$2,$3,$4,$5,60"; }
  row A 600 540 7 10; row A 600 600 8 20; row A 600 660 9 30
  row A 800 665 6 12; row A 800 700 6 14; row A 800 735 6 16
  row A 1000 731 5 8; row A 1000 860 7 20; row A 1000 989 9 23
  row B 600 570 9 3; row B 600 600 9 3; row B 600 630 9 3
  row B 800 760 9 3; row B 800 800 9 3; row B 800 840 9 3
  row B 1000 950 9 3; row B 1000 1000 9 3; row B 1000 1050 9 3
} > hand/matching.csv
expect 0 "Table 6.1: Circular cylinder, no vision" -- analyze hand --bootstrap 200
expect 0 "  A            9       0.65 (" -- analyze hand --bootstrap 200
expect 0 "  thesis       300     0.97" -- analyze hand --bootstrap 200
expect 0 "95 % BCa intervals (Efron 1987) of 200 resamples, seed 7; units: trials" -- analyze hand --bootstrap 200 --seed 7
value() { analyze hand --bootstrap 200 --json | jq -c "$1"; }
same '[0.65,10,7,17]' "$(value '[.matching[0].rows[0] | .slope, .mean_sd_percent, .mean_satisfaction, .mean_steps | .value * 1e9 | round / 1e9]')"
same '[0.825,8,10]' "$(value '[.matching[0].rows[2] | .slope, .mean_satisfaction, .mean_steps | .value * 1e9 | round / 1e9]')"
same '["overall",18,"6.1",0.97]' "$(value '[.matching[0].rows[2].participant, .matching[0].rows[2].trials, .matching[0].thesis_overall.table, .matching[0].thesis_overall.slope]')"
same '[]' "$(value '.psychometric')"

# The same seed gives the same bytes, another seed others; other units other intervals.
analyze hand --bootstrap 200 --seed 3 --json > first.json
analyze hand --bootstrap 200 --seed 3 --json > again.json
analyze hand --bootstrap 200 --seed 4 --json > other.json
analyze hand --bootstrap 200 --seed 3 --resample participants --json > people.json
cmp -s first.json again.json || { echo "FAILED: the same seed gave other numbers"; exit 1; }
for file in other people; do ! cmp -s first.json $file.json || { echo "FAILED: $file.json is first.json"; exit 1; }; done
expect 0 "units in overall rows: participants" -- analyze hand --bootstrap 200 --resample participants

# Figures and page, and no second time.
if command -v gnuplot > /dev/null; then
  expect 0 "Table 7.1" -- analyze hand --bootstrap 200 --out made
  same "matching-bump-cylinder-no-vision.png matching-bump-cylinder-no-vision.svg report.html satisfaction-bump-cylinder-no-vision.png satisfaction-bump-cylinder-no-vision.svg tables.csv" \
    "$(ls made | tr '\n' ' ' | sed 's/ $//')"
  expect 2 "is there already" -- analyze hand --bootstrap 200 --out made
  expect 0 "" -- analyze hand --bootstrap 200 --out made --overwrite
fi
PATH=/nonexistent expect 0 "warning: no figures: gnuplot was not found" -- analyze hand --bootstrap 200 --out bare
same "report.html tables.csv" "$(ls bare | tr '\n' ' ' | sed 's/ $//')"

# Two folders are taken together; classification alone is enough.
mkdir second broken empty
echo participant,trial,stimulus,radius_mil,repetition,answer,seconds > second/classification.csv
for radius in 600 1000 1400; do for bump in 1p 2p 3p; do for answer in 4 4 3; do
  trial=$((trial + 1)); echo "C,$trial,bump-$bump-shaded,$radius,1,$answer,10" >> second/classification.csv
done; done; done
expect 0 "Table 6.9: answers, all participants" -- analyze second --bootstrap 200
expect 0 "Two polygons, shaded    600           3       0 (0 to 71)  0 (0 to 71)  33 (" -- analyze second --bootstrap 200
expect 0 "Answer 4 against the angle" -- analyze hand second --bootstrap 100
same '[3,9]' "$(analyze hand second --bootstrap 100 --json | jq -c '[(.matching[0].rows | length), (.psychometric[0].points | length)]')"

# Names that no file can have.
sed 's/bump-cylinder/own bump/' hand/matching.csv > second/matching.csv
expect 0 "Table: own bump, no vision" -- analyze second --bootstrap 100 --out named
if command -v gnuplot > /dev/null; then
  [ -s named/matching-own_bump-no-vision.svg ] || { echo "FAILED: files of own names: $(ls named)"; exit 1; }
fi
{ cat second/matching.csv; sed '1d; s/bump-cylinder/own_bump/; s/^\([AB]\),/\12,/' hand/matching.csv; } > broken/matching.csv
expect 2 'two are own_bump-no-vision' -- analyze broken --out none
sed -i 's/own_bump/Own_bump/' broken/matching.csv
expect 2 'two are ' -- analyze broken --out none

# The course of one trial: its radii from radius.csv.
expect 2 "--trial: expected PARTICIPANT:NUMBER such as P-01:12, got \"A\"" -- analyze hand --trial A --out none
expect 2 "--trial: expected --out beside it" -- analyze hand --trial A:2
expect 2 "with its radii (radius.csv) or its ticks (the folder of a session), got A:2" -- analyze hand --trial A:2 --out none
[ ! -e none ] || { echo "FAILED: a folder is left behind"; exit 1; }
printf 'participant,trial,step,seconds,radius_mil\nA,2,0,0,600\nA,2,1,3.5,620\nA,2,2,5,600\n' > hand/radius.csv
if command -v gnuplot > /dev/null; then
  expect 0 "" -- analyze hand --bootstrap 100 --trial A:2 --out course
  grep -q "A, bump-cylinder, no vision, trial 2" course/radius-profiles.svg || { echo "FAILED: the radii have no title"; exit 1; }
fi
rm hand/radius.csv

# The pages say who answered, and people and virtual participants are not taken together.
mkdir models people
sed '1s/$/,answered_by,device,certified/; 2,$s/$/,virtual participant,simulated:premium-1.5,no/' hand/matching.csv > models/matching.csv
sed '1s/$/,answered_by,device,certified/; 2,$s/$/,person,phantom,yes/; s/^A/P/; s/^B/Q/' hand/matching.csv > people/matching.csv
expect 0 "These are virtual participants: a model answered, and no person." -- analyze models --bootstrap 100
also "Device: simulated:premium-1.5 (18 trials)." "Forces: not certified in 18 trials."
expect 0 "Device: phantom (18 trials)." -- analyze people --bootstrap 100
same '[["A","B"],[],{"simulated:premium-1.5":18},18]' \
  "$(analyze models --bootstrap 100 --json | jq -c '.answered_by | [.virtual_participants, .people, .trials_by_device, .trials_not_certified]')"
expect 2 "got both: A is a virtual participant, a model, and P is a person; analyse them separately" -- analyze models people --out none
mkdir unknown
sed 's/^A,/U,/; s/^B,/V,/' hand/matching.csv > unknown/matching.csv
expect 2 "got both: A is a virtual participant, a model, and U is not recorded as one" -- analyze models unknown --out none
PATH=/nonexistent expect 0 "" -- analyze models --bootstrap 100 --out of-models
expect 0 "2 virtual participants, 18 matching" -- cat of-models/report.html
expect 0 ",virtual participant" -- cat of-models/tables.csv

# Refusals name the file, line and column, and nothing is left behind.
sed '4s/A,3/A,x/' hand/matching.csv > broken/matching.csv
expect 2 'broken/matching.csv:4: column 2 (trial): expected a whole number from 1 to 1000000, got "x"' -- analyze broken --out none
expect 2 'empty: expected matching.csv, classification.csv or both, found neither' -- analyze empty --out none
expect 2 './hand: trial 1 of participant A is in an earlier folder, too' -- analyze hand ./hand --out none
cp -r hand copy
expect 2 'copy: trial 1 of participant A is in an earlier folder, too' -- analyze hand copy --out none
head -1 hand/matching.csv > empty/matching.csv
expect 2 'empty: expected at least one trial, got none' -- analyze empty --out none
sed 's/^A,/overall,/' hand/matching.csv > broken/matching.csv
expect 2 'expected a name other than "overall"' -- analyze broken --out none
expect 2 '--bootstrap: expected a whole number from 100' -- analyze hand --bootstrap 5
expect 2 '--width' -- analyze hand --width 0mm
expect 2 'folder' -- analyze
[ ! -e none ] || { echo "FAILED: a command that failed left a folder"; exit 1; }
echo "$checks checks passed"
