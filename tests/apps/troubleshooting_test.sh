#!/usr/bin/env bash
# troubleshooting_test.sh FORCESHADE NO_DHD_DEVICE: each message of docs/troubleshooting.md is said, by the command with its section of the
# page behind it, or by another program; and apps/troubleshooting.cpp has no further ones.
no_dhd_device=$(realpath "$2")
python_options=-SE
. "$(dirname "$0")/expect.sh"
root=$(realpath "$here/../..")
mkdir said

# says CODE MESSAGE -- COMMAND...: runs it, and keeps the message and what was printed for the check below.
says() {
  local code=$1 message=$2; shift 3
  expect "$code" "" -- "$@"
  printf '%s' "$message" > said/$checks.message
  printf '%s\n' "$printed" > said/$checks.printed
}

printf 'x_mm,y_mm,z_mm\n1,a,3\n' > rows.csv
printf 'x,y\n1,2\n' > columns.csv
says 2 "expected --law, --height-map, --mesh or --scene, got none" -- "$forceshade" force rows.csv
says 2 "expected a stiffness such as ..." -- "$forceshade" force --law wall --stiffness 5kg
says 2 "expected a length such as ..." -- "$forceshade" force --law bump-2p --radius 5kg
says 2 "--stiffness is ...; expected ..." -- "$forceshade" force --law wall --stiffness 1e9
says 2 "--width is ...; expected ..." -- "$forceshade" force --law bump-2p --radius 1 --width 5
says 2 "no column ...: expected columns ..." -- "$forceshade" force columns.csv --law wall
says 2 "column ...: expected a number" -- "$forceshade" force rows.csv --law wall

corners='0 0 0\n9 0 0\n0 9 0'
printf "OFF\n4 2 0\n$corners\n9 9 0\n3 0 1 2\n3 1 2 3\n" > turned.off
printf "OFF\n6 2 0\n$corners\n3 3 -5\n3 3 5\n4 3 5\n3 0 1 2\n3 3 4 5\n" > meeting.off
printf "OFF\n3 1 0\n$corners\n3 0 1 2\n" > face.off
says 1 "faces ... run along their edge, ..., in the same direction" -- "$forceshade" mesh check turned.off --unit mm
says 1 "meet, but have no vertex in common" -- "$forceshade" mesh check meeting.off --unit mm
says 2 "face ... would lose its area" -- "$forceshade" mesh repair meeting.off --unit mm --join 20mm --out joined.off
says 2 "has no texture coordinates at some or all corners" -- \
  "$forceshade" force rows.csv --mesh face.off --unit mm --shading texture:map.toml --texture-scale 1
part='render = "height-map"\n[[part]]\nshape ='
printf "$part \"con\"\n" > con.toml
printf "$part \"cone\"\n" > cone.toml
printf "$part \"gaussian\"\ncenter_x_mm = 3\nsigma_mm = 5\nheight_mm = 1\n" > centre.toml
printf "$part \"grid\"\nfile = \"colours.png\"\npitch_mm = 1\nscale_mm = 1\n" > picture.toml
cp "$root/docs/forces.png" colours.png
says 2 "line ...: shape: expected one of ..." -- "$forceshade" force rows.csv --height-map con.toml
says 2 "line ...: key ... is missing" -- "$forceshade" force rows.csv --height-map cone.toml
says 2 "line ...: unknown key ..." -- "$forceshade" force rows.csv --height-map centre.toml
says 2 "expected a TOML file, got a PNG picture" -- "$forceshade" force rows.csv --height-map colours.png
says 2 "is not 8 or 16 bit greyscale" -- "$forceshade" force rows.csv --height-map picture.toml

drive() { "$forceshade" drive "$@"; }
says 1 "refused to drive: no certificate was given" -- drive --law wall --device null
says 0 "held, not certified" -- "$forceshade" certify --law wall --points 200 --cases 20 --out few
says 1 "the certificate has ... points ...; driving needs at least ..." -- drive --law wall --device null --certificate few/certificate.json
says 1 "the certificate does not cover ..." -- drive --law bump-1p --device null --certificate few/certificate.json
says 1 "the certificate covers ... with other parameters" -- \
  drive --law wall --stiffness 1 --device null --certificate few/certificate.json
sed 's/"renderer": "library"/"renderer": "program"/' few/certificate.json > own.json
sed -e 's/"schema": 8/"schema": 7/' -e '/"renderer": "library"/d' few/certificate.json > earlier.json
says 1 "the certificate is of a program's own renderer" -- drive --law wall --device null --certificate own.json
says 1 "the certificate does not say whose renderer was compared" -- drive --law wall --device null --certificate earlier.json
sed -e '0,/"held": true/s//"held": false/' -e '0,/"held": true/s//"held": false/' -e '0,/"mismatches": 0/s//"mismatches": 1/' \
  -e '0,/"counterexamples": \[\]/s//"counterexamples": ["at 0"]/' -e 's/"standing": ".*"/"standing": "failed"/' \
  -e 's/"lacks": ".*"/"lacks": ""/' few/certificate.json > failed.json
says 1 "the certificate says that ... failed" -- drive --law wall --device null --certificate failed.json
sed 's/\("library_digest": "\)......../\1deadbeef/' few/certificate.json > other.json
says 1 "the certificate is for another build of the renderer" -- drive --law wall --device null --certificate other.json
says 2 "expected a forceshade certificate" -- drive --law wall --device null --certificate few/evidence.json

on() { local device=$1; shift; env "$@" "$forceshade" drive --law wall --certificate none --device "$device"; }
says 2 "no window can be opened" -- on mouse -u DISPLAY -u WAYLAND_DISPLAY
says 3 "the PHANToM's driver library ... could not be loaded" -- on phantom FORCESHADE_HD_LIBRARY=/no/libHD.so
says 3 "Force Dimension's library (DHD) could not be loaded" -- on dhd FORCESHADE_DHD_LIBRARY=/no/libdhd.so
says 3 "no Inverse Service answers at ..." -- on haply FORCESHADE_HAPLY_SERVICE=localhost:1
says 3 "no device of Force Dimension is connected" -- on dhd FORCESHADE_DHD_LIBRARY="$no_dhd_device"
says 3 "check cable, power and the udev rule" -- \
  env FORCESHADE_DHD_LIBRARY="$no_dhd_device" "$forceshade" device check dhd --seconds 0.1
says 3 "device fault: the program ended ..." -- on command:true
says 3 "device fault: the program did not answer within ..." -- on 'command:sleep 20'
says 2 "expected none, because the device has no buttons" -- drive --law wall --certificate none --device null --dead-man 1
says 0 "cannot be passive, so a hand may be made to swing" -- \
  drive --law wall --stiffness 50 --certificate none --device simulated --pace none --seconds 0.1
printf 't_s,x_mm,y_mm,z_mm\n0,0,0,5\n0.1,0,0,5\n0.2,300,0,5\n0.3,-300,0,5\n' > fast.csv
says 3 "the supervisor stopped the run: ..." -- \
  drive --law wall --certificate none --pace none --device simulated:premium-1.5:fast.csv
# The loop is late for a time that it does not have: until it ends, it is held up again and again.
late() {
  "$forceshade" drive --law wall --certificate none --device simulated --seconds 60 --watchdog-timeout 0.02 &
  local process=$!
  while kill -STOP $process; do sleep 0.1; kill -CONT $process; sleep 0.1; done 2> /dev/null
  wait $process
}
says 3 "the supervisor stopped the run: watchdog: tick ... began ... after it was due" -- late

conform() { "$forceshade" conform --law wall --points 10 --command "$1"; }
says 1 "the renderer's hello has no key ..." -- conform 'read asked; echo {}'
says 1 "the renderer ended ... without an answer" -- conform 'read asked; exit 3'
says 1 "the renderer did not answer within ..." -- conform 'sleep 60'
cp "$root/examples/samples/stroke.fsr" damaged.fsr
python3 -c "open('damaged.fsr', 'r+b').truncate(8192)"
says 2 "database disk image is malformed" -- "$forceshade" recording check damaged.fsr

cat > checked.py << 'END'
import glob, re, sys

def expect(truth, words):
    if not truth:
        sys.exit("FAILED: " + words)

root = sys.argv[1]
others = {  # said by a shell, a loader, Python and its package, a script, and a column of a table
    "forceshade: command not found", "error while loading shared libraries: libforceshade.so.0", "No module named 'forceshade'",
    "No module named 'numpy'", "... 'forceshade._forceshade'", "RoundingWarning: a number that binary32 does not hold was rounded ...",
    "scripts/setup: expected to be root or to have sudo", "invalid"}
page, section = {}, ""
for line in open(root + "/docs/troubleshooting.md"):
    if line.startswith("## "):
        section = re.sub("[^a-z0-9-]", "", line[3:].strip().lower().replace(" ", "-"))
    elif line.startswith("| `") or line.startswith("| status `"):
        page.update((words, section) for words in re.findall("`(.*?)`", line.split(" | ")[0]))
table = open(root + "/apps/troubleshooting.cpp").read()
code = {words: section for section, words in re.findall(r'^    \{"(.*?)", "(.*)"\},$', table, re.M)}
expect(others <= set(page), "on the page: " + str(others - set(page)))
page = {words: section for words, section in page.items() if words not in others}
expect(page == code, f"the page and apps/troubleshooting.cpp: {set(page.items()) ^ set(code.items())}")
runs = {open(file).read(): open(file.replace(".message", ".printed")).read() for file in glob.glob("said/*.message")}
expect(set(runs) == set(code), f"a run for each message: {set(runs) ^ set(code)}")
for message, printed in runs.items():
    words = ".*".join(re.escape(part) for part in message.split("..."))
    place = f" (docs/troubleshooting.md#{code[message]})\n"
    expect(re.search(words + "(.|\n)*" + re.escape(place), printed), f'"{message}" before{place}in: {printed}')
    expect(not re.search("troubleshooting.*troubleshooting", printed), f"one place in a line of: {printed}")
print(len(runs), "messages end in their section")
END
python3 checked.py "$root" || exit 1
