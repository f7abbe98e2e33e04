#!/usr/bin/env bash
# output_test.sh FORCESHADE: what a command writes goes to pipes and descriptors, appears whole or not at all, and has the format
# that its name says; an unfinished tick is called that.
. "$(dirname "$0")/expect.sh"
printf 'x_mm,y_mm,z_mm\n0,0,-1\n' > in.csv
force() { "$forceshade" force in.csv --law wall "$@"; }
row=0,0,-1,0,0,0.5,contact

# Descriptors and pipes.
for name in - /dev/stdout /dev/fd/1 /proc/self/fd/1; do same "$row" "$(force --out $name | tail -1)"; done
echo before > log
force --out /dev/fd/3 3>> log
same "before x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status $row" "$(echo $(cat log))"
same "$row" "$( (force --out >(tail -1 > piped; echo > done); until [ -e done ]; do sleep 0.05; done; cat piped) )"
mkfifo named
tail -1 named > piped & force --out named; wait $!
same "$row" "$(cat piped)"
[ -p named ] || { echo "FAILED: the named pipe was replaced"; exit 1; }
expect 0 "<testsuites" -- sh -c "'$forceshade' properties --law wall --cases 20 --junit /dev/stdout | cat"
same 1 "$("$forceshade" laws --json /dev/stdout | wc -l)"
expect 2 "/dev/full: cannot write: No space left on device" -- force --out /dev/full
# A limit of the size of files is a full disk: what was begun is removed.
(ulimit -f 0; expect 2 "limited.csv: cannot write: File too large" -- force --out limited.csv) || exit 1
(ulimit -f 1; expect 2 "limited/certificate.json: cannot write: File too large" -- \
  "$forceshade" certify --law wall --points 1000 --cases 10 --out limited) || exit 1
same "" "$(ls -d limited*)"
for name in - /dev/stdout /dev/null named in.csv; do
  expect 2 "--out: expected a directory, for the command writes several files, got \"$name\"" -- "$forceshade" plot --law wall --out $name
done
expect 2 '--out: expected a file, got ".", which is a folder' -- force --out . --overwrite

# A symbolic link is followed, also where it leads to nothing yet, and never replaced.
ln -s made.csv loose.csv; ln -s nowhere/made.csv lost.csv; ln -s round.csv round.csv; ln -s made.json loose.json; ln -s made.fsr loose.fsr
ln -s absent folder
expect 0 "" -- force --out loose.csv
same "$row" "$(tail -1 made.csv)"
expect 0 "" -- "$forceshade" laws --json loose.json
grep -q theta made.json || { echo "FAILED: no JSON behind the link"; exit 1; }
for replacing in "" --overwrite; do
  expect 0 "" -- "$forceshade" drive --law wall --certificate none --device null --seconds 0.01 --pace none --out loose.fsr $replacing
  expect 0 "whole" -- "$forceshade" recording check made.fsr
done
expect 2 "nowhere/made.csv: cannot open for writing: No such file or directory" -- force --out lost.csv
expect 2 "round.csv: cannot open for writing: Too many levels of symbolic links" -- force --out round.csv
expect 2 '--out: expected a directory, got "folder", a symbolic link to "absent", which is not there' -- \
  "$forceshade" plot --law wall --out folder
same "folder loose.csv loose.fsr loose.json lost.csv round.csv" "$(find . -type l -printf '%f\n' | sort | paste -sd ' ')"

# NPY: 64 bytes' multiple of a header, then 25 bytes a row.
expect 0 "" -- force --out forces.npy
same "NUMPY" "$(head -c 6 forces.npy | tail -c 5)"
same 25 "$(($(stat -c %s forces.npy) % 64))"
expect 0 "" -- force --out exact.npy --digits binary32
cmp forces.npy exact.npy || exit 1
expect 0 "" -- force --out CAPITALS.NPY
cmp forces.npy CAPITALS.NPY || exit 1
expect 2 "--digits: expected a CSV file as --out beside it" -- force --out more.npy --digits 40
expect 0 "" -- "$forceshade" drive --law wall --certificate none --device null --seconds 0.01 --pace none --out run.npy
same "NUMPY" "$(head -c 6 run.npy | tail -c 5)"
expect 0 "" -- "$forceshade" drive --law wall --certificate none --device null --seconds 0.01 --pace none --out RUN.FSR
expect 0 "whole" -- "$forceshade" recording check RUN.FSR

# A folder of files appears whole, also where it is interrupted or the disk is full.
"$forceshade" plot --law all --out stopped > stopped.txt 2>&1 &
until ls -d stopped.partial-* > /dev/null 2>&1; do sleep 0.02; done
kill -INT $!; wait $!; same 130 $?
same "" "$(ls -d stopped stopped.partial-* 2> /dev/null)"
"$forceshade" plot --law all --out killed > killed.txt 2>&1 &
until [ -n "$(ls killed.partial-*/*.svg 2> /dev/null)" ]; do sleep 0.02; done
kill -KILL $!; wait $! 2> /dev/null
same "" "$(ls -d killed 2> /dev/null)"
same 1 "$(ls -d killed.partial-* | wc -l)"
# A folder is one command's until it ends, whether it was there or not; then it holds the files of that one alone.
for folder in twice twice-there; do
  [ $folder = twice ] || mkdir twice-there
  "$forceshade" plot force --law all --out $folder > first.txt 2>&1 &
  until [ -e $folder.partial-00000000 ] || [ -e $folder/.partial-00000000 ]; do sleep 0.02; done
  kill -STOP $!
  for command in "plot --law wall" "certify --law wall --points 1000 --cases 10" "man"; do
    expect 2 "--out: $folder: another run is writing this folder; give each run a folder of its own" -- "$forceshade" $command --out $folder
  done
  kill -CONT $!; wait $!; same 0 $?
  same 18 "$(ls -A $folder | grep -c -- '-force\.')"
  same 18 "$(ls -A $folder | wc -l)"
done
full() {  # KILOBYTES WORDS OPTION...: with files that are at most so long
  local most=$1 words=$2; shift 2
  expect 2 "$words" -- bash -c 'trap "" XFSZ; ulimit -f "$0"; exec "$@"' "$most" "$forceshade" "$@"
}
mkdir there; echo mine > there/mine
for folder in new there; do
  full 20 "$folder/certificate.html: cannot write: File too large" certify --law wall --points 1000 --cases 10 --out $folder
  full 2 "$folder/forceshade" man --out $folder
done
# A stack of 64 KB is enough.
(ulimit -s 64; expect 0 "" -- env -i PATH="$PATH" "$forceshade" certify --law wall --points 10 --cases 10 --threads 1 --out little) || exit 1
full 2 "forceshade: new.csv: disk I/O error" drive --law wall --certificate none --device null --seconds 0.05 --pace none --out new.csv
same "there/mine" "$(ls -d new* there/* there/.partial* 2> /dev/null)"
expect 2 "--out: expected a new file or a regular one" -- sh -c "mkdir -p there/certificate.json && exec '$forceshade' certify --law wall \
  --points 1000 --cases 10 --out there --overwrite"

# A long strip of narrow faces, and a jump along it: more moves than a tick has.
awk 'BEGIN { n = 400; print "OFF"; print 2 * n + 2, 2 * n, 0
  for (i = 0; i <= n; ++i) { print 0.25 * i, -8, 0; print 0.25 * i, 8, 0 }
  for (i = 0; i < n; ++i) { print 3, 2 * i, 2 * i + 2, 2 * i + 1; print 3, 2 * i + 1, 2 * i + 2, 2 * i + 3 } }' > strip.off
mesh="--mesh strip.off --unit mm --sides both --shading none"
printf '%s\n' x_mm,y_mm,z_mm 1,0.1,1 1,0.1,-0.7 99.1,0.3,-0.7 99.1,0.3,-0.7 99.1,0.3,-0.7 99.1,0.3,-0.7 > path.csv
for side in "" "--digits binary32"; do
  same "free contact unfinished unfinished unfinished contact" \
    "$("$forceshade" force path.csv $mesh $side | tail -n +2 | cut -d, -f7 | paste -sd ' ')"
done
awk -F, 'NR == 1 { print "t_s," $0; next } { printf "%.3f,%s\n", 0.001 * (NR - 2), $0 }' path.csv > hand.csv
expect 0 "unfinished ticks  " -- "$forceshade" drive $mesh --certificate none --device replay:hand.csv --pace none --out run.csv
expect 0 ",unfinished," -- cat run.csv
expect 0 "" -- "$forceshade" plot path.csv $mesh --out drawn
grep -q "3 of 6 ticks unfinished" drawn/strip-mesh.svg || { echo "FAILED: the picture does not count unfinished ticks"; exit 1; }
echo "$checks checks passed"
