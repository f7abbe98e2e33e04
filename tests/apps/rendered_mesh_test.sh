#!/usr/bin/env bash
# rendered_mesh_test.sh FORCESHADE: a mesh as its users check, certify, drive and record it.
. "$(dirname "$0")/expect.sh"
mesh="--mesh cube.off --unit mm"

expect 0 "" -- "$forceshade" mesh make cube --size 40 --out cube.off
expect 0 "" -- "$forceshade" mesh make wall --size 40 --cells 2 --out wall.off

# force: positions are a path. A jump through the cube ends on the near side, and the way back leaves it free.
printf 'x_mm,y_mm,z_mm\n0,0,30\n0,0,19\n0,0,-30\n5,0,-30\n0,0,30\n' > path.csv
path=$("$forceshade" force path.csv $mesh --stiffness 0.5 --shading none)
same "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status
0,0,30,0,0,0,free
0,0,19,0,0,0.5,contact
0,0,-30,0,0,25,contact
5,0,-30,0,0,25,contact
0,0,30,0,0,0,free" "$path"
same "$path" "$("$forceshade" force path.csv $mesh --stiffness 500N/m --shading none --digits binary32)"
# The unit changes nothing else: half the lengths in inches of 25.4 mm are not exact, so the file is one of 2^-3 m.
printf 'OFF\n4 4 0\n0 0 0\n0.125 0 0\n0 0.125 0\n0 0 0.125\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' > m.off
printf 'OFF\n4 4 0\n0 0 0\n125 0 0\n0 125 0\n0 0 125\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' > mm.off
printf 'x_mm,y_mm,z_mm\n-1,20,20\n1,20,20\n2,25,21\n-1,0,0\n' > corner.csv
same "$("$forceshade" force corner.csv --mesh m.off --unit m)" "$("$forceshade" force corner.csv --mesh mm.off --unit mm)"
# An open mesh blocks from both sides unless --sides says otherwise.
printf 'x_mm,y_mm,z_mm\n1,2,-3\n1,2,1\n' > below.csv
same "1,2,1,0,0,-0.5,contact" "$("$forceshade" force below.csv --mesh wall.off --unit mm | tail -n 1)"
same "1,2,1,0,0,0,free" "$("$forceshade" force below.csv --mesh wall.off --unit mm --sides front | tail -n 1)"
# Smooth everywhere, the vertex scheme tilts the force near an edge; with a crease at each right angle it does not.
printf 'x_mm,y_mm,z_mm\n15,3,30\n15,3,19\n' > beside.csv
tilted=$("$forceshade" force beside.csv $mesh | tail -n 1)
straight=$("$forceshade" force beside.csv $mesh --crease 45 | tail -n 1)
same "15,3,19,0,0,0.5,contact" "$straight"
[ "$tilted" != "$straight" ] || { echo "FAILED: --crease changes nothing"; exit 1; }

# Friction holds the god-object where it landed, and lets it slip to where the pull is a quarter of the pressure. A material of
# some faces has its own stiffness. Subject files have the same keys.
printf 'x_mm,y_mm,z_mm\n5,10,30\n5,10,19\n5.125,10,19\n7,10,19\n' > stroke.csv
rough=$("$forceshade" force stroke.csv $mesh --shading none --friction 0.5,0.25)
same "5.125,10,19,-0.0625,0,0.5,contact" "$(sed -n 4p <<< "$rough")"
case $(sed -n 5p <<< "$rough") in 7,10,19,-0.12*,0.5,contact) ;; *) echo "FAILED: slips otherwise: $rough"; exit 1 ;; esac
same "7,10,19,0,0,0.5,contact" "$("$forceshade" force stroke.csv $mesh --shading none --friction 0 | tail -n 1)"
same "$("$forceshade" force stroke.csv $mesh)" "$("$forceshade" force stroke.csv $mesh --contact friction)"
printf '[[material]]\nname = "hard"\nstiffness = "2N/mm"\nfaces = ["0-11"]\n' > hard.toml
printf 'mesh = "cube.off"\nunit = "mm"\nshading = "none"\nmaterials = "hard.toml"\n' > hard_cube.toml
same "7,10,19,0,0,2,contact" "$("$forceshade" force stroke.csv --subject hard_cube.toml | tail -n 1)"
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nusemtl rubber\ng tyre\nf 1 2 3\n' > named.obj
"$forceshade" mesh check named.obj --unit mm > named.txt
grep -q "^materials  *rubber (1 faces)$" named.txt && grep -q "^groups  *tyre (1 faces)$" named.txt || { cat named.txt; exit 1; }

# plot: the mesh alone, and a path on it.
expect 0 "drawn/cube-mesh.svg" -- "$forceshade" plot $mesh --out drawn
! grep -q "god-object" drawn/cube-mesh.svg || { echo "FAILED: a path is drawn where none is given"; exit 1; }
expect 2 "--out: expected" -- "$forceshade" plot path.csv $mesh --out drawn
expect 0 "drawn/cube-mesh.png" -- "$forceshade" plot path.csv $mesh --view=-40,0.5rad --out drawn --overwrite
grep -q "ticks: 2 free, 3 touching" drawn/cube-mesh.svg || { echo "FAILED: the picture does not say what came of the path"; exit 1; }
grep -q "azimuth -40°, elevation 28.6478" drawn/cube-mesh.svg || { echo "FAILED: the picture does not say from where it is seen"; exit 1; }
printf 'x_mm,y_mm,z_mm,Reset\n0,0,11,1\n0,0,9,0\n' > begun.csv
expect 0 "drawn/cube-mesh.png" -- "$forceshade" plot begun.csv $mesh --out drawn --overwrite
expect 2 "plot: expected one of force" -- "$forceshade" plot path.csv --law wall --out drawn

# Files that are missing, wrong, or no mesh.
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n3 0 1 2\n3 0 1 1\n' > flat.off
expect 2 "flat.off: cannot be rendered:
line 8: face 1 has vertex 1 twice
line 7: face 0 has no area: its vertices 0, 1 and 2 lie on a line
'forceshade mesh repair' mends some of this" -- "$forceshade" properties --mesh flat.off --unit mm
expect 2 "none.off" -- "$forceshade" certify --mesh none.off --unit mm --out none
[ ! -e none ] || { echo "FAILED: a folder is left behind"; exit 1; }

# properties, certify, drive, recording.
expect 0 "cube.off        states        held    50 cases" -- "$forceshade" properties $mesh --cases 50
# One triangle is certified in a third of the cube's time.
printf 'OFF\n3 1 0\n-20 -20 0\n20 -20 0\n0 20 0\n3 0 1 2\n' > one.off
one="--mesh one.off --unit mm" certificate="--certificate certificate/certificate.json"
expect 0 "certified: 250000 points" -- "$forceshade" certify $one --points 200000 --cases 2000 --out certificate
expect 1 "covers one.off with other parameters" -- "$forceshade" drive $one --stiffness 0.25 --device simulated --seconds 0.1 $certificate
# The ticks by the stage that decided them, of this stiffness and of others: not all in one.
for stage in binary64 wide; do
  same 2 "$(grep -A 3 '"points_by_stage"' certificate/certificate.json | grep -c "\"$stage\": [1-9]")"
done
for other in "$mesh" "$one --shading none" "$one --contact sub-goal"; do
  expect 1 "refused to drive" -- "$forceshade" drive $other --device simulated --seconds 0.1 $certificate
done
expect 0 "(time up)" -- "$forceshade" drive $one --device simulated --pace none --seconds 0.1 $certificate
awk 'BEGIN { print "t_s,x_mm,y_mm,z_mm"; for (i = 0; i < 1000; ++i) printf "0.%03d,%d.5,3,%d.%d\n", i, i / 50, 20 - int(i / 500), 9 - int(i / 100) }' > hand.csv
expect 0 "(time up)" -- "$forceshade" drive $mesh --device replay:hand.csv --pace none --seconds 1 --out run.fsr --certificate none
expect 0 " differ" -- "$forceshade" recording check run.fsr $mesh
same 1 "$(grep -c 'ticks, [1-9][0-9]* in contact, 0 differ' <<< "$printed")"
expect 2 "run.fsr: sides is front; expected both" -- "$forceshade" recording check run.fsr $mesh --sides both
expect 2 "expected wall" -- "$forceshade" recording check run.fsr --law wall

# Another contact rule is part of what is certified and recorded, and what is not turned by a shading unless that is given.
leading="$mesh --contact sub-goal"
same "$("$forceshade" force path.csv $leading --shading none)" "$("$forceshade" force path.csv $leading)"
same "$("$forceshade" force path.csv $leading)" "$("$forceshade" force path.csv $leading --digits binary32)"

# Faces that cross. A floor and a wall through it: the god-object stops before the wall and goes along it.
printf 'OFF\n8 4 0\n-20 -20 0\n20 -20 0\n20 20 0\n-20 20 0\n0 -19 -7\n0 19 -7\n0 19 9\n0 -19 9\n3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n' > plates.off
plates="--mesh plates.off --unit mm --sides front --shading none"
printf 'x_mm,y_mm,z_mm\n5,1,3\n5,1,-1\n-1,1,-1\n-1,3,-1\n5,3,-1\n' > groove.csv
for side in "" "--digits binary32"; do
  same "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status
5,1,3,0,0,0,free
5,1,-1,0.00,0.00,0.50,contact
-1,1,-1,0.50,0.00,0.50,contact
-1,3,-1,0.50,0.00,0.50,contact
5,3,-1,0.00,0.00,0.50,contact" "$("$forceshade" force groove.csv $plates --stiffness 0.5 $side |
    awk -F, -v OFS=, 'NR > 2 { for (i = 4; i < 7; ++i) $i = sprintf("%.2f", $i < 0 ? -$i : $i) } 1')"
done
expect 0 "held, not certified: 1250 points" -- "$forceshade" certify $plates --points 1000 --cases 20 --out crossing
grep -q '"triangles": "any set"' crossing/certificate.json || { echo "FAILED: the certificate does not say what it is of"; exit 1; }
awk 'BEGIN { print "t_s,x_mm,y_mm,z_mm"; for (i = 0; i < 1000; ++i) printf "0.%03d,%d.5,%d,%d\n", i, 5 - int(i / 100), i / 100, i == 0 ? 3 : -1 }' > across.csv
expect 0 "(time up)" -- "$forceshade" drive $plates --device replay:across.csv --pace none --seconds 1 --out crossing.fsr --certificate none
expect 0 " differ" -- "$forceshade" recording check crossing.fsr $plates
same 1 "$(grep -c 'ticks, [1-9][0-9]* in contact, 0 differ' <<< "$printed")"
expect 2 "crossing.fsr: " -- "$forceshade" recording check crossing.fsr $mesh
# A recording of an earlier version, by another rule.
python3 -c 'import sqlite3
file = sqlite3.connect("crossing.fsr")
file.execute("INSERT INTO metadata VALUES (?, ?)", ("self_intersections", "allowed"))
file.commit()'
expect 2 "crossing.fsr: was recorded with --self-intersecting, by another rule" -- "$forceshade" recording check crossing.fsr $plates

# A texture: on a wall the force is that of the force-shaded height map with the same slope, 0.75: (-3, 0, 4)/5.
printf 'render = "height-map-shaded"\n[[part]]\nshape = "plane"\nslope_x = 0.75\n' > ramp.toml
expect 0 "" -- "$forceshade" mesh make wall --size 40 --cells 3 --out wall.obj
textured="--mesh wall.obj --unit mm --shading texture:ramp.toml --texture-scale 1mm"
printf 'x_mm,y_mm,z_mm\n1,2,3\n1,2,-0.5\n' > above.csv
for side in "" "--digits binary32"; do
  same "1,2,-0.5,-0.15,0,0.2,contact" "$("$forceshade" force above.csv $textured --stiffness 0.5 $side | tail -n 1)"
done
expect 0 "wall.obj        states        held    20 cases" -- "$forceshade" properties $textured --cases 20
expect 2 "wall.off: has no texture coordinates" -- "$forceshade" force --mesh wall.off --unit mm --shading texture:ramp.toml \
  --texture-scale 1 above.csv
printf '[[surface]]\nshape = "plane"\nslope_x = 0.5\n' | cat ramp.toml - > deep.toml
expect 2 "deep.toml: has a surface to measure the depth from; expected none" -- "$forceshade" force above.csv --mesh wall.obj \
  --unit mm --shading texture:deep.toml --texture-scale 1

echo "$checks checks"
