#!/usr/bin/env bash
# messages_test.sh FORCESHADE: what is said to somebody who typed something else than what was meant.
. "$(dirname "$0")/expect.sh"

# An option before the command, and the words that other programs understand.
expect 2 'expected a command before the option "--law", one of: laws' -- "$forceshade" --law wall force
expect 2 'unknown command "forse"' -- "$forceshade" forse
same "forceshade: expected a command: laws" "$("$forceshade" 2>&1 | cut -d, -f1 | head -1)"
expect 2 "forceshade: mesh: expected a command: check" -- "$forceshade" mesh
expect 2 'the nearest is force' -- "$forceshade" forse
expect 2 'got "chek"; the nearest is check' -- "$forceshade" mesh chek a.off --unit mm
for flag in --help -h; do expect 2 'got "chek"; the nearest is check' -- "$forceshade" mesh chek $flag; done
expect 2 'got "chek"; the nearest is check' -- "$forceshade" help mesh chek
expect 2 "forceshade: mesh check: expected --unit, got none" -- "$forceshade" mesh check -
expect 2 'forceshade: mesh check: unknown option "--unti"; the nearest is --unit' -- "$forceshade" mesh check - --unti mm
expect 2 'unknown device "simulatd"' -- "$forceshade" drive --law wall --certificate none --device simulatd
expect 2 'the nearest is simulated' -- "$forceshade" drive --law wall --certificate none --device simulatd
for version in --version -v version; do expect 0 "library digest" -- "$forceshade" $version; done
for help in --help -h help; do expect 0 "Usage: forceshade COMMAND" -- "$forceshade" $help; done
same "$("$forceshade" force --help)" "$("$forceshade" help force)"
same "$("$forceshade" device check --help)" "$("$forceshade" help device check)"

# The help says what units are in one place, is at most 100 columns wide, and puts options under what they are for.
for command in "" laws force energy plot properties certify "certify merge" drive \
  recording "recording check" "recording export" device "device check" \
  "device try" mesh "mesh check" "mesh repair" "mesh make" man completion; do
  same "" "$("$forceshade" help $command | grep -nE '^.{101,}$')"
  same "$([ -z "$command" ] && echo 1 || echo 0)" "$("$forceshade" help $command | grep -c '1000mil')"
  expect 0 ".SH EXAMPLES" -- "$forceshade" man $command
  case "$command" in "" | recording | device | mesh) ;; *)
    expect 0 "  forceshade $command" -- "$forceshade" help $command ;;
  esac
done
for command in make check; do expect 0 "forceshade mesh $command" -- sh -c "'$forceshade' man mesh | man -l - | cat"; done
for command in certify drive device; do expect 0 "forceshade $command" -- sh -c "'$forceshade' man | man -l - | cat"; done
for title in "Subject:" "Placement:" "Evidence:" "Device and loop:" "Output:"; do
  expect 0 "$title" -- "$forceshade" help drive
done

# The word that was meant.
printf 'render = "height-map"\n[[part]]\nshape = "con"\n' > map.toml
expect 2 "got 'con'; the nearest is cone" -- "$forceshade" force --height-map map.toml
echo 'lwa = "wall"' > lwa.toml
echo 'heightmap = "map.toml"' > heightmap.toml
echo 'law = "bump_2p"' > law.toml
expect 2 'unknown key lwa; expected keys of a subject; the nearest is law' -- "$forceshade" properties --subject lwa.toml
expect 2 'unknown key heightmap; expected keys of a subject; the nearest is height-map' -- \
  "$forceshade" force --subject heightmap.toml
for command in force properties certify drive; do
  expect 2 'law.toml: line 1: law: expected' -- "$forceshade" $command --subject law.toml
  expect 2 'got "bump_2p"; the nearest is bump-2p' -- "$forceshade" $command --subject law.toml
done
printf 'render = "height-map"\n[[part]]\nshape = "gaussian"\ncenter_x_mm = 3\nsigma_mm = 5\nheight_mm = 1\n' > map.toml
expect 2 'map.toml: line 4: unknown key center_x_mm; the nearest is x_mm' -- "$forceshade" force --height-map map.toml
printf 'render = "height-map"\n[[parts]]\nshape = "plane"\n' > map.toml
expect 2 'expected render, [[part]] and [[surface]], got parts; the nearest is part' -- "$forceshade" force --height-map map.toml

# A name that means another format than what is written.
for ending in npy csv fsr html png; do
  expect 2 "--json: expected a name that ends in .json, which is the format of the file that is written, got \"x.$ending\"" -- \
    "$forceshade" laws --json x.$ending
  for command in properties certify; do
    expect 2 "--junit: expected a name that ends in .xml, which is the format of the file that is written, got \"x.$ending\"" -- \
      "$forceshade" $command --law wall --junit x.$ending
  done
done
expect 2 'ends in .csv or .npy, which is the format of the file that is written, got "x.JSON"' -- \
  "$forceshade" force --law wall --out x.JSON
expect 0 "" -- "$forceshade" laws --json x.txt
same "" "$(find . -name 'x.*' ! -name x.txt)"

# Drive names what is missing: every law, and for a mesh a command that can be pasted, with its options and folder.
expect 0 "the certificate has 2000 points for wall; driving needs at least 1000000; and the certificate has 2000 points for bump-2p;" \
  -- "$forceshade" certify --law wall,bump-2p --points 2000 --cases 20 --out few
expect 0 "to gather it: forceshade certify --law wall,bump-2p --radius 15.24 --width 25.4 --stiffness 0.5 --points 1000000" -- \
  "$forceshade" certify --law wall,bump-2p --points 2000 --cases 20 --out few --overwrite
mkdir "my meshes"
"$forceshade" mesh make cube --out "my meshes/it's.off"
output=$("$forceshade" certify --mesh "my meshes/it's.off" --unit mm --sides both --shading vertex --crease 20 --points 200 --cases 20 --out few-mesh)
command=$(sed -n 's/^to gather it: //p' <<< "$output")
same "forceshade certify --mesh 'my meshes/it'\\''s.off' --unit mm --sides both --shading vertex --crease 20deg --stiffness 0.5N/mm --points 200000 --cases 2000 --out DIR" \
  "$command"
mkdir bin
ln -s "$forceshade" bin/forceshade
expect 0 "" -- env PATH="$PWD/bin:$PATH" sh -c "${command/200000 --cases 2000/200 --cases 20}"
same "$(grep -m1 '"digest": "' few-mesh/certificate.json)" "$(grep -m1 '"digest": "' DIR/certificate.json)"

# Ended by Ctrl-C: one line that says so.
{ echo OFF; echo "30001 30000 0"; echo 0 0 0
  awk 'BEGIN { for (i = 0; i < 30000; i++) printf "%.9g %.9g %.9g\n", 50 * cos(i * 2e-4), 50 * sin(i * 2e-4), i % 2; for (i = 1; i < 30000; i++) print 3, 0, i, i + 1; print 3, 0, 30000, 1 }'
} > fan.off
for command in "mesh check fan.off --unit mm" "force --mesh fan.off --unit mm"; do
  # A shell ignores SIGINT in what it starts in the background.
  env --default-signal=INT "$forceshade" $command > stopped.txt 2>&1 < /dev/null &
  stopped INT; same 130 $?
  same 1 "$(wc -l < stopped.txt)"
  expect 0 "fan.off" -- grep "^forceshade: interrupted: [a-hj-z]" stopped.txt
done

# Also while it waits for standard input.
printf 'x_mm,y_mm,z_mm,fx_N,fy_N,fz_N\n0,0,-1,0,0,0.5\n' > rows.csv
mkfifo waiting
for command in "force --law wall" "conform judge - --law wall" "mesh check - --unit mm"; do
  exec 9<> waiting
  cat rows.csv >&9
  env --default-signal=INT "$forceshade" $command > stopped.txt 2>&1 < waiting &
  stopped INT; same 130 $?
  expect 0 "forceshade: interrupted" -- grep "^forceshade: interrupted" stopped.txt
  exec 9>&-
done

# A file of another kind.
expect 2 "leather.png: expected a TOML file, got a PNG picture" -- "$forceshade" force --height-map "$examples/leather.png"
expect 2 "leather.png: expected a CSV file, got a PNG picture" -- "$forceshade" force "$examples/leather.png" --law wall
expect 2 "leather.png: expected a TOML file, got a PNG picture" -- "$forceshade" force --subject "$examples/leather.png"
printf '{"law": "wall"}\n' > object.json
printf '[{"law": "wall"},\n {"law": "wall"}]\n' > list.json
printf 'x_mm,y_mm,z_mm\n1,0,-1\n' > positions.csv
printf 'law = "wall"\n' > wall.toml
: > empty.txt
for file in object.json list.json; do
  for command in "force --height-map" "force --subject"; do
    expect 2 "$file: expected a TOML file, got a JSON file" -- "$forceshade" $command $file
  done
done
expect 2 "positions.csv: expected a TOML file, got a CSV file" -- "$forceshade" force --height-map positions.csv
printf 'version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12345\n' > lfs.csv
expect 2 "lfs.csv: expected a CSV file, got a pointer of Git LFS" -- "$forceshade" force lfs.csv --law wall
expect 2 "object.json: expected a CSV file, got a JSON file" -- "$forceshade" force object.json --law wall
for command in "recording check" "recording export"; do
  for file in "positions.csv a CSV file" "object.json a JSON file" "wall.toml a TOML file" "empty.txt an empty file" \
    "$examples/leather.png a PNG picture"; do
    expect 2 "${file%% *}: expected a recording (.fsr), got ${file#* }" -- "$forceshade" $command "${file%% *}"
  done
done
expect 2 "expected JSON, got a CSV file" -- "$forceshade" drive --law wall --certificate positions.csv --device null

# TOML that cannot be read: in our words, with what stands there.
toml() { printf "$2\n" > broken.toml; expect 2 "broken.toml: line $1: expected $3" -- "$forceshade" force --height-map broken.toml; }
toml 2 'render = "height-map"\n[[part]' "the name of a table in brackets, alone on its line, such as [[part]] (expected ']', got the end of the line)"
toml 1 'render = height-map' "a text in quotes, a number, true, false, a list or a table (could not determine value type)"
toml 1 'render = ' "KEY = VALUE on a line (expected value, got the end of the line)"
toml 1 'render "height-map"' "KEY = VALUE on a line (expected '=', got '\"')"
toml 1 'render = "height-map' "a text in quotes, which ends on its line ("
toml 1 'render = ["a", "b"' "a list in brackets, with commas between its elements (got the end of the file)"
toml 2 'render = "height-map"\nrender = "height-map"' "each key and table once (cannot redefine existing string 'render')"
toml 1 'render = \xff' "UTF-8 ("

head -c 100 /dev/zero > zeros.bin
expect 2 "zeros.bin: expected a CSV file, got a binary file" -- "$forceshade" force zeros.bin --law wall
printf '{\n "a": [1,2,}' > broken.json
expect 2 'line 2, column 12: expected JSON, got "}"' -- "$forceshade" drive --law wall --certificate broken.json --device null
printf '{"a"' > broken.json
expect 2 'line 1, column 5: expected JSON, got the end of the text' -- \
  "$forceshade" drive --law wall --certificate broken.json --device null
printf '{"a": 1e999}' > broken.json
expect 2 "expected numbers that binary64 can hold" -- "$forceshade" drive --law wall --certificate broken.json --device null

# CSV as some programs of other countries write it.
printf 'x_mm;y_mm;z_mm\n1,5;0;-1\n' > semicolons.csv
expect 2 "semicolons.csv:1: expected commas between the columns, and points in decimals, got semicolons" -- \
  "$forceshade" force semicolons.csv --law wall
tr ';' '\t' < semicolons.csv > tabs.csv
expect 2 "tabs.csv:1: expected commas between the columns, and points in decimals, got tabs" -- \
  "$forceshade" force tabs.csv --law wall
tr ';' ',' < semicolons.csv | sed 's/^1,5,0,-1/1,5,0,0,-1,0/' > commas.csv
expect 2 "a decimal is written with a point, not a comma" -- "$forceshade" force commas.csv --law wall
printf 'x_mm,y_mm,z_mm\n"1,5",0,-1\n' > quoted.csv
expect 2 'quoted.csv:2: column 1 (x_mm): expected a number with a decimal point, got "1,5"' -- \
  "$forceshade" force quoted.csv --law wall

# A radius that does not fit the width that nobody chose.
expect 2 "the width is that of the thesis unless --width is given beside --radius" -- \
  "$forceshade" force --law bump-2p --radius 5mm
for command in laws "force --law bump-2p"; do
  output=$("$forceshade" $command --radius 5mm --width 11mm 2>&1 < /dev/null)
  case "$output" in *"--width is 11 mm"*) ;; *) echo "FAILED: $command: $output"; exit 1 ;; esac
  case "$output" in *thesis*) echo "FAILED: $command: $output"; exit 1 ;; esac
done

# A mesh from standard input, of every format, and one that is none.
"$forceshade" mesh make icosphere --cells 2 --out ball.off
"$forceshade" mesh make icosphere --cells 2 --out ball.obj
printf 'solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid one\n' > one.stl
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' > one.ply
# Behind what its reader passes over.
printf '# a ball\n\n' | cat - ball.off > remark.off
{ printf '\n  OFF%s\n' "$(sed -n 2p ball.off)"; sed 1,2d ball.off; } > word.off
{ printf '\xef\xbb\xbf \r\n'; sed 's/solid/SOLID/' one.stl; } > blank.stl
for file in ball.off ball.obj one.stl one.ply remark.off word.off blank.stl; do
  of_file=$("$forceshade" mesh check $file --unit mm) || { echo "$file cannot be read"; exit 1; }
  same "$of_file" "$("$forceshade" mesh check - --unit mm < $file)"
  same "$of_file" "$(cat $file | "$forceshade" mesh check - --unit mm)"
done
same "forceshade: standard input: line 1: expected a coordinate, got the end of the line" \
  "$(echo 'v 1 2' | "$forceshade" mesh check - --unit mm 2>&1)"
expect 2 "standard input: is empty; expected at least one face" -- "$forceshade" mesh check - --unit mm
same "forceshade: standard input: cannot read: Is a directory" "$("$forceshade" mesh check - --unit mm < . 2>&1)"
# From a pipe that is not ready yet and that another program made non-blocking.
printf 'import os, subprocess, sys\nr, w = os.pipe()\nos.set_blocking(r, False)\nwork = subprocess.Popen(sys.argv[2:], stdin=r)\ntry:\n  work.wait(0.3)\nexcept subprocess.TimeoutExpired:\n  os.write(w, open(sys.argv[1], "rb").read())\nos.close(w)\nsys.exit(work.wait())\n' > slow.py
same "$("$forceshade" mesh check one.ply --unit mm)" "$(python3 slow.py one.ply "$forceshade" mesh check - --unit mm 2>&1)"

# A folder for temporary files that is not there.
for command in "mesh check - --unit mm" "drive --law wall --certificate none --device null --seconds 0.1 --out -"; do
  expect 2 "forceshade: TMPDIR: expected a folder that can be written to, for temporary files: No such file or directory" -- \
    env TMPDIR=nowhere "$forceshade" $command
done

# A fault of a face names its line; a binary file has none.
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n' > flat.obj
for file in flat.obj -; do
  name=$([ $file = - ] && echo "standard input" || echo $file)
  same "$name: line 5: face 0 has no area: its vertices 0, 1 and 2 lie on a line" \
    "$("$forceshade" mesh check $file --unit mm < flat.obj | grep "line 5:")"
  same "$name: lines 5 and 6: faces 0 and 1 run along their edge, of vertices 0 and 1, in the same direction: one of them is turned over (docs/troubleshooting.md#shapes)" \
    "$("$forceshade" mesh check $file --unit mm < flat.obj | grep "lines 5 and 6:")"
done
printf 'OFF\n# a quadrilateral whose second half has no area\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 2 0\n4 0 1 2 3\n' > fan.off
same "fan.off: line 8: face 1 has no area: its vertices 0, 2 and 3 lie on a line" \
  "$("$forceshade" mesh check fan.off --unit mm | grep line)"
printf 'OFF\n4 1 0\n0 0 0\n4 0 0\n2 3 0\n3 1 0\n4 0 1 2 3\n' > folded.off
same "folded.off: line 7: faces 0 and 1 are folded onto each other at their edge, of vertices 0 and 2" \
  "$("$forceshade" mesh check folded.off --unit mm | grep line)"
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n' > flat.ply
same "flat.ply: line 13: face 0 has no area: its vertices 0, 1 and 2 lie on a line" \
  "$("$forceshade" mesh check flat.ply --unit mm | grep line)"
printf 'solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid one\n' > flat.stl
same "flat.stl: line 2: face 0 has no area: its vertices 0, 1 and 2 lie on a line" \
  "$("$forceshade" mesh check flat.stl --unit mm | grep line)"
expect 2 "flat.ply: cannot be rendered:
line 13: face 0 has no area" -- "$forceshade" properties --mesh flat.ply --unit mm

echo "$checks checks"
