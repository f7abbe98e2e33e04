#!/usr/bin/env bash
# scene_command_test.sh FORCESHADE: a scene of fixed objects as its users check, certify, drive, record and compare it.
. "$(dirname "$0")/expect.sh"
cp -r "$examples/scenes" scenes
table="--scene scenes/table.toml"

# Its contents, before it is rendered.
expect 0 "held: a scene of 42 faces" -- "$forceshade" mesh check scenes/table.toml
also "objects          board (2 faces), box (12 faces), knob (28 faces)"
also "groups           knob/side (16 faces), knob/top (6 faces), knob/bottom (6 faces)" "box              -64, -64, 0 to 64, 64, 20.1 mm"
expect 0 '"board": 2' -- "$forceshade" mesh check scenes/table.toml --json
expect 0 "object knob: 2 faces with more than 3 corners" -- bash -c "'$forceshade' mesh check scenes/table.toml | sed s/10/2/"
expect 0 "groups           side (16 faces), top (6 faces), bottom (6 faces)" -- "$forceshade" mesh check scenes/knob.obj --unit mm
expect 0 '"side": 16' -- "$forceshade" mesh check scenes/knob.obj --unit mm --json
expect 2 "--unit: expected none beside a scene" -- "$forceshade" mesh check scenes/table.toml --unit mm
expect 2 "--unit" -- "$forceshade" mesh check scenes/knob.obj
expect 2 "expected a mesh to repair, got a scene" -- "$forceshade" mesh repair scenes/table.toml --out repaired.off
[ ! -e repaired.off ] || { echo "FAILED: a file is left behind"; exit 1; }

# One unmoved object is its mesh.
printf 'x_mm,y_mm,z_mm\n0,0,20\n0,0,14\n1,0,14\n3,2,14\n12,2,14\n12,2,20\n' > path.csv
printf '[[object]]\nname = "a"\nmesh = "scenes/knob.obj"\nunit = "mm"\nmaterials = "scenes/knob.toml"\n' > one.toml
knob="--mesh scenes/knob.obj --unit mm --materials scenes/knob.toml"
same "$("$forceshade" force path.csv $knob)" "$("$forceshade" force path.csv --scene one.toml)"
same "$("$forceshade" force path.csv $knob --shading edge --digits binary32)" \
  "$("$forceshade" force path.csv --scene one.toml --shading edge)"

# The box is turned by the angle of 3:4:5, so that the point 10 mm along its x is at (-20 + 6, 8). It is smooth and of 0.8 N/mm.
# The board sticks and then slips.
printf 'x_mm,y_mm,z_mm\n-11,12,10\n-16,5.3333333,10\n' > side.csv
side=$("$forceshade" force side.csv $table | tail -n 1)
case $side in -16,5.3333335,10,1.[56]*,2.133*,0,contact) ;; *) echo "FAILED: the side of the box: $side"; exit 1 ;; esac
printf 'x_mm,y_mm,z_mm\n0,-20,5\n0,-20,-1\n0.25,-20,-1\n' > stroke.csv
same "0.25,-20,-1,-0.125,0,0.5,contact" "$("$forceshade" force stroke.csv $table | tail -n 1)"

# Every command takes it, named or in a subject file.
printf 'scene = "scenes/table.toml"\nstiffness = 0.25\n' > subject.toml
same "$("$forceshade" force stroke.csv $table --stiffness 0.25)" "$("$forceshade" force stroke.csv --subject subject.toml)"
expect 0 "table.toml      states        held    50 cases" -- "$forceshade" properties $table --cases 50
expect 0 "drawn/table-mesh.svg" -- "$forceshade" plot stroke.csv $table --view 30,25 --out drawn
expect 0 "" -- "$forceshade" conform positions $table --points 60 --out points.csv
expect 0 "" -- "$forceshade" force points.csv $table --out given.csv
expect 0 "held: " -- "$forceshade" conform judge $table given.csv
expect 1 "correctly rounded" -- "$forceshade" conform judge $table --stiffness 0.3 given.csv
expect 0 "held, not certified: 1250 points" -- "$forceshade" certify $table --points 1000 --cases 50 --out certificate
certificate="--certificate certificate/certificate.json --device simulated --pace none"
expect 0 "UNCERTIFIED" -- "$forceshade" drive $table --certificate none --device simulated --pace none --seconds 0.2 --out run.fsr
sed 's/^shading.*/shading = "vertex"/' scenes/table.toml > scenes/shaded.toml
expect 1 "covers another mesh" -- "$forceshade" drive --scene scenes/shaded.toml $certificate --seconds 0.1
expect 1 "covers table.toml with other parameters: expected" -- "$forceshade" drive $table --stiffness 0.25 $certificate --seconds 0.1
expect 0 "" -- "$forceshade" recording check run.fsr
expect 0 "" -- "$forceshade" recording check run.fsr $table
sed 's/\[0.4, 0.3\]/[0.4, 0.2]/' scenes/table.toml > scenes/other.toml
expect 2 "run.fsr: digest is " -- "$forceshade" recording check run.fsr --scene scenes/other.toml
# A certificate quotes the scene, beside which its text means the same.
python3 -c 'import json, sys; sys.stdout.write(json.load(open(sys.argv[1]))["subjects"][0]["subject_file"])' \
  certificate/certificate.json > scenes/quoted.toml
same 'scene = "table.toml"
stiffness = "0.5N/mm"' "$(cat scenes/quoted.toml)"
expect 1 "the certificate has 1000 points for table.toml; driving needs at least" -- \
  "$forceshade" drive --subject scenes/quoted.toml $certificate --seconds 0.1
# A renderer of another program gets the ground as a mesh.
expect 1 "a wall in Python 1 does not render table.toml" -- "$forceshade" conform $table --points 300 \
  --command "python3 $examples/renderers/wall.py"
if python3 -c "import numpy" 2> /dev/null; then
  sed '/^friction/d; /^stiffness/d; /^materials/d' scenes/table.toml > scenes/smooth.toml
  expect 1 "held: a flat plate feels flat however it is triangulated" -- "$forceshade" conform --scene scenes/smooth.toml --points 300 \
    --command "python3 $examples/renderers/god_object_epsilon.py"
fi

# Faults of a scene.
expect 2 "scenes/table.toml: line 2: shading: expected once, got several times" -- "$forceshade" force $table --shading edge
expect 2 "--friction" -- "$forceshade" force $table --friction 0.3
printf 'sides = "both"\nscene = "scenes/table.toml"\n\nfriction = 0.3\n' > wrong.toml
expect 2 "wrong.toml: line 4: friction" -- "$forceshade" force --subject wrong.toml

# Objects that move: both sides, every command, and the same force for the same tick of the path.
moving="--scene scenes/moving.toml"
printf 'x_mm,y_mm,z_mm\n-20,-15,25\n-20,-15,20\n-20,-15,20\n-20,-15,20\n' > hold.csv
forces=$("$forceshade" force hold.csv $moving)
same "-20,-15,20,0,0.015749812,0.25,contact" "$(tail -n 1 <<< "$forces")"
same "$forces" "$("$forceshade" force hold.csv $moving --digits binary32)"
expect 0 "moving.toml     work of motion held    50 cases" -- "$forceshade" properties $moving --cases 50
expect 0 "moving/moving-mesh.svg" -- "$forceshade" plot $moving --out moving
expect 2 "alone, whose objects move, got" -- "$forceshade" plot hold.csv $moving --out other
expect 0 "held, not certified: 1250 points" -- "$forceshade" certify $moving --points 1000 --cases 50 --out moved
expect 0 "" -- "$forceshade" drive $moving --certificate none --device simulated --pace none --seconds 2.5 --out moved.fsr
expect 0 "" -- "$forceshade" recording check moved.fsr
expect 0 "computed again: 2500 ticks" -- "$forceshade" recording check moved.fsr $moving
cp -r scenes otherwise && sed -i s/^2,-20,15/2,-20,14/ otherwise/box_sliding.csv
expect 2 "moved.fsr: digest is " -- "$forceshade" recording check moved.fsr --scene otherwise/moving.toml
expect 2 "expected 1000 Hz, for which the motions of moving.toml are made, got 500" -- "$forceshade" drive $moving --certificate none \
  --rate 500 --device simulated --seconds 0.1
expect 2 "expected no object with a motion, since the window of a mouse shows a surface that stays" -- \
  "$forceshade" drive $moving --certificate none \
  --device mouse
expect 0 '"kind": "scene"' -- bash -c "'$forceshade' conform positions $moving --points 30 --out vectors.json && cat vectors.json"
sed -i s/^2,/0,/ otherwise/box_sliding.csv
expect 2 "box_sliding.csv:3: column 1 (time_s): expected a time after that of the row before" -- \
  "$forceshade" force hold.csv --scene otherwise/moving.toml
# One that is certified in a moment: a law that moves.
printf '[[object]]\nname = "wall"\nlaw = "wall"\nmotion = "box_sliding.csv"\n' > scenes/alone.toml
expect 0 "certified: 250000 points" -- "$forceshade" certify --scene scenes/alone.toml --points 200000 --cases 2000 --out alone
certificate="--certificate alone/certificate.json --device simulated --pace none --seconds 0.1"
expect 0 "(time up)" -- "$forceshade" drive --scene scenes/alone.toml $certificate
sed s/box_sliding/knob_turning/ scenes/alone.toml > scenes/turning.toml
expect 1 "refused to drive" -- "$forceshade" drive --scene scenes/turning.toml $certificate
expect 1 "refused to drive" -- "$forceshade" drive $moving $certificate
expect 2 "expected an object without a motion, whose mesh can be looked at, got none" -- "$forceshade" mesh check scenes/alone.toml
expect 2 "expected meshes alone in the picture of a scene, got the object wall" -- "$forceshade" plot --scene scenes/alone.toml --out other
echo "$checks checks"
