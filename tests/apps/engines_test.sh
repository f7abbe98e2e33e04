#!/usr/bin/env bash
# engines_test.sh FORCESHADE PART: the adapters of physics engines in examples/renderers/engines. PART is cpp (ODE and Bullet, from
# Debian's packages) or npm, whose packages are those of package-lock.json with their hashes. Exit code 77, which CTest takes for
# skipped, where something that they need is lacking.
skip() { echo "skipped: $1"; exit 77; }
part=$2
engines=$(realpath "$(dirname "$0")/../../examples/renderers/engines")
check=$(realpath "$(dirname "$0")/engine_check.py")
command -v python3 > /dev/null || skip "no python3 in PATH"
. "$(dirname "$0")/expect.sh"
cp "$engines"/*.* .
if [ "$part" = cpp ]; then
  for library in ode bullet; do pkg-config --exists "$library" || skip "no lib$library-dev"; done
  { cmake -S . -B build && cmake --build build; } > log.txt 2>&1 || { tail -n 20 log.txt; exit 1; }
  expect 0 "1.000 of the force on a box, 1.000 m/s" -- python3 "$check" right build/ode
  expect 0 "1.000 of the force on a box, 0.99" -- python3 "$check" right build/bullet
  expect 0 "1.000 of the force on a box, 1.000 m/s" -- python3 "$check" right build/bullet --fix-internal-edges
  expect 1 "expected: wrong" -- python3 "$check" wrong build/ode
else
  command -v node > /dev/null && command -v npm > /dev/null || skip "no node and npm in PATH"
  npm ci --ignore-scripts --no-audit --no-fund > log.txt 2>&1 || skip "npm ci: $(tail -n 1 log.txt)"
  while read -r expected force adapter; do
    expect 0 "$force of the force on a box" -- python3 "$check" $expected node $adapter
  done << 'END'
right 1.000 rapier.mjs 0.11
wrong 1.250 rapier.mjs 0.14
wrong 1.250 rapier.mjs 0.19
wrong 1.000 rapier.mjs 0.21
wrong 1.000 rapier.mjs 0.21 --force-events
right 1.000 rapier.mjs 0.21 --fix-internal-edges
right 1.000 physx.mjs
wrong 1.000 havok.mjs
wrong 1.000 jolt.mjs
right 1.000 jolt.mjs --fix-internal-edges
right 1.000 ammo.mjs
right 1.000 cannon.mjs
wrong 1.000 mujoco.mjs
END
  expect 0 "held: a flat plate feels flat" -- "$forceshade" conform --mesh "$examples/vectors/tetrahedron.off" --unit mm --shading none \
    --points 1000 --command "node three_mesh_bvh.mjs"
fi
echo "$checks checks"
