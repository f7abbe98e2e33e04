#!/usr/bin/env bash
# engines_test.sh FORCESHADE PART: the adapters of physics engines in examples/renderers/engines. PART is cpp (ODE and Bullet, from
# Debian's packages) or npm, whose packages are those of package-lock.json with their hashes. Exit code 77, which CTest takes for
# skipped, where something that they need is lacking.
skip() { echo "skipped: $1"; exit 77; }
part=$2
engines=$(realpath "$(dirname "$0")/../../examples/renderers/engines")
check=$(realpath "$(dirname "$0")/engine_check.py")
. "$(dirname "$0")/expect.sh"
cp "$engines"/*.* .

# fails NAMES ADAPTER: the invariants that conform finds to fail, and no others.
fails() {
  same "$1" "$("$forceshade" conform --simulator "$2" | sed -n 's/^FAILED: \([^,:]*\).*/\1/p' | paste -sd '|')"
}

if [ "$part" = cpp ]; then
  for library in ode bullet; do pkg-config --exists "$library" || skip "no lib$library-dev"; done
  { cmake -S . -B build && cmake --build build; } > log.txt 2>&1 || { tail -n 20 log.txt; exit 1; }
  nan_force="after a force that is no number and a reset" nan_vertex="a vertex that is no number"
  pushes="a flat floor pushes with what lies on it" units="millimetres and metres give the same motion"
  frames="a quarter turn of the scene turns the motion|a mirrored scene gives the mirrored motion"
  fails "$pushes|$nan_force|$nan_vertex" build/ode
  fails "$units|$nan_force|$nan_vertex" "build/ode --contact-surface-layer"
  edges="a flat floor has no ghost forces at inner edges|the normals that are reported on a flat floor are its own"
  order="other numbers of triangles and vertices change nothing"
  fails "a flat floor keeps the speed|$pushes|$edges|$frames|$order|$nan_force" build/bullet
  fails "$pushes|$units|$frames|$nan_force" "build/bullet --fix-internal-edges"
  # ODE's friction is a pyramid; the god-object's is a cone.
  course="$(dirname "$engines")/../../scripts/friction_course"
  "$course" --forceshade "$forceshade" build/ode build/bullet > friction.md
  expect 0 "| 1.0000 | 1.0000 | 0.9998 |" -- grep "^| god-object" friction.md
  expect 0 "| 1.0000 | 1.4142 | 1.0000 |" -- grep "^| ODE" friction.md
  expect 0 "| 1.0046 | 1.0029 | 1.0000 |" -- grep "^| Bullet" friction.md
else
  command -v node > /dev/null && command -v npm > /dev/null || skip "no node and npm in PATH"
  command -v python3 > /dev/null || skip "no python3 in PATH"
  npm ci --ignore-scripts --no-audit --no-fund > log.txt 2>&1 || skip "npm ci: $(tail -n 1 log.txt)"
  # --liftoff-only compiles WebAssembly in a fifth of the time; what it computes is the same.
  while read -r expected force adapter; do
    expect 0 "$force of the force on a box" -- python3 "$check" $expected node --liftoff-only $adapter
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
    --points 1000 --command "node --liftoff-only three_mesh_bvh.mjs"
fi
echo "$checks checks"
