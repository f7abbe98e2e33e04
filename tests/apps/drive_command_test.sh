#!/usr/bin/env bash
# The forceshade command as its users call it: certificates, runs of a device and recordings, and what is left behind when things go wrong.
stand_in_hd=$(realpath "$2")
. "$(dirname "$0")/expect.sh"
. "$examples/../tests/apps/command_inputs.sh"

recording() { "$forceshade" recording "$@"; }
# certify and drive: certified, other parameters, other law, no certificate, a certificate of another build.
expect 0 "certified: 1250000 points" -- "$forceshade" certify --law bump-1p-shaded --out here
[ -s here/certificate.json ] && [ -s here/certificate.html ] || { echo "FAILED: certify wrote nothing"; exit 1; }
plan() { "$forceshade" certify plan --exhaustive "$@"; }
expect 2 "too many inputs to sweep" -- plan --height-map hill.toml --out new/no
same "" "$(ls -d no new 2> /dev/null)"
# Without gnuplot the page has no pictures, and the certificate is whole.
expect 0 "certificate.html has no pictures: gnuplot was not found" -- env PATH=/nonexistent "$forceshade" certify --law wall \
  --points 1000 --cases 10 --seed 18446744073709551615 --out plain
grep -q "^ *18446744073709551615$" plain/certificate.json && grep -q "Summary" plain/certificate.html ||
  { echo "FAILED: no certificate without gnuplot"; exit 1; }
same 0 "$(grep -c "<figure>" plain/certificate.html)"
expect 1 "the certificate has 1000 points for wall; driving needs at least 1000000" -- \
  "$forceshade" drive --law wall --device null --certificate plain/certificate.json
printf 't_s,x_mm,y_mm,z_mm\n0,3,0,-1\n0.001,4,0,-1\n0.002,4,0,1\n' > hand.csv
drive() { "$forceshade" drive --device replay:hand.csv --pace none "$@"; }
expect 0 "missed deadlines  0" -- drive --law bump-1p-shaded --certificate here/certificate.json --out record.csv --json run.json
same "tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us" "$(head -1 record.csv | cut -d, -f1-11)"
same "" "$(ls -d record.csv.partial* 2> /dev/null)"
same 5 "$(wc -l < record.csv)"
same "0,0,0,end" "$(tail -1 record.csv | cut -d, -f7-10)"
for key in ticks missed_deadlines overruns compute_us p50 p99 p999 p9999 max histogram tick_us wakeup_us peak_force_N \
  energy_given_mJ energy_taken_mJ certificate_digest supervisor trip limited_ticks passivity balance_mJ; do
  grep -q "\"$key\"" run.json || { echo "FAILED: run.json lacks $key"; exit 1; }
done
same "$(sha256sum here/certificate.json | cut -d' ' -f1)" "$(sed -n 's/.*"certificate_digest": "\(.*\)".*/\1/p' run.json)"
# A recording of 100 Hz takes as long as it took: 20 ms are 21 readings at 1 kHz.
printf 't_s,x_mm,y_mm,z_mm\n5,0,0,-1\n5.01,1,0,-1\n5.02,2,0,-1\n' > slow.csv
expect 0 "ticks             21 (end of data)" -- \
  "$forceshade" drive --law wall --certificate none --pace none --device replay:slow.csv --out slow_run.csv
same "5.005,0.5,0,-1" "$(sed -n 7p slow_run.csv | cut -d, -f3-6)"
mkfifo pipe.csv
expect 2 "pipe.csv: cannot open: it is a named pipe; expected a file" -- \
  "$forceshade" drive --law wall --certificate none --device replay:pipe.csv
expect 1 "refused to drive: here/certificate.json: the certificate covers bump-1p-shaded with other parameters" -- \
  drive --law bump-1p-shaded --stiffness 0.6 --certificate here/certificate.json
expect 1 "does not cover the law wall" -- drive --law wall --certificate here/certificate.json
expect 1 "no certificate was given" -- drive --law wall
expect 0 "UNCERTIFIED" -- drive --law wall --certificate none
sed 's/\("library_digest": "\)......../\1deadbeef/' here/certificate.json > other.json
expect 1 "another build" -- drive --law bump-1p-shaded --certificate other.json
# As a program writes it of a renderer of its own, and as a version wrote it that did not say whose renderer was compared.
sed 's/"renderer": "library"/"renderer": "program"/' here/certificate.json > own.json
expect 1 "refused to drive: own.json: the certificate is of a program's own renderer for bump-1p-shaded; driving needs one of the" -- \
  drive --law bump-1p-shaded --certificate own.json
expect 2 "certify merge: expected the folder of one plan, got here/certificate.json; points of several" -- \
  "$forceshade" certify merge here/certificate.json --out both
expect 2 "expected a forceshade certificate" -- drive --law wall --certificate in.csv
expect 0 "(time up)" -- "$forceshade" drive --law wall --certificate none --device simulated --seconds 0.1 --pace none
expect 0 "(end of data)" -- "$forceshade" drive --law wall --certificate none --device simulated:omni:hand.csv --pace none
expect 0 "(time up)" -- "$forceshade" drive --law wall --certificate none --device null --seconds 0.1 --pace none
# A line follows the run in a terminal, and nowhere else.
watched="$forceshade drive --law wall --certificate none --device null --seconds 0.5 --watchdog-timeout 1"
expect 0 " Hz  late " -- script -qec "$watched" /dev/null
same "" "$($watched 2>&1 | grep " Hz  late ")"
# In a narrow terminal it is as narrow, so that it does not wrap.
script -qec "stty cols 40; $watched" /dev/null | tr '\r' '\n' | sed 's/\x1b\[K//' | grep -a ' mJ$\| N ' > narrow.txt
same 39 "$(awk '{ if (length($0) > most) most = length($0) } END { print (most <= 39 && most > 20) ? 39 : most }' narrow.txt)"
# A stiffness that a slow loop cannot render passively: the words at the start, in the summary, and those of the rules.
expect 0 "a stiffness of 2 N/mm at 100 Hz cannot be passive" -- \
  "$forceshade" drive --law wall --stiffness 2 --rate 100 --certificate none --device simulated \
  --seconds 6 --pace none --json slow.json
also "premium-1.5 has 0.0108" "limited by oscillation" "; the arm's friction took at least"
grep -q '"warning": "a stiffness of 2 N/mm at 100 Hz' slow.json || { echo "FAILED: the summary has no warning"; exit 1; }
expect 3 "the supervisor stopped the run: energy" -- \
  "$forceshade" drive --law wall --stiffness 3 --rate 100 --certificate none --device simulated \
  --seconds 6 --pace none --passivity observer
expect 0 "passivity         tank: account" -- \
  "$forceshade" drive --law wall --certificate none --device simulated --seconds 0.1 --pace none --passivity tank
expect 2 "none to read from" -- setsid -w "$forceshade" drive --law wall --certificate none --device simulated --dead-man 0
expect 2 "dead-man button" -- drive --law wall --certificate none --dead-man 1 --out never.fsr
same "" "$(ls | grep never)"
expect 0 "not supervised" -- drive --law wall --certificate none
# A hand that is torn sideways under force: the supervisor ends the run, and says why.
{ echo t_s,x_mm,y_mm,z_mm; for i in $(seq 0 19); do echo "0.$((i / 10))$((i % 10))0,0,0,3"; done
  echo "0.300,0,0,-6"; echo "1.5,0,0,-6"; echo "1.51,120,0,-6"; echo "2,120,0,-6"; } > torn.csv
expect 3 "the supervisor stopped the run: velocity" -- "$forceshade" drive --law wall --certificate none --pace none \
  --device simulated:premium-1.5:torn.csv --out torn.fsr --json torn.json
expect 0 "end_reason           tripped" -- recording check torn.fsr
also "device_model         premium-1.5"
same "" "$(recording check torn.fsr | grep device_serial)"
expect 3 "before the end    201 ticks kept" -- \
  "$forceshade" drive --law wall --certificate none --pace none --device simulated:premium-1.5:torn.csv
also "mm/s; force 0.000 N, one tick before "
grep -q '"rule": "velocity"' torn.json || { echo "FAILED: torn.json has no trip"; exit 1; }
# A place that is no number has no force where a hand is replayed, and ends the run of a simulated one.
printf 't_s,x_mm,y_mm,z_mm\n0,0,0,3\n0.01,0,0,3\n0.02,nan,0,3\n0.03,0,0,3\n' > lost.csv
expect 0 "invalid positions 1 (zero force)" -- \
  "$forceshade" drive --law wall --certificate none --pace none --rate 100 --device replay:lost.csv
expect 3 "the simulated arm's position is no longer finite" -- \
  "$forceshade" drive --law wall --certificate none --pace none --device simulated:omni:lost.csv
# A PHANToM: no driver library, one found by its name, one named, and a licence that is missing.
phantom() { env LD_LIBRARY_PATH= FORCESHADE_HD_LIBRARY= "$@" "$forceshade" drive --law wall --certificate none --device phantom --seconds 0.1; }
expect 3 "libHD.so.3.0: cannot open shared object file" -- phantom
expect 3 "/nowhere/libHD.so: cannot open shared object file" -- phantom FORCESHADE_HD_LIBRARY=/nowhere/libHD.so
expect 3 "it lacks hdInitDevice" -- phantom FORCESHADE_HD_LIBRARY=libm.so.6
expect 3 "the vendor's licence is missing" -- phantom LD_LIBRARY_PATH="$(dirname "$stand_in_hd")" STAND_IN_HD_INIT=0x600
expect 3 "the vendor's licence is missing" -- phantom FORCESHADE_HD_LIBRARY="$stand_in_hd" STAND_IN_HD_INIT=0x600

# A file that exists is replaced only with --overwrite, whatever option names it, and is refused before any work.
echo old > kept
for option in "force in.csv --law wall --out" "energy --law bump-1p --depth 1 --json" "laws --theta-critical 40 --json" \
  "laws --json" "drive --law wall --certificate none --device null --seconds 0.01 --pace none --json" \
  "drive --law wall --certificate none --device null --seconds 0.01 --pace none --out" "device --json"; do
  expect 2 'expected a new file, or --overwrite beside it; "kept" is there already' -- "$forceshade" $option kept
  same old "$(cat kept)"
  expect 0 "" -- "$forceshade" $option kept --overwrite
  checks=$((checks + 1))
  [ "$(cat kept)" != old ] || { echo "FAILED: $option kept --overwrite kept it"; exit 1; }
  echo old > kept
done
echo old > kept.fsr; echo old > kept.fsr-wal
expect 2 '"kept.fsr" is there already' -- drive --law wall --certificate none --out kept.fsr
expect 0 "" -- drive --law wall --certificate none --out kept.fsr --overwrite
expect 0 "whole: 4 samples" -- "$forceshade" recording check kept.fsr
"$forceshade" drive --law wall --certificate none --device simulated --out running.fsr > /dev/null 2>&1 &
until [ -e running.fsr-wal ]; do sleep 0.02; done
expect 2 "running.fsr: cannot replace the recording: the process $! writes it" -- \
  drive --law wall --certificate none --out running.fsr --overwrite
stopped INT
expect 0 "whole" -- "$forceshade" recording check running.fsr
for folder in "plot force --law wall" "plot thesis" "certify --law wall --points 1000 --cases 10"; do
  mkdir -p rule; rm -f rule/*
  expect 0 "" -- "$forceshade" $folder --out rule
  file=$(ls rule | head -1); echo old > "rule/$file"
  expect 2 'expected a new file, or --overwrite beside it; "rule/' -- "$forceshade" $folder --out rule
  same old "$(cat "rule/$file")"
  expect 0 "" -- "$forceshade" $folder --out rule --overwrite
done
expect 0 "" -- "$forceshade" laws --json /dev/null

# recording: a whole recording, one on a disk that refuses, one killed; files that are none.
expect 0 "(end of data)" -- drive --law bump-1p-shaded --certificate here/certificate.json --out run.fsr
expect 2 '--out: expected a new file, or --overwrite beside it; "run.fsr" is there already' -- \
  drive --law wall --certificate none --out run.fsr
expect 0 "certificate_digest   $(sha256sum here/certificate.json | cut -d' ' -f1)" -- recording check run.fsr
also "device               replay:hand.csv"
expect 0 '"radius_mm": "15.24"' -- recording check run.fsr --json -
expect 0 "whole: 4 samples" -- recording check run.fsr
expect 0 "" -- recording export run.fsr --out run.csv
expect 0 "" -- recording export run.fsr --out run.npy
same "$(cat run.csv)" "$(recording export run.fsr)"
same "$(cut -d, -f1,3-10 record.csv)" "$(cut -d, -f1,3-10 run.csv)"
same "NUMPY" "$(head -c 6 run.npy | tail -c 5)"
expect 2 "nowhere" -- recording export run.fsr --out nowhere/run.csv
expect 2 "in.csv: expected a recording (.fsr), got a CSV file" -- recording check in.csv
mkfifo pipe.fsr
expect 2 "pipe.fsr: expected a recording, got no regular file" -- timeout 10 "$forceshade" recording check pipe.fsr
# Said before the work: a folder that is not there, and standard output for several files.
expect 2 '--junit: expected a file in a folder that can be written to, got "nowhere/a.xml"' -- \
  timeout 10 "$forceshade" properties --law all --cases 1000000000 --junit nowhere/a.xml
expect 2 '--junit: expected a file in a folder that can be written to, got "nowhere/a.xml"' -- \
  timeout 10 "$forceshade" certify --law wall --points 1000000000000 --out unwritten --junit nowhere/a.xml
same "" "$(ls -d -- unwritten - 2> /dev/null)"
# A file that someone else made: nothing in it commands the terminal, and one that is damaged says so.
corpus="$(dirname "$examples")/tests/fuzz/corpus"
expect 0 'law                  \x1b[2Jwall' -- recording check "$corpus/recording/escape.fsr"
expect 0 '"\u009bkey": "\u202egpj"' -- recording check "$corpus/recording/escape.fsr" --json -
same "" "$(recording check "$corpus/recording/escape.fsr" | tr -d '[:print:]\n')"
expect 1 "the metadata (law, parameters, certificate, device and so on) are not what was written" -- \
  recording check "$corpus/recording/changed_stiffness.fsr"
expect 2 "are not what was written" -- recording export "$corpus/recording/changed_stiffness.fsr" --out never.csv
same "" "$(ls | grep never)"
expect 1 "0 missing, 2 repeated" -- recording check "$corpus/recording/twice.fsr"
expect 0 "format 2 has no checksum of the metadata" -- recording check "$corpus/recording/format2.fsr"
expect 0 "every checksum, and the metadata" -- recording check "$corpus/recording/whole.fsr"
expect 2 "recording: expected a command: check, export; got none" -- recording
small_disk() { (trap '' XFSZ; ulimit -f 200; "$@"); }
expect 2 "full.fsr: disk I/O error; recorded" -- \
  small_disk "$forceshade" drive --law wall --certificate none --device simulated --pace none --seconds 20 --out full.fsr
expect 1 "no end" -- recording check full.fsr
no_disk() { (trap '' XFSZ; ulimit -f 0; "$@"); }
expect 2 "forceshade: unmade.csv: " -- no_disk "$forceshade" drive --law wall --certificate none --device null --seconds 0.1 --out unmade.csv
same "" "$(ls | grep unmade)"
"$forceshade" drive --law wall --certificate none --device null --out killed.fsr 2> killed.txt &
until [ -n "$(find . -name 'killed.fsr-wal' -size +40k)" ]; do sleep 0.02; done
kill -KILL $!; wait $! 2> /dev/null
expect 1 "killed.fsr: no end: cut off" -- recording check killed.fsr
expect 0 "the recording has no end" -- recording export killed.fsr --out killed.csv
checks=$((checks + 1))
[ "$(wc -l < killed.csv)" -gt 1 ] || { echo "FAILED: nothing was recorded before the kill: $(cat killed.txt)"; exit 1; }

# Ctrl-C: a drive ends with force zero and its record complete; certify and force leave nothing.
{ echo t_s,x_mm,y_mm,z_mm; for i in $(seq 0 20000); do echo "$i,3,0,-1"; done; } > long.csv
"$forceshade" drive --law wall --certificate none --device replay:long.csv --out stopped.csv > stopped.txt 2>&1 &
until [ -n "$(find stopped.csv.partial-* -size +40k 2> /dev/null)" ]; do sleep 0.02; done
stopped INT; same 0 $?
grep -q "(stopped)" stopped.txt || { echo "FAILED: not stopped: $(cat stopped.txt)"; exit 1; }
same "0,0,0,end" "$(tail -1 stopped.csv | cut -d, -f7-10)"
same "$(($(sed -n 's/^ticks *\([0-9]*\).*/\1/p' stopped.txt) + 2))" "$(wc -l < stopped.csv)"
"$forceshade" certify --points 1000000000 --out stopped > stopped.txt 2>&1 &
stopped INT; same 130 $?
grep -q "interrupted" stopped.txt || { echo "FAILED: $(cat stopped.txt)"; exit 1; }
same "" "$(ls -d stopped 2> /dev/null)"
echo "$checks checks passed"
