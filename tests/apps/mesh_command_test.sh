#!/usr/bin/env bash
# mesh_command_test.sh FORCESHADE: forceshade mesh as its users call it: outputs, exit codes, messages, and what is left behind.
. "$(dirname "$0")/expect.sh"
mesh() { "$forceshade" mesh "$@"; }

# make, then check and info of every shape.
for shape in icosphere cube wall torus bump cylinder-bump; do
  cells="--cells 8"; [ $shape != cube ] || cells=""
  expect 0 "" -- mesh make $shape $cells --out $shape.off
  expect 0 "held: a mesh of " -- mesh check $shape.off --unit mm
  expect 0 "faces  " -- mesh check $shape.off --unit mm
  expect 0 "" -- mesh make $shape $cells --out $shape.obj
  expect 0 "texture          in the file" -- mesh check $shape.obj --unit mm
done
expect 0 "held: a mesh of 1280 faces" -- mesh check icosphere.off --unit mm
expect 0 "the fronts are outside" -- mesh check torus.off --unit mm
expect 0 "box              -500, -500, -500 to 500, 500, 500 mm" -- mesh check cube.off --unit cm
expect 0 "box              -1270, -1270, -1270 to 1270, 1270, 1270 mm" -- mesh check cube.off --unit in
expect 2 "a coordinate within 10000 mm, got -50 m; a small mesh" -- mesh check cube.off --unit m
expect 0 "" -- mesh make height-map --height-map "$examples/gaussian.toml" --size 20 --cells 8 --out map.off
expect 0 "box              -10, -10, " -- mesh check map.off --unit mm
also " to 10, 10, 3 mm"
expect 2 "--height-map: expected a height map" -- mesh make height-map --out map2.off
expect 2 "is there already" -- mesh make cube --out cube.off
expect 0 "" -- mesh make cube --size 1in --out cube.off --overwrite
expect 0 "box              -12.7, -12.7, -12.7 to 12.7, 12.7, 12.7 mm" -- mesh check cube.off --unit mm
expect 2 "expected one of icosphere, cube," -- mesh make sphere --out sphere.off
expect 2 "mesh make bump: expected a width of at most twice the radius" -- mesh make bump --width 40 --out wide.off
expect 2 "mesh make icosphere: expected at most 2^28 triangles" -- mesh make icosphere --cells 16384 --out large.off
expect 2 '--radius: expected a radius across below that around, 5 mm, got "6mm"' -- mesh make torus --radius 5,6mm --out ring.off
expect 2 '--out: expected a name that ends in .off or .obj, which is the format of the file that is written, got "cube.stl"' -- \
  mesh make cube --out cube.stl
expect 0 "" -- mesh make wall --out WALL.OBJ
expect 2 "--cells: has no effect on the shape cube; expected --size" -- mesh make cube --cells 3 --out ring.off
expect 2 "--radius: has no effect on the shape wall; expected --size --cells" -- mesh make wall --radius 3 --out ring.off
expect 2 "--height-map: has no effect on the shape torus" -- mesh make torus --height-map "$examples/gaussian.toml" --out ring.off
expect 0 "texture          in the file" -- mesh check WALL.OBJ --unit mm
same "" "$(ls | grep -E 'ring|stl|wide|large|sphere.off.p')"
mesh make cube --out - > standard.off
expect 0 "held" -- mesh check standard.off --unit mm

# The unit has to be given.
expect 2 "--unit" -- mesh check cube.off
expect 2 "expected one of mm, cm, m, in; got \"ft\"" -- mesh check cube.off --unit ft

# Files that are no mesh: 1, with the faces; in JSON, too.
printf 'OFF\n4 2 0\n0 0 0\n4 0 0\n2 3 0\n2 1 0\n3 0 1 2\n3 1 0 3\n' > folded.off
expect 1 "faces 0 and 1 are folded onto each other at their edge, of vertices 0 and 1" -- mesh check folded.off --unit mm
printf 'OFF\n6 2 0\n0 0 0\n4 0 0\n2 3 0\n2 1 -1\n2 1 1\n6 1 0\n3 0 1 2\n3 3 4 5\n' > crossing.off
expect 1 "faces 0 and 1 meet, but have no vertex in common" -- mesh check crossing.off --unit mm
expect 1 '"held": false' -- mesh check folded.off --unit mm --json
expect 0 '"held": true' -- mesh check cube.off --unit mm --json
also '"rim_edges": 0'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n' > flat.off
expect 1 "face 0 has no area" -- mesh check flat.off --unit mm
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' > square.off
expect 0 "1 faces with more than 3 corners are split into triangles" -- mesh check square.off --unit mm

# A vertex at which a tick may take long.
fan() { awk -v n="$1" 'BEGIN { print "OFF\n" n + 1 " " n " 0\n0 0 0"
  for (i = 0; i < n; ++i) print 50 * cos(2 * 3.14159265 * i / n), 50 * sin(2 * 3.14159265 * i / n), 0.05 * (7919 * i % 100)
  for (i = 0; i < n; ++i) print 3, 0, 1 + i, 1 + (i + 1) % n }' > fan.off; }
fan 1001
expect 0 "vertex 0 has 1001 faces: each move of a tick from there looks at all of them, which can take longer than 0.1 ms" -- \
  mesh check fan.off --unit mm
also "held: a mesh of 1001 faces"
expect 0 '"vertex 0 has 1001 faces' -- mesh check fan.off --unit mm --json
fan 1000
same "" "$(mesh check fan.off --unit mm | grep 'each move of a tick')"
# The worst tick of this mesh: few looks, or more than a tick may begin a move after.
expect 0 "the longest tick that a search found looks at " -- mesh check cube.off --unit mm
also "none was unfinished for that reason"
expect 0 '"unfinished": false' -- mesh check fan.off --unit mm --json
awk 'BEGIN { print "OFF\n2700 900 0"
  for (i = 0; i < 900; ++i) { x = int(i / 30) / 16; y = i % 30 / 16
    print x - 500, y - 500, -500; print x - 499.984375, y - 500, -500; print x + 500, y + 500.015625, 500 }
  for (i = 0; i < 900; ++i) print 3, 3 * i, 3 * i + 1, 3 * i + 2 }' > needles.off
expect 0 "some were unfinished for that reason" -- mesh check needles.off --unit mm
expect 0 '"unfinished": true' -- mesh check needles.off --unit mm --json

mkdir folder.off
# Files that cannot be read: 2, with file and line or byte; no byte of a file reaches a terminal as a command.
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n2 \033[2J 0\n3 0 1 2\n' > escape.off
expect 2 'escape.off: line 5: expected a coordinate, got "\x1b[2J"' -- mesh check escape.off --unit mm
printf 'v 0 0\0 0\n' > zero.obj
expect 2 'zero.obj: line 1: expected a coordinate, got "0\x00"' -- mesh check zero.obj --unit mm
expect 2 "missing.off: is not there" -- mesh check missing.off --unit mm
expect 2 "folder.off: is no regular file" -- mesh check folder.off --unit mm
expect 2 "expected a name that ends in .obj, .off, .ply or .stl" -- mesh check "$examples/leather.png" --unit mm

# repair: what was done, then whether it is a mesh.
printf 'OFF\n8 6 0\n0 0 0\n4 0 0\n2 3 0\n2 -3 0\n4 0 0\n9 9 9\n1 0 0\n0 1e-20 0\n3 0 1 2\n3 7 4 3\n3 0 1 1\n3 0 6 4\n3 2 1 0\n3 7 3 1\n' > broken.off
expect 1 "face 2 has vertex 1 twice" -- mesh check broken.off --unit mm
expect 0 "joined 2 vertices to another with the same coordinates" -- mesh repair broken.off --unit mm --out repaired.off
also "dropped 1 faces with a vertex twice: 2" "dropped 1 faces without area: 3" "turned 1 faces over: 1"
also "dropped 2 faces with the vertices of a face before them: 4, 5"
expect 0 "nothing to repair" -- mesh repair repaired.off --unit mm --out again.off
same "$(cat repaired.off)" "$(cat again.off)"
expect 0 '"held": true' -- mesh repair broken.off --unit mm --out repaired.off --overwrite --json
expect 2 "is there already" -- mesh repair broken.off --unit mm --out repaired.off
# A repaired mesh is an OFF file: it does not replace a file of another format.
for name in mine.stl mine.PLY mine.obj; do
  echo kept > $name
  expect 2 "--out: expected a name that ends in .off" -- mesh repair broken.off --unit mm --out $name --overwrite
  same kept "$(cat $name)"
done
expect 1 "FAILED: " -- mesh repair folded.off --unit mm --out folded2.off
# Any set of triangles: what it is, and its force. The hand that has crossed the second face's plane is held in the valley of both.
expect 1 "pairs of faces that cross 1: faces 0 and 1 near (3, 1, 0) mm" -- mesh check crossing.off --unit mm
also "FAILED: no regular mesh" "a gap is a gap" "borders          6 edges with one face" "the longest tick that a search found looks at"
expect 1 '"pairs of faces that cross": {' -- mesh check crossing.off --unit mm --json
printf 'x_mm,y_mm,z_mm\n2.5,0.5,1\n2.5,0.5,-0.2\n2.5,1.5,-0.2\n' > valley.csv
for digits in "" "--digits binary32"; do
  expect 0 "2.5,1.5,-0.2,0,-0.25,0.1,contact" -- "$forceshade" force valley.csv --mesh crossing.off --unit mm --shading none $digits
done
expect 2 '--shading: expected vertex or none for a mesh that is not regular, got "edge"' -- \
  "$forceshade" force valley.csv --mesh crossing.off --unit mm --shading edge
expect 2 '--contact: expected direct or friction for a mesh that is not regular' -- \
  "$forceshade" force valley.csv --mesh crossing.off --unit mm --contact sub-goal
expect 2 "face 0 has no area" -- "$forceshade" force valley.csv --mesh flat.off --unit mm
# Objects of a scene that touch: the hand goes over their seam and feels nothing of it, and the wedge between two is no way in.
mesh make cube --size 20mm --out twenty.off
printf '[[object]]\nname = "left"\nmesh = "twenty.off"\nunit = "mm"\ntranslation = [-10, 0, 0]\n\n[[object]]\nname = "right"\n' > touching.toml
printf 'mesh = "twenty.off"\nunit = "mm"\ntranslation = [10, 5, 0]\n' >> touching.toml
printf 'x_mm,y_mm,z_mm\n-5,0,12\n-5,0,8\n5,0,8\n' > seam.csv
same "0,0,1,contact" "$("$forceshade" force seam.csv --scene touching.toml --shading none | tail -2 | cut -d, -f4- | uniq)"
expect 1 "pairs of faces that coincide" -- mesh check touching.toml
# Cracks, and what closes them.
printf 'OFF\n8 4 0\n0 0 0\n10 0 0\n10 10 0\n0 10 0\n10.01 0 0\n20 0 0\n20 10 0\n10.01 10 0\n3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n' > plates.off
expect 0 "borders          8 edges with one face, 79.97" -- mesh check plates.off --unit mm
expect 0 "3 pairs of faces have such edges nearer to each other than 0.02 mm without touching, and a hand can pass: faces 0 and 2, 0.0100" -- \
  mesh check plates.off --unit mm --cracks 0.02mm
expect 0 "0 pairs of faces have such edges nearer to each other than 0.01 mm" -- mesh check plates.off --unit mm --cracks 0.01mm
expect 0 '"nearer_than_mm"' -- mesh check plates.off --unit mm --cracks 0.02mm --json
expect 0 "moved 2 vertices of borders onto another within 0.02 mm: 4 onto 1 by 0.0100" -- \
  mesh repair plates.off --unit mm --out joined.off --join 0.02mm
expect 0 "faces            4 in 1 part" -- mesh check joined.off --unit mm
same "$(sed -n '3,6p' plates.off)" "$(sed -n '3,6p' joined.off)"
expect 0 '"onto": 1' -- mesh repair plates.off --unit mm --out joined.off --overwrite --join 0.02mm --json
expect 0 "nothing to repair" -- mesh repair plates.off --unit in --out inches.off --join 0.02mm
expect 2 "--join: face 0 would lose its area" -- mesh repair plates.off --unit mm --out none.off --join 10mm
expect 2 "--join: expected a length of 2^-30 to 10000 mm" -- mesh repair plates.off --unit mm --out none.off --join 0
expect 2 "--join" -- mesh repair plates.off --unit mm --out none.off --join 3kg
expect 2 "--unit" -- mesh repair plates.off --out none.off --join 0.02mm
same "" "$(ls | grep none)"
# Normals in a file are not rendered: it is said, and a certificate is the same.
printf 'NOFF\n4 4 0\n0 0 0 1 0 0\n9 0 0 0 1 0\n0 9 0 0 0 1\n0 0 9 1 1 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' > with.off
sed -e '1s/N//' -e 's/^\([0-9]\) \([0-9]\) \([0-9]\) [01] [01] [01]$/\1 \2 \3/' with.off > without.off
expect 0 "the normals in the file are not rendered" -- "$forceshade" mesh check with.off --unit mm
same "" "$("$forceshade" mesh check without.off --unit mm | grep "normals in")"
for file in with without; do "$forceshade" certify --mesh $file.off --unit mm --points 100 --cases 20 --out $file > /dev/null; done
same "$(grep '"digest"' with/certificate.json)" "$(grep '"digest"' without/certificate.json)"

echo "$checks checks passed"
