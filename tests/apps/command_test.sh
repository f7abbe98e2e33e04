#!/usr/bin/env bash
# The forceshade command as its users call it: outputs, exit codes, messages, and what is left behind when things go wrong.
stand_in_hd=$(realpath "$2")
. "$(dirname "$0")/expect.sh"

# Help, version, wrong usage.
expect 0 "Usage: forceshade" -- "$forceshade" --help
expect 0 "forceshade " -- "$forceshade" --version
for command in laws geometry polygons force energy plot figures properties certify drive recording device mesh experiment analyze; do expect 0 "$command" -- "$forceshade" $command --help; done
expect 2 "forceshade: expected a command: laws, geometry, polygons, force, energy, plot, figures, properties, certify, drive, recording, device, mesh, experiment, analyze" -- "$forceshade"
expect 2 'laws: unknown option "--wrong"' -- "$forceshade" laws --wrong
expect 2 "expected one of: laws geometry polygons force energy plot figures properties certify drive recording device mesh experiment analyze" -- "$forceshade" nonsense
for word in revision compiler "instruction set" "library digest"; do expect 0 "$word " -- "$forceshade" --version; done
expect 2 'got "bump-9p"' -- "$forceshade" properties --law bump-9p

# laws
expect 0 "bump-3p-shaded" -- "$forceshade" laws

# geometry: the rational bump, units, digits, errors.
same '{"d_mm":"1.0000000000","h_mm":"0.25000000000","w_prime_mm":"0.53214818646","h_prime_mm":"0.22135358390","theta_rad":"0.42900073920"}' \
  "$("$forceshade" geometry --radius 1.25 --width 1.5 --digits 11 --json)"
same "$("$forceshade" geometry --radius 15.24 --width 25.4)" "$("$forceshade" geometry --radius 600mil --width 1in)"
same "$("$forceshade" geometry --radius 15.24 --width 25.4)" "$("$forceshade" geometry)"
expect 0 "theta  0.42900073920 rad" -- "$forceshade" geometry --radius 1.25 --width 1.5 --digits 11
expect 2 "width is 31 mm; expected 0.001 to 30.48 mm" -- "$forceshade" geometry --radius 15.24 --width 31
expect 2 'got "wide"' -- "$forceshade" geometry --radius wide --width 1
expect 2 "--digits" -- "$forceshade" geometry --radius 1 --width 1 --digits 0

# force: columns in any order, both paths, statuses.
printf 'z_mm,note,x_mm,y_mm\n-1,a,3,0\n5,b,0,0\n-1,c,nan,0\n' > in.csv
same "$(printf 'x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n3,0,-1,0.6,0,0.8,contact\n0,0,5,0,0,0,free\nnan,0,-1,0,0,0,invalid')" \
  "$("$forceshade" force --law bump-1p-shaded --radius 5 --width 8 --stiffness 1 --input in.csv)"
same "$(printf 'x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n3,0,-1,0.6000000,0,0.8000000,contact\n0,0,5,0,0,0,free\nnan,0,-1,0,0,0,invalid')" \
  "$("$forceshade" force --law bump-1p-shaded --radius 5 --width 8 --stiffness 1 --path reference --digits 7 < in.csv)"
expect 0 "" -- "$forceshade" force --law wall --stiffness 1 --input in.csv --out out.csv
same 4 "$(wc -l < out.csv)"
same "$("$forceshade" force --law bump-2p --radius 600mil --width 1in --stiffness 500N/m --input in.csv)" \
  "$("$forceshade" force --law bump-2p --input in.csv)"
expect 2 "stiffness is 0 N/mm; expected" -- "$forceshade" force --law wall --stiffness 0 --input in.csv
# A malformed row: file, line, column; exit 2; no output file, whole or partial.
printf 'x_mm,y_mm,z_mm\n1,2,3\n1,oops,3\n' > bad.csv
expect 2 'bad.csv:3: column 2 (y_mm): expected a number, got "oops"' -- "$forceshade" force --law wall --stiffness 1 --input bad.csv --out never.csv
same "" "$(ls | grep never)"
printf 'x_mm,y_mm,z_mm\n\302\2332J,0,0\n' > bad.csv
expect 2 'got "\xc2\x9b2J"' -- "$forceshade" force --law wall --stiffness 1 --input bad.csv --out never.csv
printf '' > empty.csv
expect 2 "empty.csv" -- "$forceshade" force --law wall --stiffness 1 --input empty.csv
printf 'x_mm,y_mm\n1,2\n' > short.csv
expect 2 "z_mm" -- "$forceshade" force --law wall --stiffness 1 --input short.csv
expect 2 "missing.csv" -- "$forceshade" force --law wall --stiffness 1 --input missing.csv
expect 2 "nowhere" -- "$forceshade" force --law wall --stiffness 1 --input in.csv --out nowhere/out.csv

# energy: a potential, a bound with a witness, depths that no witness could be given for.
energy() { "$forceshade" energy "$@"; }
expect 0 "wall: conservative" -- energy --law wall --depth 2
expect 0 "a simple loop no deeper than 2 mm gives the hand up to 5.29167 mJ" -- energy --law bump-1p-shaded --depth 2
same "$(energy --law bump-3p --depth 2)" "$(energy --law bump-3p --depth 0.2cm --radius 600mil --width 1in)"
expect 0 '"conservative":true,"potential":"K/2 max(0, -z)^2","bound_mJ":[0.0,0.0]' -- energy --law bump-1p --depth 2 --json -
same '{"law":"bump-2p","parameters":{"radius_mm":15.239999771118164,"width_mm":25.399999618530273,"stiffness_N_per_mm":0.5},"depth_mm":2.0,"conservative":false,"bound_mJ":[0.11887265438173845,0.11887265438173847],"right_half_mJ":{"counter_clockwise":[0.11887265438173845,0.11887265438173847],"clockwise":[0.0,0.0]},' \
  "$(energy --law bump-2p --depth 2 --json - | grep -o '^.*"witness_mJ"' | sed 's/"witness_mJ"//')"
expect 0 "bump-2p: active" -- energy --law bump-2p --depth 2 --json energy.json
grep -q '"witness":\[\[12.69' energy.json || { echo "FAILED: $(cat energy.json)"; exit 1; }
expect 2 "energy: expected --depth, got none" -- energy --law wall
expect 2 'got "deep"' -- energy --law wall --depth deep
expect 2 "--depth is 0.001 mm; expected 0.001524 to 10000 mm" -- energy --law bump-2p --depth 0.001
expect 2 "--depth is -2 mm; expected" -- energy --law bump-2p --depth=-2

# polygons
expect 0 "3 polygons: the bump subtends 112.885 degrees, each of them 37.6285" -- "$forceshade" polygons --radius 600mil --width 1in --theta-critical 40
expect 0 '"polygons":4' -- "$forceshade" polygons --radius 12.7 --width 25.4 --theta-critical 60 --json -
expect 2 "--width is 11 mm" -- "$forceshade" polygons --radius 5 --width 11 --theta-critical 40
expect 2 "expected an angle from 0.000001 to 180 degrees" -- "$forceshade" polygons --radius 5 --width 5 --theta-critical 0
expect 2 "polygons: expected --theta-critical, got none" -- "$forceshade" polygons
same "$("$forceshade" polygons --theta-critical 40)" "$("$forceshade" polygons --radius 600mil --width 1in --theta-critical 40deg)"
same "$("$forceshade" polygons --theta-critical 90)" "$("$forceshade" polygons --theta-critical 1.57079632679489662rad)"
expect 2 "--radius: expected without --height-map, got both" -- "$forceshade" polygons --radius 5 --height-map x.toml --theta-critical 40
expect 2 "rim of a cap" -- "$forceshade" polygons --height-map "$examples/groove.toml" --from -6 --to 6 --theta-critical 40
expect 0 "6 polygons: the normal turns by" -- "$forceshade" polygons --height-map "$examples/gaussian.toml" --from -15 --to 15 \
  --theta-critical 15 --out polygons.toml
expect 0 ",contact" -- sh -c "printf 'x_mm,y_mm,z_mm\n3,0,-1\n' | '$forceshade' force --height-map 'polygons.toml' --stiffness 1"
expect 2 "number of knots is" -- "$forceshade" polygons --height-map "$examples/gaussian.toml" --from -15 --to 15 --theta-critical 0.05 --out no.toml
expect 0 "polygon" -- "$forceshade" polygons --height-map "$examples/leather.toml" --from -2 --to 2 --theta-critical 90 --out leather.toml
expect 0 ",contact" -- sh -c "printf 'x_mm,y_mm,z_mm\n1,0,-1\n' | '$forceshade' force --height-map 'leather.toml' --stiffness 1"

# height maps
felt() { printf 'x_mm,y_mm,z_mm\n0,0,2\n1,0,-0.5\n' | "$forceshade" force --stiffness 1 --height-map "$@"; }
printf 'render = "height-map"\n[[part]]\nshape = "gaussian"\nheight_mm = 3\nsigma_mm = 5\n' > hill.toml
same "$(felt hill.toml)" "$(felt hill.toml --path reference)"
same "0,0,2,0,0,1,contact" "$(felt hill.toml | sed -n 2p)"
expect 2 "--law: expected without --height-map, got both" -- "$forceshade" force --stiffness 1 --height-map hill.toml --law wall
expect 2 "--law, --height-map or --mesh" -- "$forceshade" force --stiffness 1
sed 's/sigma_mm = 5/sigma_mm = 0/' hill.toml > flat.toml
expect 2 "flat.toml: " -- "$forceshade" force --stiffness 1 --height-map flat.toml --input in.csv
sed 's/sigma_mm/sigma/' hill.toml > misspelt.toml
expect 2 "misspelt.toml: line 2: key sigma_mm is missing" -- "$forceshade" force --stiffness 1 --height-map misspelt.toml --input in.csv

expect 2 "flat.toml: line 5: sigma is 0 mm; expected 0.001 to 10000 mm" -- "$forceshade" certify --stiffness 1 --height-map flat.toml --out map
expect 2 "--stiffness is 0 N/mm" -- "$forceshade" properties --stiffness 0 --height-map hill.toml
expect 2 "--radius: expected without --height-map, got both" -- "$forceshade" properties --height-map hill.toml --radius 1
expect 2 "missing.toml" -- "$forceshade" properties --height-map missing.toml
expect 0 "hill.toml       passivity     held" -- "$forceshade" properties --height-map hill.toml --cases 100
expect 2 "too many inputs to sweep" -- "$forceshade" certify --exhaustive --height-map hill.toml --out map
# Enough for driving, and too little, which is said.
expect 0 "held, not certified: 3750 points" -- "$forceshade" certify --height-map hill.toml --points 3000 --cases 100 --out little
expect 0 "too little for drive: the certificate has 3000 points for hill.toml; driving needs at least 200000" -- \
  "$forceshade" certify --height-map hill.toml --points 3000 --cases 100 --out little --overwrite
expect 1 "the certificate has 3000 points for hill.toml; driving needs at least 200000" -- \
  "$forceshade" drive --height-map hill.toml --device null --certificate little/certificate.json
printf 'render = "height-map"\n[[part]]\nshape = "sphere-cap"\nradius_mm = 20\nwidth_mm = 12\n' > cap.toml
expect 0 "certified: 250000 points" -- "$forceshade" certify --height-map cap.toml --out map
press() { "$forceshade" drive --device simulated --free-run --seconds 1 --certificate map/certificate.json "$@"; }
expect 0 "(time up)" -- press --height-map cap.toml --record press.fsr --json press.json
grep -q '"rendering": "height-map"' press.json || { echo "FAILED: $(cat press.json)"; exit 1; }
expect 0 "digest               $(sed -n 's/.*"digest": "\(.*\)".*/\1/p' press.json)" -- "$forceshade" recording info press.fsr
cp cap.toml same.toml
expect 0 "(time up)" -- press --height-map same.toml
sed 's/radius_mm = 20/radius_mm = 20.000002/' cap.toml > other.toml
expect 1 "covers another height map: expected the digest" -- press --height-map other.toml
sed 's/"height-map"/"height-map-shaded"/' cap.toml > cap_shaded.toml
expect 1 "cap.toml with other parameters: expected rendering height-map-shaded, stiffness 0.5" -- press --height-map cap_shaded.toml
expect 1 "stiffness 0.6 N/mm; got rendering height-map, stiffness 0.5 N/mm" -- press --height-map cap.toml --stiffness 0.6
expect 1 "does not cover the law wall" -- press --law wall
sed 's/"height-map"/"height-map-shaded"/' hill.toml > shaded.toml

# plot and figures
expect 0 "drawn/bump-3p-directions.svg" -- "$forceshade" plot --law bump-3p --what directions --out drawn
same "PNG" "$(head -c 4 drawn/bump-3p-directions.png | tail -c 3)"
grep -q "<svg " drawn/bump-3p-directions.svg || { echo "FAILED: no SVG was drawn"; exit 1; }
expect 2 "--what" -- "$forceshade" plot --law wall --what teapot --out drawn
expect 0 "drawn/hill-energy.png" -- "$forceshade" plot --height-map hill.toml --at 1 --from=-1cm --to 10mm --out drawn
expect 2 "--to is -1 mm; expected 0.01 to 9999 mm" -- "$forceshade" plot --height-map hill.toml --from 0 --to=-1 --out drawn
expect 2 "--law: expected without --height-map, got both" -- "$forceshade" plot --law wall --height-map hill.toml --out drawn
expect 0 "gives the hand up to 0.118756 mJ" -- energy --height-map hill.toml --depth 2
same '{"height_map":"shaded.toml","rendering":"height-map-shaded","parameters":{"stiffness_N_per_mm":2.0},"slice":{"along":"y","at_mm":1.0,"from_mm":0.0,"to_mm":10.0},"depth_mm":2.0,"conservative":false,' \
  "$(energy --height-map shaded.toml --stiffness 2 --depth 2mm --along y --at 1 --from 0 --to 1cm --json - | grep -o '^.*"bound_mJ"' | sed 's/"bound_mJ"//')"
sed 's/"height-map"/"height-map-conservative"/' hill.toml > conservative.toml
expect 0 "conservative.toml, height-map-conservative: conservative" -- energy --height-map conservative.toml --depth 2
expect 2 "hill.toml: depth is 0 mm; expected 0.00127 to 4998.5 mm" -- energy --height-map hill.toml --depth 0
expect 2 "--at: expected --height-map beside it, got it alone" -- energy --law wall --depth 2 --at 3
# Steep and fine: met, not enclosed, interrupted.
grating() { printf 'render = "height-map-shaded"\n[[part]]\nshape = "grating"\nheight_mm = %s\nwave_x_rad_per_mm = %s\n' "$@"; }
grating 20 19.44 > steep.toml
expect 0 "active: over y = 0 mm, x from -0.5 to 0.5 mm" -- energy --height-map steep.toml --depth 0.5 --from=-0.5 --to 0.5
expect 0 '"bound_is_met":true' -- energy --height-map steep.toml --depth 0.5 --from=-0.5 --to 0.5 --json -
grating 1 1000 > far.toml
printf 'render = "height-map"\n[[part]]\nshape = "cone"\nheight_mm = 3\nradius_mm = 4\nx_mm = 0.3\n' > missed.toml
expect 1 "missed.toml: no verdict: not enclosed: the height map is so steep or so fine" -- \
  energy --height-map missed.toml --depth 1 --at 1e-35 --json missed.json
[ ! -e missed.json ] || { echo "FAILED: a verdict that is none was written"; exit 1; }
"$forceshade" energy --height-map far.toml --depth 2 --from=-100 --to 100 --json stopped.json > stopped.txt 2>&1 &
sleep 1; kill -INT $!; wait $!; same 130 $?
same "forceshade: interrupted: far.toml has no verdict, and nothing was written" "$(cat stopped.txt)"
# A run of properties writes nothing where it is interrupted.
"$forceshade" properties --law wall --cases 1000000000 --junit hung_up.xml > /dev/null 2> stopped.txt &
sleep 1; kill -TERM $!; wait $!; same 130 $?
same "forceshade: interrupted: not all properties were checked, and nothing was written" "$(cat stopped.txt)"
same "" "$(ls | grep hung_up)"
[ ! -e stopped.json ] || { echo "FAILED: a verdict that is none was written"; exit 1; }
expect 2 "expected a directory" -- "$forceshade" plot --law wall --what force --out in.csv/no
expect 0 "drawn/figure-5-5.csv" -- "$forceshade" figures --out drawn
same "600 112.885" "$(sed -n 's/^\(600\),\(112.885\).*/\1 \2/p' drawn/figure-5-5.csv)"
same "600 6.8157" "$(sed -n 's/^\(600\),\(......\).*/\1 \2/p' drawn/figure-5-4.csv)"
same 6 "$(wc -l < drawn/figure-5-4.csv)"
same "-3,-3,3.99665867" "$(grep -o '^-3,-3,3.99665867' drawn/figure-2-3.csv)"

# properties
expect 0 "equivalence   held" -- "$forceshade" properties --law bump-3p --cases 200 --seed 5
same 37 "$("$forceshade" properties --cases 20 | wc -l)"
# For programs: the same results as JSON and as JUnit XML; a law that fails, and a name that is hostile to XML and to terminals.
expect 0 "bump-2p         passivity     held" -- "$forceshade" properties --law bump-2p --cases 100 --json two.json --junit two.xml
same '"bump-2p" 25.399999618530273 ["equivalence","continuity","unit normals","passivity"] true' \
  "$(jq -c '.subjects[0] | .name, .parameters.width_mm, [.properties[].name], all(.properties[]; .held)' two.json | tr '\n' ' ' | sed 's/ $//')"
same "true 1 100" "$(jq -r '"\(.held) \(.seed) \(.cases)"' two.json)"
same 4 "$(grep -c '<testcase classname="forceshade properties.bump-2p" name="' two.xml)"
same 0 "$(grep -c '<failure' two.xml)"
same 9 "$("$forceshade" properties --cases 1 --json | jq '.subjects | length')"
hostile=$(printf '<a>&"\001\033[2J\377.toml')
cp hill.toml "$hostile"
expect 0 "" -- "$forceshade" properties --height-map "./$hostile" --cases 50 --junit hostile.xml --json hostile.json
grep -qF '<testsuite name="&lt;a&gt;&amp;&quot;\x01\x1b[2J\xff.toml"' hostile.xml || { echo "FAILED: $(cat hostile.xml)"; exit 1; }
same 4 "$(jq '.subjects[0].properties | length' hostile.json)"
# Facets: the gradient of a bilinear grid jumps on its lines, which one property finds.
cp "$examples/leather.png" .
sed 's/cubic-spline/bilinear/' "$examples/leather.toml" > facets.toml
expect 1 "counterexample: " -- "$forceshade" properties --height-map facets.toml --cases 200 --junit facets.xml --json facets.json
same 1 "$(grep -c '<failure type="counterexample" message="[^"]' facets.xml)"
grep -q '<testsuite name="facets.toml" tests="5" failures="1"' facets.xml || { echo "FAILED: $(cat facets.xml)"; exit 1; }
same "false cell lines" "$(jq -r '"\(.held) \(.subjects[0].properties[] | select(.counterexample) | .name)"' facets.json)"
expect 2 "--json and --junit: expected two files" -- "$forceshade" properties --json - --junit -
expect 0 "" -- "$forceshade" certify --law wall --points 1000 --cases 20 --out junit --junit certify.xml
same "points equivalence continuity unit normals passivity" "$(sed -n 's/.*<testcase .* name="\([^"]*\)".*/\1/p' certify.xml | tr '\n' ' ' | sed 's/ $//')"
grep -q '<system-out>1000 points, and 250 with other parameters</system-out>' certify.xml || { echo "FAILED: $(cat certify.xml)"; exit 1; }
expect 2 "--junit: expected without --exhaustive" -- "$forceshade" certify --exhaustive --junit x.xml --out junit
if command -v xmllint > /dev/null; then for file in two hostile facets certify; do expect 0 "" -- xmllint --noout $file.xml; done; fi
# Both say how far they are, on a terminal and nowhere else.
expect 0 " left  Ctrl-C stops  bump-3p" -- script -qec "$forceshade properties --law bump-3p --cases 200000" /dev/null
same "" "$("$forceshade" properties --law bump-3p --cases 1000 2>&1 | grep Ctrl-C)"

recording() { "$forceshade" recording "$@"; }
# certify and drive: certified, other parameters, other law, no certificate, a certificate of another build.
expect 0 "certified: 1250000 points" -- "$forceshade" certify --law bump-1p-shaded --out here
[ -s here/certificate.json ] && [ -s here/certificate.html ] || { echo "FAILED: certify wrote nothing"; exit 1; }
expect 2 "expected a directory" -- "$forceshade" certify --law wall --points 1 --out in.csv/no
# Its options: what is no whole number, what does not fit, what goes with something else.
certify() { "$forceshade" certify --law wall "$@"; }
expect 2 '--points: expected a whole number from 1 to 1000000000000, got "1e6"' -- certify --points 1e6 --out no
expect 2 '--points: expected a whole number from 1' -- certify --points 0 --out no
expect 2 '--cases: expected a whole number from 1 to 1000000000, got "-1"' -- certify --cases -1 --out no
expect 2 '--seed: expected a whole number from 0 to 18446744073709551615, got "18446744073709551616"' -- \
  certify --seed 18446744073709551616 --out no
for option in --points --cases --seed; do expect 2 "$option: expected without --exhaustive, got both" -- certify --exhaustive $option 3 --out no; done
expect 2 "--points: expected after 'certify merge'" -- "$forceshade" certify --points 3 merge in.csv --out no
expect 2 "too many inputs to sweep" -- "$forceshade" certify --exhaustive --height-map hill.toml --out new/no
expect 2 "--sweeps: expected a kind of sweep that the law has" -- "$forceshade" certify --exhaustive --law wall --sweeps lines --out new/no
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
# certify --exhaustive: a small shard of a quick sweep, stopped and resumed, refused when it does not fit.
sweep() { "$forceshade" certify --exhaustive --law wall --sweeps heights "$@"; }
for k in 1 2; do expect 0 "8388608 inputs" -- sweep --shards $k/512 --out parts; done
expect 2 "missing part: units 2 to 512" -- "$forceshade" certify merge parts/exhaustive-1-of-512.json parts/exhaustive-2-of-512.json --out whole
# As if all of it had been swept: a certificate of sweeps alone drives nothing, which is said twice.
sed -e '0,/"held": false/s//"held": true/' -e 's/"end": 1,/"end": 512,/' -e 's/"next": 1,/"next": 512,/' \
  parts/exhaustive-1-of-512.json > swept.json
expect 0 "driving needs points and properties too" -- "$forceshade" certify merge swept.json --out swept
expect 2 "swept/certificate.json" -- "$forceshade" certify merge swept.json --out swept
expect 0 "swept, no mismatch" -- "$forceshade" certify merge swept.json --out swept --overwrite
expect 1 "the certificate has sweeps only" -- "$forceshade" drive --law wall --device null --certificate swept/certificate.json
expect 2 "overlaps" -- "$forceshade" certify merge parts/exhaustive-1-of-512.json parts/exhaustive-1-of-512.json --out whole
expect 2 "exhaustive-1-of-512.json: expected a part of these sweeps, got one of other sweeps" -- "$forceshade" certify --exhaustive --law bump-1p --sweeps heights --shards 1/512 --out parts
expect 2 "expected k/n" -- sweep --shards 3/2 --out parts
expect 2 "--sweeps: expected a kind of sweep that the law has" -- "$forceshade" certify --exhaustive --law wall --sweeps lines --out parts
expect 2 "certify: expected --out, got none" -- "$forceshade" certify --law wall
"$forceshade" certify --exhaustive --out stopped_sweep > stopped.txt 2>&1 &
sleep 2; kill -INT $!; wait $!; same 130 $?
grep -q "the same command goes on from" stopped.txt || { echo "FAILED: $(cat stopped.txt)"; exit 1; }
grep -q '"finished": false' stopped_sweep/exhaustive-1-of-1.json || { echo "FAILED: no checkpoint"; exit 1; }
drive() { "$forceshade" drive --device replay:hand.csv --free-run "$@"; }
expect 0 "missed deadlines  0" -- drive --law bump-1p-shaded --certificate here/certificate.json --record record.csv --json run.json
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
expect 0 "ticks             21 (end of data)" -- "$forceshade" drive --law wall --uncertified --free-run --device replay:slow.csv --record slow_run.csv
same "5.005,0.5,0,-1" "$(sed -n 7p slow_run.csv | cut -d, -f3-6)"
printf '5.02,3,0,-1\n' >> slow.csv
expect 2 'slow.csv:5: column 1 (t_s): expected a time after 5.02, got "5.02"' -- \
  "$forceshade" drive --law wall --uncertified --free-run --device replay:slow.csv
expect 1 "refused to drive: here/certificate.json: the certificate covers bump-1p-shaded with other parameters" -- \
  drive --law bump-1p-shaded --stiffness 0.6 --certificate here/certificate.json
expect 1 "does not cover the law wall" -- drive --law wall --certificate here/certificate.json
expect 1 "no certificate was given" -- drive --law wall
expect 0 "UNCERTIFIED" -- drive --law wall --uncertified
sed 's/\("library_digest": "\)......../\1deadbeef/' here/certificate.json > other.json
expect 1 "another build" -- drive --law bump-1p-shaded --certificate other.json
sed 's/"mismatches": 0/"mismatches": 1/' here/certificate.json > failed.json
expect 2 "subjects[0].counterexamples is an array; expected the first of 1 mismatches" -- drive --law bump-1p-shaded --certificate failed.json
sed -e '0,/"held": true/s//"held": false/' -e '0,/"held": true/s//"held": false/' -e 's/"standing": "sufficient"/"standing": "failed"/' \
  -e '0,/"mismatches": 0/s//"mismatches": 1/' \
  -e '0,/"counterexamples": \[\]/s//"counterexamples": ["at 0"]/' here/certificate.json > failed.json
expect 1 "the certificate says that bump-1p-shaded failed" -- drive --law bump-1p-shaded --certificate failed.json
: > nothing.json
expect 2 "nothing.json: cannot be read: it is empty" -- drive --law wall --certificate nothing.json
expect 2 "expected a forceshade certificate" -- drive --law wall --certificate in.csv
expect 2 "cannot be read" -- drive --law wall --certificate missing.json
expect 2 "replay" -- "$forceshade" drive --law wall --uncertified --device teapot:x
expect 0 "(time up)" -- "$forceshade" drive --law wall --uncertified --device simulated --seconds 0.1 --free-run
expect 0 "(end of data)" -- "$forceshade" drive --law wall --uncertified --device simulated:omni:hand.csv --free-run
expect 0 "(time up)" -- "$forceshade" drive --law wall --uncertified --device null --seconds 0.1 --free-run
# A line follows the run in a terminal, and nowhere else.
watched="$forceshade drive --law wall --uncertified --device null --seconds 0.5 --watchdog-timeout 1"
expect 0 " Hz  late " -- script -qec "$watched" /dev/null
same "" "$($watched 2>&1 | grep " Hz  late ")"
# In a narrow terminal it is as narrow, so that it does not wrap.
script -qec "stty cols 40; $watched" /dev/null | tr '\r' '\n' | sed 's/\x1b\[K//' | grep -a ' mJ$\| N ' > narrow.txt
same 39 "$(awk '{ if (length($0) > most) most = length($0) } END { print (most <= 39 && most > 20) ? 39 : most }' narrow.txt)"
expect 0 "passivity         tank: account" -- "$forceshade" drive --law wall --uncertified --device simulated --seconds 0.1 --free-run --passivity tank
expect 2 "--passivity" -- drive --law wall --uncertified --passivity teapot
expect 2 "dead-man button: expected none, because the device has no buttons" -- drive --law wall --uncertified --dead-man 1
expect 2 "dead-man button" -- drive --law wall --uncertified --dead-man 1 --record never.fsr
same "" "$(ls | grep never)"
expect 0 "not supervised" -- drive --law wall --uncertified
# A hand that is torn sideways under force: the supervisor ends the run, and says why.
{ echo t_s,x_mm,y_mm,z_mm; for i in $(seq 0 19); do echo "0.$((i / 10))$((i % 10))0,0,0,3"; done
  echo "0.300,0,0,-6"; echo "1.5,0,0,-6"; echo "1.51,120,0,-6"; echo "2,120,0,-6"; } > torn.csv
expect 3 "the supervisor stopped the run: velocity" -- "$forceshade" drive --law wall --uncertified --free-run \
  --device simulated:premium-1.5:torn.csv --record torn.fsr --json torn.json
expect 0 "end_reason           tripped" -- recording info torn.fsr
expect 0 "device_model         premium-1.5" -- recording info torn.fsr
same "" "$(recording info torn.fsr | grep device_serial)"
expect 3 "before the end    201 ticks kept" -- "$forceshade" drive --law wall --uncertified --free-run --device simulated:premium-1.5:torn.csv
expect 3 "mm/s; force 0.000 N, one tick before " -- "$forceshade" drive --law wall --uncertified --free-run --device simulated:premium-1.5:torn.csv
grep -q '"rule": "velocity"' torn.json || { echo "FAILED: torn.json has no trip"; exit 1; }
expect 2 'unknown model "teapot"' -- "$forceshade" drive --law wall --uncertified --device simulated:teapot
# A PHANToM: no driver library, one found by its name, one named, and a licence that is missing.
phantom() { env LD_LIBRARY_PATH= FORCESHADE_HD_LIBRARY= "$@" "$forceshade" drive --law wall --uncertified --device phantom --seconds 0.1; }
expect 3 "libHD.so.3.0: cannot open shared object file" -- phantom
expect 3 "/nowhere/libHD.so: cannot open shared object file" -- phantom FORCESHADE_HD_LIBRARY=/nowhere/libHD.so
expect 3 "it lacks hdInitDevice" -- phantom FORCESHADE_HD_LIBRARY=libm.so.6
expect 3 "the vendor's licence is missing" -- phantom LD_LIBRARY_PATH="$(dirname "$stand_in_hd")" STAND_IN_HD_INIT=0x600
expect 3 "the vendor's licence is missing" -- phantom FORCESHADE_HD_LIBRARY="$stand_in_hd" STAND_IN_HD_INIT=0x600
expect 2 "phantom[:NAME]" -- "$forceshade" drive --law wall --uncertified --device phantom:
expect 2 "--rate" -- drive --law wall --uncertified --rate 5

# What is there already is replaced only with --overwrite, whatever option names it, and is refused before any work.
echo old > kept
for option in "force --law wall --input in.csv --out" "energy --law bump-1p --depth 1 --json" "polygons --theta-critical 40 --json" \
  "geometry --json" "drive --law wall --uncertified --device null --seconds 0.01 --free-run --json" \
  "drive --law wall --uncertified --device null --seconds 0.01 --free-run --record" "device list --json"; do
  expect 2 'expected a new file, or --overwrite beside it; "kept" is there already' -- "$forceshade" $option kept
  same old "$(cat kept)"
  expect 0 "" -- "$forceshade" $option kept --overwrite
  checks=$((checks + 1))
  [ "$(cat kept)" != old ] || { echo "FAILED: $option kept --overwrite kept it"; exit 1; }
  echo old > kept
done
echo old > kept.fsr; echo old > kept.fsr-wal
expect 2 '"kept.fsr" is there already' -- drive --law wall --uncertified --record kept.fsr
expect 0 "" -- drive --law wall --uncertified --record kept.fsr --overwrite
expect 0 "whole: 4 samples" -- "$forceshade" recording verify kept.fsr
for folder in "plot --law wall --what force" figures "certify --law wall --points 1000 --cases 10"; do
  mkdir -p rule; rm -f rule/*
  expect 0 "" -- "$forceshade" $folder --out rule
  file=$(ls rule | head -1); echo old > "rule/$file"
  expect 2 'expected a new file, or --overwrite beside it; "rule/' -- "$forceshade" $folder --out rule
  same old "$(cat "rule/$file")"
  expect 0 "" -- "$forceshade" $folder --out rule --overwrite
done
expect 0 "" -- "$forceshade" geometry --json /dev/null

# recording: a whole recording, one on a disk that refuses, one killed; files that are none.
expect 0 "(end of data)" -- drive --law bump-1p-shaded --certificate here/certificate.json --record run.fsr
expect 2 '--record: expected a new file, or --overwrite beside it; "run.fsr" is there already' -- drive --law wall --uncertified --record run.fsr
expect 0 "certificate_digest   $(sha256sum here/certificate.json | cut -d' ' -f1)" -- recording info run.fsr
expect 0 "device               replay:hand.csv" -- recording info run.fsr
expect 0 '"radius_mm": "15.24"' -- recording info run.fsr --json -
expect 0 "whole: 4 samples" -- recording verify run.fsr
expect 0 "" -- recording export run.fsr --out run.csv
expect 0 "" -- recording export run.fsr --out run.npy
same "$(cat run.csv)" "$(recording export run.fsr)"
same "$(cut -d, -f1,3-10 record.csv)" "$(cut -d, -f1,3-10 run.csv)"
same "NUMPY" "$(head -c 6 run.npy | tail -c 5)"
expect 2 "nowhere" -- recording export run.fsr --out nowhere/run.csv
expect 2 "in.csv: expected a recording (.fsr), got a CSV file" -- recording verify in.csv
mkfifo pipe.fsr
expect 2 "pipe.fsr: expected a recording, got no regular file" -- timeout 10 "$forceshade" recording verify pipe.fsr
# Said before the work: a folder that is not there, and standard output for several files.
expect 2 '--junit: expected a file in a folder that can be written to, got "nowhere/a.xml"' -- \
  timeout 10 "$forceshade" properties --law all --cases 1000000000 --junit nowhere/a.xml
expect 2 '--junit: expected a file in a folder that can be written to, got "nowhere/a.xml"' -- \
  timeout 10 "$forceshade" certify --law wall --points 1000000000000 --out unwritten --junit nowhere/a.xml
expect 2 '--out: expected a directory, for the command writes several files, got "-"' -- "$forceshade" plot --law wall --out -
same "" "$(ls -d -- unwritten - 2> /dev/null)"
# A file that someone else made: nothing in it commands the terminal, and one that is damaged says so.
corpus="$(dirname "$examples")/tests/fuzz/corpus"
expect 0 'law                  \x1b[2Jwall' -- recording info "$corpus/recording/escape.fsr"
expect 0 '"\u009bkey": "\u202egpj"' -- recording info "$corpus/recording/escape.fsr" --json -
same "" "$(recording info "$corpus/recording/escape.fsr" | tr -d '[:print:]\n')"
expect 1 "the metadata (law, parameters, certificate, device and so on) are not what was written" -- recording verify "$corpus/recording/changed_stiffness.fsr"
expect 1 "are not what was written" -- recording info "$corpus/recording/changed_stiffness.fsr"
expect 2 "are not what was written" -- recording export "$corpus/recording/changed_stiffness.fsr" --out never.csv
same "" "$(ls | grep never)"
expect 0 "0 missing, 2 repeated" -- recording info "$corpus/recording/twice.fsr"
expect 0 "format 2 has no checksum of the metadata" -- recording verify "$corpus/recording/format2.fsr"
expect 0 "every checksum, and the metadata" -- recording verify "$corpus/recording/whole.fsr"
expect 2 "got the view metadata" -- recording info "$corpus/recording/endless_view.fsr"
expect 2 "got the view chunk" -- recording verify "$corpus/recording/endless_chunks.fsr"
expect 2 "missing.fsr: cannot open: No such file" -- recording info missing.fsr
expect 2 "recording: expected a command: info, verify, recompute, export; got none" -- recording
expect 2 'got "ifno"; the nearest is info' -- recording ifno run.fsr
small_disk() { (trap '' XFSZ; ulimit -f 200; "$@"); }
expect 2 "full.fsr: disk I/O error; recorded" -- \
  small_disk "$forceshade" drive --law wall --uncertified --device simulated --free-run --seconds 20 --record full.fsr
expect 1 "no end" -- recording verify full.fsr
no_disk() { (trap '' XFSZ; ulimit -f 0; "$@"); }
expect 2 "run.fsr: " -- no_disk "$forceshade" drive --law wall --uncertified --device null --seconds 0.1 --record unmade.csv
same "" "$(ls | grep unmade)"
"$forceshade" drive --law wall --uncertified --device null --record killed.fsr 2> killed.txt &
sleep 1; kill -KILL $!; wait $! 2> /dev/null
expect 1 "killed.fsr: no end: cut off" -- recording verify killed.fsr
expect 0 "the recording has no end" -- recording export killed.fsr --out killed.csv
checks=$((checks + 1))
[ "$(wc -l < killed.csv)" -gt 1 ] || { echo "FAILED: nothing was recorded before the kill: $(cat killed.txt)"; exit 1; }

# Ctrl-C: a drive ends with force zero and its record complete; certify and force leave nothing.
{ echo t_s,x_mm,y_mm,z_mm; for i in $(seq 0 20000); do echo "$i,3,0,-1"; done; } > long.csv
"$forceshade" drive --law wall --uncertified --device replay:long.csv --record stopped.csv > stopped.txt 2>&1 &
sleep 1; kill -INT $!; wait $!; same 0 $?
grep -q "(stopped)" stopped.txt || { echo "FAILED: not stopped: $(cat stopped.txt)"; exit 1; }
same "0,0,0,end" "$(tail -1 stopped.csv | cut -d, -f7-10)"
same "$(($(sed -n 's/^ticks *\([0-9]*\).*/\1/p' stopped.txt) + 2))" "$(wc -l < stopped.csv)"
"$forceshade" certify --points 1000000000 --out stopped > stopped.txt 2>&1 &
sleep 1; kill -INT $!; wait $!; same 130 $?
grep -q "interrupted" stopped.txt || { echo "FAILED: $(cat stopped.txt)"; exit 1; }
same "" "$(ls -d stopped 2> /dev/null)"
echo "$checks checks passed"
