#!/usr/bin/env bash
# The forceshade command as its users call it: laws, forces, energies, height maps, figures and properties; outputs and exit codes.
. "$(dirname "$0")/expect.sh"
. "$examples/../tests/apps/command_inputs.sh"

# Help, version, wrong usage.
expect 0 "Usage: forceshade" -- "$forceshade" --help
expect 0 "forceshade " -- "$forceshade" --version
commands="laws force energy plot properties certify conform drive recording device mesh"
for command in $commands; do expect 0 "$command" -- "$forceshade" $command --help; done
expect 2 "forceshade: expected a command: ${commands// /, }" -- "$forceshade"
expect 2 "expected one of: $commands" -- "$forceshade" nonsense
for word in revision compiler "instruction set" "library digest"; do expect 0 "$word " -- "$forceshade" --version; done

# laws
expect 0 "bump-3p-shaded" -- "$forceshade" laws

# laws of a bump: the rational bump, units, digits, errors.
same '{"d_mm":"1.0000000000","h_mm":"0.25000000000","w_prime_mm":"0.53214818646",'\
'"h_prime_mm":"0.22135358390","theta_rad":"0.42900073920"}' \
  "$("$forceshade" laws --radius 1.25 --width 1.5 --digits 11 --json)"
same "$("$forceshade" laws --radius 15.24 --width 25.4)" "$("$forceshade" laws --radius 600mil --width 1in)"
same "$("$forceshade" laws --radius 15.24 --width 25.4)" "$("$forceshade" laws --digits 30)"
expect 0 "theta  0.42900073920 rad" -- "$forceshade" laws --radius 1.25 --width 1.5 --digits 11

# force: columns in any order, both paths, statuses.
same "$(printf 'x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n3,0,-1,0.6,0,0.8,contact\n0,0,5,0,0,0,free\nnan,0,-1,0,0,0,invalid')" \
  "$("$forceshade" force in.csv --law bump-1p-shaded --radius 5 --width 8 --stiffness 1)"
same "$(printf 'x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n3,0,-1,0.6000000,0,0.8000000,contact\n0,0,5,0,0,0,free\nnan,0,-1,0,0,0,invalid')" \
  "$("$forceshade" force --law bump-1p-shaded --radius 5 --width 8 --stiffness 1 --digits 7 < in.csv)"
expect 0 "" -- "$forceshade" force in.csv --law wall --stiffness 1 --out out.csv
same 4 "$(wc -l < out.csv)"
same "$("$forceshade" force in.csv --law bump-2p --radius 600mil --width 1in --stiffness 500N/m)" \
  "$("$forceshade" force in.csv --law bump-2p)"
# A malformed row: file, line, column; exit 2; no output file, whole or partial.
printf 'x_mm,y_mm,z_mm\n1,2,3\n1,oops,3\n' > bad.csv
expect 2 'bad.csv:3: column 2 (y_mm): expected a number, got "oops"' -- \
  "$forceshade" force bad.csv --law wall --stiffness 1 --out never.csv
same "" "$(ls | grep never)"

# energy: a potential, a bound with a witness, depths that no witness could be given for.
energy() { "$forceshade" energy "$@"; }
expect 0 "wall: conservative" -- energy --law wall --depth 2
expect 0 "a simple loop no deeper than 2 mm gives the hand up to 5.29167 mJ" -- energy --law bump-1p-shaded --depth 2
same "$(energy --law bump-3p --depth 2)" "$(energy --law bump-3p --depth 0.2cm --radius 600mil --width 1in)"
expect 0 '"conservative":true,"potential":"K/2 max(0, -z)^2","bound_mJ":[0.0,0.0]' -- energy --law bump-1p --depth 2 --json -
same '{"law":"bump-2p","parameters":{"radius_mm":15.239999771118164,"width_mm":25.399999618530273,"stiffness_N_per_mm":0.5},'\
'"depth_mm":2.0,"conservative":false,"bound_mJ":[0.11887265438173845,0.11887265438173847],'\
'"right_half_mJ":{"counter_clockwise":[0.11887265438173845,0.11887265438173847],"clockwise":[0.0,0.0]},' \
  "$(energy --law bump-2p --depth 2 --json - | grep -o '^.*"witness_mJ"' | sed 's/"witness_mJ"//')"
expect 0 "bump-2p: active" -- energy --law bump-2p --depth 2 --json energy.json
grep -q '"witness":\[\[12.69' energy.json || { echo "FAILED: $(cat energy.json)"; exit 1; }
"$forceshade" mesh make icosphere --cells 1 --out energy.off > made.txt
expect 0 "energy.off: the shading gives at most" -- energy --mesh energy.off --unit mm --depth 0.5 --length 50mm --json most.json
printed=$(cat most.json); also '"gives_energy":true'
expect 0 "without shading no closed path gives energy" -- energy --mesh energy.off --unit mm --depth 0.5 --shading none
expect 0 "no witness: no stroke no longer than 0.1 mm" -- energy --mesh energy.off --unit mm --depth 0.5 --length 0.1 --json none.json
printed=$(cat none.json); also '"witness":[]'
expect 2 "energy.off: expected the contact rule direct, got sub-goal" -- \
  energy --mesh energy.off --unit mm --depth 1 --contact sub-goal --shading vertex
expect 2 "--depth is 0 mm; expected 0.0009765625 to 100 mm" -- energy --mesh energy.off --unit mm --depth 0
expect 2 "\"energy --step\" is 'forceshade force FILE' now, along a path" -- energy --mesh energy.off --unit mm --depth 1 --step 0.5mm
expect 0 "drawn/energy-energy.png" -- "$forceshade" plot energy --mesh energy.off --unit mm --out drawn --overwrite

# laws that count polygons
expect 0 "3 polygons: the bump subtends 112.885 degrees, each of them 37.6285" -- \
  "$forceshade" laws --radius 600mil --width 1in --theta-critical 40
expect 0 '"polygons":4' -- "$forceshade" laws --radius 12.7 --width 25.4 --theta-critical 60 --json -
same "$("$forceshade" laws --theta-critical 40)" "$("$forceshade" laws --radius 600mil --width 1in --theta-critical 40deg)"
same "$("$forceshade" laws --theta-critical 90)" "$("$forceshade" laws --theta-critical 1.57079632679489662rad)"

# height maps
felt() { printf 'x_mm,y_mm,z_mm\n0,0,2\n1,0,-0.5\n' | "$forceshade" force --stiffness 1 --height-map "$@"; }
same "$(felt hill.toml)" "$(felt hill.toml --digits binary32)"
same "0,0,2,0,0,1,contact" "$(felt hill.toml | sed -n 2p)"

expect 0 "hill.toml       passivity     held" -- "$forceshade" properties --height-map hill.toml --cases 100
# Enough for driving, and too little, which is said.
expect 0 "held, not certified: 3750 points" -- "$forceshade" certify --height-map hill.toml --points 3000 --cases 100 --out little
also "too little for drive: the certificate has 3000 points for hill.toml; driving needs at least 200000"
expect 1 "the certificate has 3000 points for hill.toml; driving needs at least 200000" -- \
  "$forceshade" drive --height-map hill.toml --device null --certificate little/certificate.json
printf 'render = "height-map"\n[[part]]\nshape = "plane"\nslope_x = 0.25\n' > ramp.toml  # of all kinds the fastest
expect 0 "certified: 250000 points" -- "$forceshade" certify --height-map ramp.toml --out map
press() { "$forceshade" drive --device simulated --pace none --seconds 1 --certificate map/certificate.json "$@"; }
expect 0 "(time up)" -- press --height-map ramp.toml --out press.fsr --json press.json
grep -q '"rendering": "height-map"' press.json || { echo "FAILED: $(cat press.json)"; exit 1; }
expect 0 "digest               $(sed -n 's/.*"digest": "\(.*\)".*/\1/p' press.json)" -- "$forceshade" recording check press.fsr
cp ramp.toml same.toml
expect 0 "(time up)" -- press --height-map same.toml
sed 's/"height-map"/"height-map-shaded"/' ramp.toml > ramp_shaded.toml
expect 1 "ramp.toml with other parameters: expected rendering height-map-shaded, stiffness 0.5" -- press --height-map ramp_shaded.toml
sed 's/"height-map"/"height-map-shaded"/' hill.toml > shaded.toml

# plot
expect 0 "drawn/bump-3p-directions.svg" -- "$forceshade" plot directions --law bump-3p --out drawn
same "PNG" "$(head -c 4 drawn/bump-3p-directions.png | tail -c 3)"
grep -q "<svg " drawn/bump-3p-directions.svg || { echo "FAILED: no SVG was drawn"; exit 1; }
expect 0 "drawn/hill-energy.png" -- "$forceshade" plot --height-map hill.toml --section y=1,x=-1cm..10mm --out drawn
expect 0 "gives the hand up to 0.118756 mJ" -- energy --height-map hill.toml --depth 2
same '{"height_map":"shaded.toml","rendering":"height-map-shaded","parameters":{"stiffness_N_per_mm":2.0},'\
'"slice":{"along":"y","at_mm":1.0,"from_mm":0.0,"to_mm":10.0},"depth_mm":2.0,"conservative":false,' \
  "$(energy --height-map shaded.toml --stiffness 2 --depth 2mm --section y=0..1cm,x=1 --json - |
    grep -o '^.*"bound_mJ"' | sed 's/"bound_mJ"//')"
sed 's/"height-map"/"height-map-conservative"/' hill.toml > conservative.toml
expect 0 "conservative.toml, height-map-conservative: conservative" -- energy --height-map conservative.toml --depth 2
expect 2 "hill.toml: depth is 0 mm; expected 0.00127 to 4998.5 mm" -- energy --height-map hill.toml --depth 0
# Steep and fine: met, not enclosed, interrupted.
grating() { printf 'render = "height-map-shaded"\n[[part]]\nshape = "grating"\nheight_mm = %s\nwave_x_rad_per_mm = %s\n' "$@"; }
grating 20 19.44 > steep.toml
expect 0 "active: over y = 0 mm, x from -0.5 to 0.5 mm" -- energy --height-map steep.toml --depth 0.5 --section x=-0.5..0.5 --json steep.json
printed=$(cat steep.json); also '"bound_is_met":true'
grating 1 1000 > far.toml
printf 'render = "height-map"\n[[part]]\nshape = "cone"\nheight_mm = 3\nradius_mm = 4\nx_mm = 0.3\n' > missed.toml
expect 1 "missed.toml: no verdict: not enclosed: the height map is so steep or so fine" -- \
  energy --height-map missed.toml --depth 1 --section y=1e-35 --json missed.json
[ ! -e missed.json ] || { echo "FAILED: a verdict that is none was written"; exit 1; }
"$forceshade" energy --height-map far.toml --depth 2 --section x=-100..100 --json stopped.json > stopped.txt 2>&1 &
stopped INT; same 130 $?
same "forceshade: interrupted: far.toml has no verdict, and nothing was written" "$(cat stopped.txt)"
# A run of properties writes nothing where it is interrupted.
"$forceshade" properties --law wall --cases 1000000000 --junit hung_up.xml > /dev/null 2> stopped.txt &
stopped TERM; same 130 $?
same "forceshade: interrupted: not all properties were checked, and nothing was written" "$(cat stopped.txt)"
same "" "$(ls | grep hung_up)"
[ ! -e stopped.json ] || { echo "FAILED: a verdict that is none was written"; exit 1; }
expect 0 "drawn/figure-5-5.csv" -- "$forceshade" plot thesis --out drawn
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
  "$(jq -c '.subjects[0] | .name, .parameters.width_mm, [.properties[].name], all(.properties[]; .held)' two.json |
    tr '\n' ' ' | sed 's/ $//')"
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
expect 0 "" -- "$forceshade" certify --law wall --points 1000 --cases 20 --out junit --junit certify.xml
same "points equivalence continuity unit normals passivity" \
  "$(sed -n 's/.*<testcase .* name="\([^"]*\)".*/\1/p' certify.xml | tr '\n' ' ' | sed 's/ $//')"
grep -q '<system-out>1000 points, and 250 with other parameters</system-out>' certify.xml || { echo "FAILED: $(cat certify.xml)"; exit 1; }
if command -v xmllint > /dev/null; then
  for file in two hostile facets certify; do expect 0 "" -- xmllint --noout $file.xml; done
else
  echo "skipped: the form of XML, since xmllint is not there (Debian package libxml2-utils)"
fi
# Both say how far they are, on a terminal and nowhere else.
script -qfec "echo \$\$ > pid; exec $forceshade properties --law bump-3p --cases 1000000000" shown.txt > /dev/null &
until grep -sq " left  Ctrl-C stops  bump-3p" shown.txt; do sleep 0.05; done
kill -INT "$(cat pid)"; wait $!
same "" "$("$forceshade" properties --law bump-3p --cases 1000 2>&1 | grep Ctrl-C)"
echo "$checks checks passed"
