#!/usr/bin/env bash
# conform_recording_test.sh FORCESHADE: recordings of other systems: a clean one, such with one fault each, and files that are none.
python_options=-SE
. "$(dirname "$0")/expect.sh"
clean=$examples/recordings/another_system.csv
columns=(--columns t=time_s,x=px,y=py,z=pz,fx=fx,fy=fy,fz=fz,m,mN)
judge() { "$forceshade" conform recording --law bump-2p "$1" "${columns[@]}" --fit --tolerance "${tolerance:-1e-5 N}" "${@:2}"; }
alone() { "$forceshade" conform recording "$1" "${columns[@]}" "${@:2}"; }

# The clean one: what is fitted is what it was made with, within the stated error.
judge "$clean" --json clean.json > clean.txt || { echo "FAILED: the clean recording: $(cat clean.json)"; exit 1; }
python3 - << 'END' || exit 1
import json, math
found = json.load(open("clean.json"))
fit = found["fit"]
assert found["held"] and fit["contacts"] == 889 and fit["left_out"] == 0, fit
assert abs(fit["stiffness_N_per_mm"] - 0.5) < fit["stiffness_error_N_per_mm"] < 2e-5, fit
assert fit["offset_N"] == [0, 0, 0] and max(fit["offset_error_N"]) < 1e-5 and fit["lag_s"] == 0 and fit["lag_error_s"] < 1e-6, fit
assert fit["rests"] == 311 and fit["noise_at_rest_N"] == 0, fit
assert fit["undetermined"] == ["a shift along y"], fit  # the bump is a cylinder along y
# The scene's z in the axes of the recording: turned by 35 degrees about (1, 2, 2)/3.
axis, angle = (1 / 3, 2 / 3, 2 / 3), math.radians(35)
c, s = math.cos(angle), math.sin(angle)
up = [axis[1] * s + (1 - c) * axis[2] * axis[0], -axis[0] * s + (1 - c) * axis[2] * axis[1], c + (1 - c) * axis[2] ** 2]
off = math.degrees(math.dist(up, fit["turn"][2]))
assert off < fit["turn_error_degrees"] < 0.01, (off, fit)
# The scene's origin lies at (40, -25, 110) mm.
height = sum(a * b for a, b in zip(fit["turn"][2], (40, -25, 110))) + fit["shift_mm"][2]
assert abs(height) < fit["shift_error_mm"] + 200 * math.radians(fit["turn_error_degrees"]), (height, fit)
assert found["difference_N"]["most"] < 1e-6, found["difference_N"]
END
expect 0 "not applicable: no attraction: without a subject" -- alone "$clean" --allow 0.01mJ
expect 0 '<testcase' -- judge "$clean" --junit -

# The page: with a fit and pictures, without a subject, and of a recording that has no fit; a folder that is not there is refused first.
expect 0 "held: 1200 of 1200" -- judge "$clean" --out page.html
for words in '<header class="held">' 'another_system.csv beside bump-2p</h1>' '<th scope="row">stiffness</th><td>0.5 +- ' 'id="course' \
  'The force over time' 'no attraction</th>' '1200 samples in 1.199 s, 1000 Hz'; do
  grep -qF -e "$words" page.html || { echo "FAILED: the page has no $words"; exit 1; }
done
expect 0 "held: time increases" -- alone "$clean" --allow 0.01mJ --out alone.html
grep -q 'time increases</th>' alone.html && ! grep -q '<svg' alone.html || { echo "FAILED: the page without a subject"; exit 1; }
expect 2 "--out: " -- judge "$clean" --out nowhere/page.html

# One fault each. fault NAME CODE: CODE changes `rows`, the numbers of the rows.
fault() {
  python3 - "$clean" "$2" > "$1.csv" << 'END' || exit 1
import math, random, sys
lines = open(sys.argv[1]).read().split()
rows = [[float(number) for number in line.split(",")] for line in lines[1:]]
random.seed(1)
free = [i for i in range(20, len(rows) - 20) if not any(rows[i][4:])]
touching = [i for i in range(20, len(rows) - 20) if math.hypot(*rows[i][4:]) > 300]
exec(sys.argv[2])
print(lines[0])
for row in rows:
    print(",".join(f"{number:.9g}" for number in row))
END
}
# finds NAME WORDS: the check that these words name fails, and of the invariants no other one but those of energy.
finds() {
  expect 1 "$2" -- judge "$1.csv"
  same "" "$(grep '^FAILED: .* cases$' <<< "$printed" | grep -vF -e "$2" -e "gives the hand energy" -e "the hand gets no energy")"
}
fault stale 'i = 300; rows[i][1:] = rows[i - 1][1:]'
finds stale "FAILED: no sample is repeated while the hand moves"
also "stale.csv:302: the position stays for 2 ms"
fault frozen 'for i in range(300, 315): rows[i][1:] = rows[299][1:]'
finds frozen "FAILED: no force is held longer than 10 ms without a new position"
fault gap 'for row in rows[300:]: row[0] += 0.05'
finds gap "FAILED: no force is held longer than 10 ms without a new position"
fault backwards 'rows[300][0] -= 0.004'
finds backwards "FAILED: time increases"
fault equal 'rows[300][0] = rows[299][0]'
finds equal "FAILED: time increases"
also "equal.csv:302: the time is that of the sample before; expected one after it"
fault sign 'for i in touching[:20]: rows[i][4:] = [-f for f in rows[i][4:]]'
finds sign "FAILED: no attraction"
fault nothing 'for i in free[:20]: rows[i][4:] = [0, 0, 50]'
finds nothing "FAILED: no force out of contact"
fault infinite 'rows[300][4] = math.inf'
finds infinite "FAILED: every force is finite"
fault noisy_rest 'i = touching[50]
for k in range(1, 5): rows[i + k][1:4] = rows[i][1:4]; rows[i + k][4:] = rows[i][4:]
rows[i + 3][4] += 20
rows[i + 4:] = [r for r in rows[i + 4:]]'
expect 1 "FAILED: a hand at rest feels a force at rest" -- judge noisy_rest.csv
fault energy 'for i in touching: rows[i][4:] = [f * (1.5 if sum(f * (b - a) for f, a, b in zip(rows[i][4:], rows[i - 1][1:], rows[i][1:4])) > 0 else 1) for f in rows[i][4:]]'
expect 1 "FAILED: no closed loop gives the hand energy" -- alone energy.csv
also "FAILED: all in all the hand gets no energy"
wall() { "$forceshade" conform recording --law wall "$@"; }
# A recording of 1000/N Hz that was copied up to 1000 Hz. copied N SAMPLES: of a hand that presses into a wall.
copied() {
  python3 -c 'import math, sys
hold = int(sys.argv[1])
print("t_ns,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N")
for i in range(3000):
    t = i // hold * hold / 1000
    z = 2 - 3.5 * math.sin(2 * math.pi * t * 0.8) ** 2 + float(sys.argv[2])
    print(f"{1690000000123456789 + 1000000 * i},{60 * math.sin(3 * t):.9g},{30 * math.cos(2 * t):.9g},{z:.9g},0,0,{max(0, -0.5 * z):.9g}")' "$@"
}
repeated="FAILED: no sample is repeated while the hand moves" held="FAILED: no force is held longer than 10 ms without a new position"
with_ns=(--columns t=t_ns,x=x_mm,y=y_mm,z=z_mm,fx=fx_N,fy=fy_N,fz=fz_N --tolerance "0.01 N")
copied 1 0 > whole.csv
expect 0 "1000 Hz" -- wall whole.csv "${with_ns[@]}"
also "jitter 0 ms"
for case in "10 100 $repeated" "17 58.82 $held"; do
  read -r hold rate words <<< "$case"
  copied "$hold" 0 > copied.csv
  expect 1 "$words" -- wall copied.csv "${with_ns[@]}"
  also "3000 samples in 2.999 s, 1000 Hz" "new positions: $rate Hz"
  same 1 "$(grep -c "^FAILED: no .* \(repeated\|held\)" <<< "$printed")"
done
copied 33 9 > free.csv
expect 1 "$repeated" -- wall free.csv "${with_ns[@]}"
# A sensor that nobody has zeroed, whose force comes 4 ms late, in axes that are turned: found; as they are given, and as they are not.
python3 -c 'import math
c, s = math.cos(0.35), math.sin(0.35)
turn = lambda v: (v[0], c * v[1] - s * v[2], s * v[1] + c * v[2])
at = lambda t: (20 * math.sin(3 * t), 15 * math.cos(2 * t), 2 - 3.5 * math.sin(2 * math.pi * t * 0.8) ** 2)
print("t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N")
for i in range(2000):
    f = turn((0, 0, max(0, -0.5 * at(i / 1000 - 0.004)[2])))
    print(",".join(f"{v:.9g}" for v in (i / 1000, *turn(at(i / 1000)), f[0] + 0.12, f[1] - 0.07, f[2] + 0.31)))' > sensor.csv
expect 0 "(100 %) within the tolerance, 1e-04 N" -- wall sensor.csv --fit --tolerance "1e-4 N" --allow 0.01N --json sensor.json
python3 -c 'import json
fit = json.load(open("sensor.json"))["fit"]
assert abs(fit["stiffness_N_per_mm"] - 0.5) < fit["stiffness_error_N_per_mm"] < 1e-3, fit
for found, error, true in zip(fit["offset_N"], fit["offset_error_N"], (0.12, -0.07, 0.31)): assert abs(found - true) < error < 1e-3, fit
assert abs(fit["lag_s"] - 0.004) < fit["lag_error_s"] < 1e-4, fit
assert 1100 < fit["rests"] < 1200 and fit["noise_at_rest_N"] < 1e-4, fit' || exit 1
expect 0 "held: no force out of contact" -- \
  "$forceshade" conform recording --law wall sensor.csv --fit --tolerance "1e-4 N" --allow 0.01N --offset 0.12,-0.07,0.31 --lag 4
also "lag of the force 4 +- 0 ms"
expect 1 "FAILED: there is no fit" -- wall sensor.csv --fit --tolerance "1e-4 N" --offset 2,2,2 --lag 4
expect 2 "--offset: expected three forces in N" -- wall sensor.csv --offset 0.12,-0.07
expect 2 "--offset: expected three forces in N" -- wall sensor.csv --offset 0.12,-0.07,inf
printf '%s\n' t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N 0,3,0,0.5,1,2,4 0.001,3,0,-0.5,1,2,4.25 0.002,3,0,-1,1,2,4.5 > constant.csv
expect 0 "wall: correctly rounded 3 of 3" -- wall constant.csv --offset 1,2,4
expect 1 "FAILED: 0 of 3" -- wall constant.csv
# Axes that are declared, and ones that are not these; a recording of this program, of a device that is replayed.
printf '%s\n' t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N 0,3,0.5,0,0,0,0 0.001,3,-0.5,0,0,0.25,0 0.002,3,-1,0,0,0.5,0 0.003,3,0.5,0,0,0,0 > turned.csv
expect 0 "wall: correctly rounded 4 of 4" -- wall turned.csv --frame x,z,-y
expect 1 "FAILED: 0 of 4" -- wall turned.csv --frame x,-z,y
sed -n '2,$s/,/   /gp' turned.csv > turned.traj
expect 0 "wall: correctly rounded 4 of 4" -- wall turned.traj --frame x,z,-y --columns t=1,x=2,y=3,z=4,fx=5,fy=6,fz=7,s,mm,N
expect 2 "turned.traj:1: no column 8" -- wall turned.traj --columns t=1,x=2,y=3,z=4,fx=5,fy=6,fz=8,s,mm,N

# No fit.
python3 -c 'print("t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N")
for i in range(50): print(f"{i / 1000},{i / 10},{i % 7},-1,0,0,0.5")' > level.csv
expect 1 "these samples determine neither of the stiffness and" -- wall level.csv --fit --tolerance "1 %"
head -3 level.csv > two.csv
expect 1 "expected 7 samples in contact at least, with a force of more than 0 N, got 2, the first one at two.csv:2" -- \
  wall two.csv --fit --tolerance "1 %"
python3 -c 'print("t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N")
for i in range(60): print(f"{i / 1000},{i % 11},{i % 7},{-i % 13},0,0,{-0.5 * (i % 13)}")' > pulls.csv
expect 1 "there is no fit" -- wall pulls.csv --fit --tolerance "1 %"

# Recordings that cannot be read.
expect 2 "pz_m: expected columns" -- \
  "$forceshade" conform recording "$clean" --columns t=time_s,x=px,y=py,z=pz_m,fx=fx,fy=fy,fz=fz,m,mN
expect 2 '--columns: has no fz' -- "$forceshade" conform recording "$clean" --columns t=time_s,x=px,y=py,z=pz,fx=fx,fy=fy
expect 2 '--columns: expected one of mm, cm, m, in, because the column px does not end in its unit' -- \
  "$forceshade" conform recording "$clean" "${columns[@]%,m,mN}"
expect 2 '--columns: the column x_mm ends in mm; expected this unit, got m' -- wall turned.csv --columns m
# Units that are not read, beside one that is; and units whose letters are not of the same size.
named() { "$forceshade" conform recording "$clean" "${columns[@]/${1%/*}/${1#*/}}"; }
for name in fz_gf 'Fz [kN]' fz_cN fx_lbs; do
  expect 2 "--columns: expected one of N, mN, because the column $name ends in" -- named "fz=fz/fz=$name"
done
for name in px_um 'x (µm)' x_inches X_MM; do
  expect 2 "--columns: expected one of mm, cm, m, in, because the column $name ends in" -- named "x=px/x=$name"
done
expect 2 'no column X_M: ' -- named x=px/x=X_M
expect 2 "--columns: t: expected SECONDS+NANOSECONDS, and t_ms is in ms" -- named t=time_s/t=t_ms+t_ns
expect 2 'no column t_sec: ' -- named t=time_s/t=t_sec+t_nsecs
expect 2 '--columns: the column t_msec ends in ms; expected this unit, got s' -- named t=time_s/t=t_msec,s
# Units in brackets, and times in two columns, as exports of sensors and of ROS have them.
sed '1s/.*/time (s),x [mm],y [mm],z [mm],Fx(N),Fy(N),Fz(N)/' level.csv > brackets.csv
named="t=time (s),x=x [mm],y=y [mm],z=z [mm],fx=Fx(N),fy=Fy(N),fz=Fz(N)"
same "$(wall level.csv | tail -n +2)" "$(wall brackets.csv --columns "$named" | tail -n +2)"
expect 2 '--columns: the column x [mm] ends in mm; expected this unit, got m' -- wall brackets.csv --columns "$named,m"
expect 2 '--columns: the column time (s) ends in s; expected this unit, got ms' -- wall brackets.csv --columns "$named,ms"
awk -F, 'NR == 1 { print "secs,nsecs,x,y,z,fx,fy,fz" } NR > 1 { ms = 980 + $1 * 1000; sub(/^[^,]*,/, "")
  printf "%d,%d,%s\n", 1700000000 + int(ms / 1000), ms % 1000 * 1000000, $0 }' level.csv > stamps.csv
stamps=,x=x,y=y,z=z,fx=fx,fy=fy,fz=fz,mm,N
same "$(wall level.csv | tail -n +2)" "$(wall stamps.csv --columns t=secs+nsecs$stamps | tail -n +2)"
expect 1 'FAILED: time increases' -- wall stamps.csv --columns t=nsecs$stamps,ns
expect 2 'each once; got "ns"' -- wall stamps.csv --columns t=secs+nsecs$stamps,ns
expect 2 'column 8 (fz): expected a whole number, got "0.5"' -- wall stamps.csv --columns t=secs+fz${stamps/fz=fz/fz=nsecs}
sed '2s/,980000000,/,1980000000,/' stamps.csv > later.csv
expect 2 'later.csv:2: column 2 (nsecs): expected less than a second in ns, got "1980000000"' -- wall later.csv --columns t=secs+nsecs$stamps
expect 2 '--columns: t: expected SECONDS+NANOSECONDS' -- wall stamps.csv --columns t=secs+$stamps
expect 2 '--columns: x and y are both px;' -- "$forceshade" conform recording "$clean" --columns t=time_s,x=px,y=px,z=pz,fx=fx,fy=fy,fz=fz,m,mN
expect 2 'and of force (N, mN), each once; got "kN"' -- wall turned.csv --columns mm,kN
expect 2 '--frame: expected three different ones' -- wall turned.csv --frame x,y,y
expect 2 "--fit: expected --law" -- alone "$clean" --fit --tolerance "1 %"
expect 2 "--tolerance: expected one in N or %" -- wall turned.csv --fit
expect 2 "expected two samples at least, got 1" -- wall <(head -2 turned.csv)
expect 2 "expected a header row with columns t_s, x_mm" -- wall /dev/null
sed '3s/-0.5/deep/' turned.csv > text.csv
expect 2 'text.csv:3: column 3 (y_mm): expected a number, got "deep"' -- wall text.csv
sed '3s/-0.5/nan/' turned.csv > nan.csv
expect 2 'nan.csv:3: column 3 (y_mm): expected a finite number, got "nan"' -- wall nan.csv
expect 2 'unknown option "--command"' -- wall turned.csv --command true
expect 2 "--allow: expected a number from 0 to 1000" -- wall turned.csv --allow=-1N
