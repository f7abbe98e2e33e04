#!/usr/bin/env bash
# messages_test.sh FORCESHADE: what is said to somebody who typed something else than what was meant.
. "$(dirname "$0")/expect.sh"

same "forceshade: expected a command: laws" "$("$forceshade" 2>&1 | cut -d, -f1 | head -1)"
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

# A name that means another format than what is written.
for ending in npy csv fsr html png; do
  expect 2 "--json: expected a name that ends in .json, which is the format of the file that is written, got \"x.$ending\"" -- \
    "$forceshade" laws --json x.$ending
  for command in properties certify; do
    expect 2 "--junit: expected a name that ends in .xml, which is the format of the file that is written, got \"x.$ending\"" -- \
      "$forceshade" $command --law wall --junit x.$ending
  done
done
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

# A radius that does not fit the width that nobody chose.
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
