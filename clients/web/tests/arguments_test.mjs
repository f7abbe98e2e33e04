// SPDX-License-Identifier: BSD-3-Clause
// arguments_test.mjs FOLDER: with its interface.js, wrong_arguments.mjs over a module that computes nothing and finds every argument right, so that
// what is refused here is refused before the module sees it; and what that module is given and answers is what a program gives and gets.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { refusesWrongArguments } from "./wrong_arguments.mjs";

const buffer = new ArrayBuffer(1 << 22);
let used = 8, calls = 0;
const own = {
  then: undefined, // it is no promise
  HEAPU8: new Uint8Array(buffer),
  HEAPF32: new Float32Array(buffer),
  UTF8ToString: () => "",
  _free: () => {},
  _malloc: (size) => {
    assert.ok(Number.isInteger(size) && size > 0, `a size of ${size}`);
    size >>>= 0; // as WebAssembly takes it
    if (size > buffer.byteLength / 2) return 0;
    const address = used + size > buffer.byteLength ? 8 : used; // by then what was lent is done with
    used = address + ((size + 7) & ~7);
    return address;
  },
};
function call(...words) {
  ++calls;
  for (const word of words) assert.equal(typeof word, "number");
  return 0;
}
const hollow = new Proxy(own, { get: (_, name) => (name in own ? own[name] : call) });
const made = { exports: {} };
const source = (name) => readFileSync(join(process.argv[2], name), "utf8");
new Function("module", "forceshadeModule", "forceshadePacked", source("arguments.js") + source("interface.js"))(
  made, async () => hollow, gzipSync("").toString("base64"));

// What the module writes to where the interface has room for it: the numbers of a state, which differ.
const held = [3, 1, 1, 0.5, -2, 8, 0xffffffff, 7, 0xfffffffe, 5, 2, 0xfffffffd, 9, 0xfffffffc, 11], floats = (address, count) => new Float32Array(buffer, address, count);
let resumed = null, damped = null;
const answers = (handle, count, from, to, statuses) => {
  for (let i = 0; i < count; ++i) own.HEAPU8[statuses + i] = i % 4;
  floats(to, 3 * count).set(floats(from, 3 * count).map((number) => -number));
  return 0;
};
Object.assign(own, {
  _web_forces: answers,
  _web_session_steps: answers,
  _web_session_state: (handle, address) => (new Float64Array(buffer, address, 15).set(held), 0),
  _web_session_resume: (handle, address) => ((resumed = Array.from(new Float64Array(buffer, address, 15))), 0),
  _web_damping_steps: (numbers, state, periods, count, from, to, statuses) => {
    damped = [numbers, state].map((address, i) => Array.from(floats(address, 6 + 2 * i)));
    if (count > 0) floats(state, 8).set([1, 17, 1, 2, 3, -4, 5, 6]);
    return answers(null, count, to, to, statuses);
  },
  _forceshade_version: () => 0x0102_0304,
});

const library = await made.exports.load();
refusesWrongArguments(library, made.exports.ForceshadeError);
const other = await made.exports.load();
assert.throws(() => other.scene([library.law("wall", { stiffness: 1 })]),
  /^ForceshadeError: objects: expected subjects of this library, got an object$/);

const wall = library.law("wall", { stiffness: 1 }), path = wall.session(), at = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
for (const { forces, statuses } of [wall.forces(at), path.steps(at)]) {
  assert.deepEqual(Array.from(forces), at.map((number) => -number));
  assert.deepEqual(Array.from(statuses), [0, 1, 2, 3]);
}
const state = path.state();
assert.deepEqual(state, { place: "on-edge", side: "back", slipping: true, position: [0.5, -2, 8], index: [0xffffffff, 7],
  parameter: [0xfffffffe, 5], meeting: "edge", further: [0xfffffffd, 9], cell: [0xfffffffc, 11] });
path.resume(state);
assert.deepEqual(resumed, held);
const { meeting, further, cell, ...former } = state;
path.resume(former);
assert.deepEqual(resumed, [...held.slice(0, 10), 0, 0, 0, 0, 0]);
const oil = library.damping({ rate: 500, damping: 2, fullAt: 8, most: Infinity });
assert.deepEqual(damped, [[500, 1, 2, Infinity, 0, 8], [0, 0, 0, 0, 0, 0, 0, 0]]);
assert.deepEqual(oil.state(), { position: null, velocity: [0, 0, 0], periods: 0 });
const { forces, statuses } = oil.steps([1, 2, 3, 4, 5, 6], { forces: [7, 8, 9, 10, 11, 12], statuses: [0, 0] }, [1, 4294967295]);
assert.deepEqual([Array.from(forces), Array.from(statuses)], [[-7, -8, -9, -10, -11, -12], [0, 1]]);
const speed = oil.state();
assert.deepEqual(speed, { position: [1, 2, 3], velocity: [-4, 5, 6], periods: 17 });
oil.reset();
assert.deepEqual(oil.step([1, 2, 3], { force: [4, 5, 6], status: "contact" }), { force: new Float32Array([-4, -5, -6]), status: "free" });
assert.deepEqual(damped[1], [0, 0, 0, 0, 0, 0, 0, 0]);
oil.resume({ ...speed, periods: 3 });
oil.steps([], { forces: [], statuses: [] });
assert.deepEqual(damped[1], [1, 3, 1, 2, 3, -4, 5, 6]);
assert.equal(library.version, "258.3.4");
assert.throws(() => library._memory.room(2 ** 32 + 8), /^ForceshadeError: no memory for 4294967304 bytes$/);
assert.ok(calls > 50, `${calls} calls of the module`);
console.log(`${calls} calls of the module`);
