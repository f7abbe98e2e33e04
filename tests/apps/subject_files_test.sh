#!/usr/bin/env bash
# subject_files_test.sh FORCESHADE: --subject FILE means what its keys mean as options, everywhere; several laws at once; what a
# certificate quotes.
python_options=-SE
. "$(dirname "$0")/expect.sh"

printf 'x_mm,y_mm,z_mm\n1,0,-0.5\n3,0.5,-1\n-40,2,0.25\n' > positions.csv
"$forceshade" mesh make icosphere --cells 1 --radius 20mm --out ball.off
mkdir inputs && cp ball.off inputs/ && cp "$examples/groove.toml" inputs/
printf 'render = "height-map"\n[[part]]\nshape = "plane"\nslope_x = 0.25\n' > inputs/ramp.toml  # of all kinds the fastest to certify
printf 'law = "bump-2p"\nradius = "1000mil"\nwidth = 30\nstiffness = "250N/m"\n' > inputs/law.toml
printf 'height-map = "groove.toml"\nstiffness = 0.25\n' > inputs/map.toml
printf 'mesh = "ball.off"\nunit = "mm"\nsides = "both"\nshading = "edge"\ncontact = "sub-goal"\ncrease = "40deg"\nself-intersecting = true\nstiffness = 0.25\n' \
  > inputs/mesh.toml
law="--law bump-2p --radius 1000mil --width 30 --stiffness 250N/m"
map="--height-map inputs/groove.toml --stiffness 0.25"
mesh="--mesh inputs/ball.off --unit mm --sides both --shading edge --contact sub-goal --crease 40deg --stiffness 0.25"

for kind in law map mesh; do
  options=${!kind} file=inputs/$kind.toml
  same "$("$forceshade" force positions.csv $options 2>&1)" "$("$forceshade" force positions.csv --subject $file 2>&1)"
  same "$("$forceshade" properties $options --cases 20 2>&1)" "$("$forceshade" properties --subject=$file --cases 20 2>&1)"
  what=force; [ $kind != mesh ] || what=geometry
  "$forceshade" plot $what $options --out plots-$kind > /dev/null &&
    "$forceshade" plot $what --subject $file --out plots-of-$kind > /dev/null
  same "$(cd plots-$kind && sha256sum ./*)" "$(cd plots-of-$kind && sha256sum ./*)"
  # A certificate quotes what it is of; saved beside the file, the text means the same again.
  "$forceshade" certify $options --points 100 --cases 20 --out certificate-$kind > /dev/null
  python3 -c 'import json, sys; sys.stdout.write(json.load(open(sys.argv[1]))["subjects"][0]["subject_file"])' \
    certificate-$kind/certificate.json > inputs/quoted-$kind.toml
  "$forceshade" certify --subject inputs/quoted-$kind.toml --points 100 --cases 20 --out again-$kind > /dev/null
  python3 -c 'import json, sys
a, b = (json.load(open(f))["subjects"][0] for f in sys.argv[1:3])
sys.exit(any(a.get(key) != b.get(key) for key in ("name", "parameters", "digest", "subject_file")))' \
    certificate-$kind/certificate.json again-$kind/certificate.json ||
    { echo "FAILED: the quoted file of $kind means something else"; exit 1; }
  expect 0 "UNCERTIFIED" -- "$forceshade" drive --subject $file --device replay:<(printf 't_s,x_mm,y_mm,z_mm\n0,0,0,-1\n0.001,0,0,-1\n') \
    --certificate none --pace none
done
grep -q 'law = &quot;bump-2p&quot;' certificate-law/certificate.html || { echo "FAILED: the page does not quote"; exit 1; }

# Several laws at once, each once; of one where a command can have one only.
same "$("$forceshade" properties --law wall --cases 20; "$forceshade" properties --law bump-2p --cases 20 | tail -n +2)" \
  "$("$forceshade" properties --law wall,bump-2p --cases 20)"
printf 'law = ["wall", "bump-2p"]\n' > two.toml
same "$("$forceshade" properties --law wall,bump-2p --cases 20)" "$("$forceshade" properties --subject two.toml --cases 20)"

# Damping: drive has it, and its recording; other commands leave it out and say so.
printf 'law = "wall"\nstiffness = 1\n\n[damping]\ndamping = 0.002\nmost = 3\ndrag = "1Ns/m"\nfull_at = 0.5\ntime = "2ms"\n' > oil.toml
grep -v '^most\|^drag\|^full' oil.toml > thin.toml
expect 0 "oil.toml: its damping is left out here" -- "$forceshade" force positions.csv --subject oil.toml
same "$("$forceshade" force positions.csv --law wall --stiffness 1)" "$("$forceshade" force positions.csv --subject oil.toml 2> /dev/null)"
drive() { "$forceshade" drive --certificate none --device simulated --seconds 2 --pace none "$@"; }
expect 0 "0.002 N s/mm along the force, up to 3 times it; drag of 0.001 N s/mm, full at 0.5 N; share 0.3333333 at 1000 Hz" -- \
  drive --subject oil.toml --out oil.fsr --json oil.json
grep -q '"sampling_mJ"' oil.json || { echo "FAILED: the summary has no account of damping"; exit 1; }
check() { "$forceshade" recording check "$@" --json checked.json --overwrite; }
expect 0 ", 0 differ" -- check oil.fsr --law wall --stiffness 1
also "commands: 2000 ticks" "by its sampling, exactly"
# The account of the run in binary64 is the exact one, and the damping gives less than it can at most.
python3 -c 'import json
of = json.load(open("oil.json"))["damping"]
its = json.load(open("checked.json"))["computed_again"]["damping"]
assert all(abs(of[key] - its[key]) < 1e-9 for key in its) and its["damper_mJ"] < 0
assert its["damper_mJ"] + its["sampling_mJ"] <= its["most_given_mJ"]' || { echo "FAILED: other energies"; exit 1; }
expect 0 ", 0 differ" -- check oil.fsr --subject oil.toml
expect 0 ", 0 differ" -- check oil.fsr --law wall --stiffness 1 --damping 0.002,3 --drag 1Ns/m,0.5N --damping-filter 2ms
expect 2 "--drag: expected one number or two, got \"1,2,3\"" -- check oil.fsr --law wall --drag 1,2,3
expect 2 "--drag is 17 N·s/mm; expected 0, or 9.536743e-07 to 16 N·s/mm" -- check oil.fsr --law wall --drag 17
expect 2 "oil.fsr: damping_drag_N_s_per_mm is 0.001; expected 0" -- check oil.fsr --subject thin.toml
expect 0 "share 0.5 at 500 Hz" -- drive --law wall --rate 500 --damping 2Ns/m --damping-filter 2ms --out half.fsr
expect 0 ", 0 differ" -- check half.fsr --law wall --damping 0.002 --damping-filter 2ms
expect 2 "half.fsr: damping_share is 0.5; expected 1" -- check half.fsr --law wall --damping 0.002
drive --law wall --out dry.fsr > /dev/null
expect 2 "dry.fsr: the run had no damping; expected that of the subject" -- check dry.fsr --law wall --damping 0.002
same 45 "$(python3 -c 'import sqlite3, sys
for file in sys.argv[1:]: print(sqlite3.connect(file).execute("PRAGMA user_version").fetchone()[0], end="")' dry.fsr oil.fsr)"
# A force that was not damped as its recording says is found.
python3 - << 'end'
import ast, hashlib, sqlite3, struct
file = sqlite3.connect("oil.fsr")
meta = dict(file.execute("SELECT key, value FROM metadata"))
meta["damping_N_s_per_mm"] = "0.003"
seal = meta.pop("metadata_sha256")
words = b"".join(b"%d:%s," % (len(w), w) for pair in sorted(meta.items()) for w in (s.encode() for s in pair))
meta["metadata_sha256"] = hashlib.sha256(words).hexdigest()
file.executemany("UPDATE metadata SET value = ? WHERE key = ?", [(value, key) for key, value in meta.items()])
file.commit()
end
expect 1 "N, expected" -- check oil.fsr --law wall --stiffness 1
expect 0 "damping: takes energy at its own velocity; held from tick to tick it gives at most 0.0006667 N s/mm" -- \
  "$forceshade" energy --law wall --depth 1 --damping 0.002 --damping-filter 0.5
# A scene has it, too, and one in which something moves.
printf '[damping]\ndrag = 0.001\n[[object]]\nname = "ball"\nmesh = "ball.off"\nunit = "mm"\n' > scene.toml
expect 0 "drag of 0.001 N s/mm" -- drive --scene scene.toml
expect 0 "scene.toml: its damping is left out here" -- "$forceshade" force positions.csv --scene scene.toml
printf 'time_s,x_mm,y_mm,z_mm\n0,0,0,-25\n1,0,0,-18\n' > rising.csv
printf 'motion = "rising.csv"\n' >> scene.toml
expect 0 "drag of 0.001 N s/mm" -- drive --scene scene.toml --rate 1000 --out moving.fsr
expect 0 ", 0 differ" -- check moving.fsr --scene scene.toml
echo "$checks checks"
