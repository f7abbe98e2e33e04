// SPDX-License-Identifier: BSD-3-Clause
// arguments_test.mjs INTERFACE.js: wrong_arguments.mjs over a module that computes nothing and finds every argument right, so that
// what is refused here is refused before the module sees it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
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
new Function("module", "forceshadeModule", "forceshadePacked", readFileSync(process.argv[2], "utf8"))(
  made, async () => hollow, gzipSync("").toString("base64"));

const library = await made.exports.load();
refusesWrongArguments(library, made.exports.ForceshadeError);
const other = await made.exports.load();
assert.throws(() => other.scene([library.law("wall", { stiffness: 1 })]), /^ForceshadeError: objects: expected subjects of this library, got an object$/);
assert.ok(calls > 50, `${calls} calls of the module`);
console.log(`${calls} calls of the module`);
