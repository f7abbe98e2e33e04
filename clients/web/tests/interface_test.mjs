// SPDX-License-Identifier: BSD-3-Clause
// interface_test.mjs FORCES.csv: the package `forceshade`, as it is installed beside this file, gives the forces of an independent
// program bit for bit, forces of maps, meshes and scenes of which the value is known, and a clear error for each wrong argument.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { ForceshadeError, LAWS, load } from "forceshade";
import golden from "./golden.js";
import { refusesWrongArguments } from "./wrong_arguments.mjs";

const library = await load();
assert.equal(createRequire(import.meta.url)("forceshade").load, load);
assert.match(library.version, /^\d+\.\d+\.\d+$/);
assert.equal(library.has("meshes"), true);
for (const none of ["device-loop", "subject-files", "image-files", "csv-files"]) assert.equal(library.has(none), false);
assert.equal(library.arithmeticFault, null);

const bits = (values) => Array.from(new Uint32Array(Float32Array.from(values).buffer));

const { forces } = golden;
let compared = 0;
const laws = new Map();
for (const { law, radius, width, stiffness, position, force, status } of forces(process.argv[2])) {
  const key = [law, radius, width, stiffness].join();
  if (!laws.has(key)) laws.set(key, library.law(law, { radius, width, stiffness }));
  const answer = laws.get(key).force(position);
  assert.deepEqual([bits(answer.force), answer.status], [bits(force), status], `${key} at ${position}`);
  const many = laws.get(key).forces([0, 0, 1, ...position]);
  assert.deepEqual(bits(many.forces.slice(3)), bits(answer.force));
  ++compared;
}
assert.ok(compared > 1000 && new Set([...laws.keys()].map((key) => key.split(",")[0])).size === LAWS.length);

const map = library.heightMap({
  heights: [0, 0, 0, 0, 1, 0, 0, 0, 0], columns: 3, rows: 3, pitch: 4, interpolant: "bilinear", stiffness: 0.5,
});
assert.deepEqual(map.force([0, 0, 0.5]).status, "contact");
assert.equal(map.kind, "height map");

const cube = library.mesh({
  vertices: [0, 0, 0, 8, 0, 0, 8, 8, 0, 0, 8, 0, 0, 0, 8, 8, 0, 8, 8, 8, 8, 0, 8, 8],
  triangles: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7],
  shading: "none", stiffness: 0.5, materials: [{ staticFriction: 0.5, dynamicFriction: 0.25 }],
});
const path = cube.session();
assert.equal(path.step([2, 3, 10]).status, "free");
assert.deepEqual(Array.from(path.step([2, 3, 7]).force), [0, 0, 0.5]);
const state = path.state();
assert.equal(state.place, "in-triangle");
const held = path.step([2.25, 3, 7]);
assert.deepEqual(Array.from(held.force), [-0.125, 0, 0.5]); // it sticks
path.reset();
assert.equal(path.state().place, "nowhere");
path.resume(state);
assert.deepEqual(path.step([2.25, 3, 7]), held);

// Two walls that cross, which no flag allows: a hand in their corner is where both hold it.
const walls = library.mesh({
  vertices: [-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0, 0, -9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9],
  triangles: [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7], stiffness: 0.5,
});
const corner = walls.session();
corner.steps([2, 0.5, 3, -1, 0.5, -2]);
const meets = corner.state();
assert.equal(meets.meeting, "line");
assert.deepEqual(Array.from(corner.step([-1, 0.5, -2]).force), [0.5, 0, 1]);
corner.reset();
corner.resume(meets);
assert.deepEqual(Array.from(corner.step([-1, 0.5, -2]).force), [0.5, 0, 1]);

const scene = library.scene([cube, map]);
const poses = [{ translation: [0, 0, 0], rotation: [1, 0, 0, 0] }, { translation: [50, 0, 0], rotation: [1, 0, 0, 0] }];
scene.step([2, 3, 10], poses);
assert.deepEqual(Array.from(scene.step([2, 3, 7], poses).force), [0, 0, 0.5]);
assert.deepEqual(Array.from(scene.object(0).force), [0, 0, 0.5]);
assert.equal(scene.object(1).status, "free");

const wall = library.law("wall", { stiffness: 1 });
assert.equal(wall.force([NaN, 0, 0]).status, "invalid");
const closed = library.law("wall", { stiffness: 1 });
closed.close();
closed.close();
for (const [result, words, call] of [
  ["BAD_VALUE", /stiffness is -1 N\/mm; expected 0\.001 to 1000/, () => library.law("wall", { stiffness: -1 })],
  ["WRONG_KIND", /./, () => cube.force([0, 0, 0])],
  ["BAD_HANDLE", /this subject is closed/, () => closed.force([0, 0, 0])],
])
  assert.throws(call, (error) => error instanceof ForceshadeError && error.result === result && words.test(error.message), String(call));
const oil = library.damping({ rate: 1000, damping: 0.002 }), floor = library.law("wall", { stiffness: 0.5 });
const damped = (position, periods) => oil.step(position, floor.force(position), periods);
assert.equal(damped([0, 0, 0]).status, "free");
assert.deepEqual(Array.from(damped([0, 0, -0.125]).force), [0, 0, 0.125]); // at 125 mm/s: twice the spring's
const speed = oil.state();
assert.deepEqual(speed, { position: [0, 0, -0.125], velocity: [0, 0, -125], periods: 0 });
assert.deepEqual(damped([0, 0, -0.0625]), { force: new Float32Array(3), status: "contact" }); // it lets go
assert.deepEqual(Array.from(damped([0, 0, -0.0625], 17).force), [0, 0, 0.03125]); // so late that no speed is known
oil.resume(speed);
const two = oil.steps([0, 0, -0.0625, 0, 0, 1], { forces: [0, 0, 0.03125, 0, 0, 0], statuses: [1, 0] });
assert.deepEqual([Array.from(two.forces), Array.from(two.statuses)], [[0, 0, 0, 0, 0, 0], [1, 0]]);
oil.reset();
assert.equal(oil.state().position, null);
assert.throws(() => library.damping({ rate: 0 }), /^ForceshadeError: rate is 0 Hz; expected 1 to 131072 Hz$/);
assert.equal(library.has("damping"), true);

refusesWrongArguments(library, ForceshadeError);

// Memory is given back: 2 GB would not hold these.
for (let i = 0; i < 3000; ++i) {
  const one = library.law("bump-1p", { stiffness: 1 });
  const its = one.session();
  its.steps(new Float32Array(3 * 30000));
  its.close();
  one.close();
}
console.log(`${compared} forces of an independent program, 0 differ`);
