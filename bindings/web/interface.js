// SPDX-License-Identifier: BSD-3-Clause
// What a program in JavaScript sees of the module: package/forceshade.d.ts describes it. It stands behind the module's own code in
// one file, a classic script, which works in node, in a page from a server and in one from `file:`.
(function (root) {
  "use strict";

  const LAWS = ["wall", "cylinder", "bump-cylinder", "bump-1p", "bump-2p", "bump-3p", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"];
  const STATUSES = ["free", "contact", "invalid", "unfinished"];
  const PLACES = ["nowhere", "in-the-open", "at-vertex", "on-edge", "in-triangle"];
  const HANDLE = 8; // bytes
  const KIND = 0, NAME = 1, PARAMETERS = 2;

  class ForceshadeError extends Error {
    constructor(result, message) {
      super(message);
      this.name = "ForceshadeError";
      this.result = result;
    }
  }

  const badValue = (what, expected, got) => new ForceshadeError("BAD_VALUE", `${what}: expected ${expected}, got ${String(got)}`);

  function known(what, options, names) {
    for (const name of Object.keys(options))
      if (!names.includes(name)) throw badValue(what, `some of ${names.join(", ")}`, name);
    return options;
  }

  function number(what, value) {
    if (typeof value !== "number") throw badValue(what, "a number", value);
    return value;
  }

  function floats(what, values, count) {
    const is_list = Array.isArray(values) || (ArrayBuffer.isView(values) && typeof values.length === "number");
    if (!is_list || (count !== undefined && values.length !== count) || (count === undefined && values.length % 3 !== 0))
      throw badValue(what, count === undefined ? "three numbers for each" : `${count} numbers`, is_list ? `${values.length} numbers` : values);
    for (let i = 0; i < values.length; ++i) number(what, values[i]);
    return values;
  }

  // Numbers from 0, of which WebAssembly would otherwise take the lowest 32 bits.
  function indices(what, values) {
    for (const value of values)
      if (!Number.isInteger(value) || value < 0 || value > 0xffffffff) throw badValue(what, "whole numbers from 0", value);
    return values;
  }

  // The memory of the module, where arguments and answers lie.
  class Memory {
    constructor(module) {
      this.module = module;
    }

    check(result) {
      if (result === 0) return;
      const name = this.text(this.module._forceshade_name_of_result(result));
      throw new ForceshadeError(name, this.text(this.module._forceshade_message()) || name);
    }

    text(address) {
      return address === 0 ? null : this.module.UTF8ToString(address);
    }

    // Calls back with the addresses of what these values are copied to: a text, an array of numbers with its type, or so many bytes.
    // Null stays 0.
    lend(values, use) {
      const taken = [];
      try {
        const addresses = values.map((value) => {
          if (value === null || value === undefined) return 0;
          const { Type, bytes } = value;
          const text = typeof value === "string" ? new TextEncoder().encode(value + "\0") : null;
          const size = text ? text.length : Type ? value.values.length * Type.BYTES_PER_ELEMENT : bytes;
          const address = this.module._malloc(Math.max(size, 8));
          if (address === 0) throw new ForceshadeError("NO_MEMORY", `no memory for ${size} bytes`);
          taken.push(address);
          if (text) this.module.HEAPU8.set(text, address);
          else if (Type) new Type(this.module.HEAPU8.buffer, address, value.values.length).set(value.values);
          else this.module.HEAPU8.fill(0, address, address + bytes);
          return address;
        });
        return use(...addresses);
      } finally {
        for (const address of taken) this.module._free(address);
      }
    }

    floats(address, count) {
      return new Float32Array(this.module.HEAPU8.buffer, address, count).slice();
    }

    // A handle, at an address of its own, that this call makes.
    handle(make) {
      const address = this.module._malloc(HANDLE);
      if (address === 0) throw new ForceshadeError("NO_MEMORY", "no memory for a handle");
      try {
        this.check(make(address));
      } catch (error) {
        this.module._free(address);
        throw error;
      }
      return address;
    }
  }

  // A subject, session or scene: a handle, and room for the three floats of a position and of a force and for a status.
  class Held {
    constructor(memory, address, free) {
      this._memory = memory;
      this._at = address;
      this._free = free;
      this._room = memory.module._malloc(28);
    }

    get _handle() {
      if (this._at === 0) throw new ForceshadeError("BAD_HANDLE", `this ${this._word} is closed`);
      return this._at;
    }

    // The force and status of one position, by a call that gets the addresses of position, force and status.
    _one(position, call) {
      floats("position", position, 3);
      const at = this._handle;
      this._memory.module.HEAPF32.set(position, this._room >> 2);
      return this._answer((force, status) => call(at, this._room, force, status));
    }

    _answer(call) {
      const { module } = this._memory;
      this._memory.check(call(this._room + 12, this._room + 24));
      const begin = (this._room >> 2) + 3;
      return { force: module.HEAPF32.slice(begin, begin + 3), status: STATUSES[module.HEAPU8[this._room + 24]] };
    }

    _many(positions, call) {
      floats("positions", positions);
      const at = this._handle;
      const count = positions.length / 3;
      const memory = this._memory;
      return memory.lend([{ Type: Float32Array, values: positions }, { bytes: 12 * count }, { bytes: count }], (from, to, statuses) => {
        memory.check(call(at, count, from, to, statuses));
        return { forces: memory.floats(to, 3 * count), statuses: memory.module.HEAPU8.slice(statuses, statuses + count) };
      });
    }

    close() {
      if (this._at === 0) return;
      this._memory.check(this._free(this._at));
      this._memory.module._free(this._at);
      this._memory.module._free(this._room);
      this._at = 0;
    }
  }

  class Subject extends Held {
    _word = "subject";

    force(position) {
      return this._one(position, (at, from, to, status) => this._memory.module._web_forces(at, 1, from, to, status));
    }

    forces(positions) {
      return this._many(positions, this._memory.module._web_forces);
    }

    session() {
      const { module } = this._memory;
      return new Session(this._memory, this._memory.handle((made) => module._web_session_open(this._handle, made)), module._web_session_close);
    }

    _text(what) {
      const memory = this._memory;
      return memory.lend([{ bytes: 1024 }], (text) => {
        memory.check(memory.module._web_subject_text(this._handle, what, text, 1024, 0));
        return memory.text(text);
      });
    }
    get kind() {
      return this._text(KIND);
    }
    get name() {
      return this._text(NAME);
    }
    get parameters() {
      return this._text(PARAMETERS);
    }
  }

  class Session extends Held {
    _word = "session";

    step(position) {
      return this._one(position, (at, from, to, status) => this._memory.module._web_session_steps(at, 1, from, to, status));
    }

    steps(positions) {
      return this._many(positions, this._memory.module._web_session_steps);
    }

    reset() {
      this._memory.check(this._memory.module._web_session_reset(this._handle));
    }

    state() {
      const memory = this._memory;
      return memory.lend([{ bytes: 80 }], (address) => {
        memory.check(memory.module._web_session_state(this._handle, address));
        const all = Array.from(new Float64Array(memory.module.HEAPU8.buffer, address, 10));
        return {
          place: PLACES[all[0]],
          side: all[1] === 0 ? "front" : "back",
          slipping: all[2] === 1,
          position: all.slice(3, 6),
          index: all.slice(6, 8),
          parameter: all.slice(8, 10),
        };
      });
    }

    resume(state) {
      const place = PLACES.indexOf(state.place);
      if (place < 0) throw badValue("place", `one of ${PLACES.join(", ")}`, state.place);
      const all = [place, state.side === "back" ? 1 : 0, state.slipping ? 1 : 0, ...floats("position", state.position, 3),
                   ...indices("index", floats("index", state.index, 2)), ...indices("parameter", floats("parameter", state.parameter, 2))];
      this._memory.lend([{ Type: Float64Array, values: all }], (address) => {
        this._memory.check(this._memory.module._web_session_resume(this._handle, address));
      });
    }
  }

  class Scene extends Held {
    _word = "scene";

    step(position, poses) {
      const all = poses.flatMap((pose) => [...floats("translation", pose.translation, 3), ...floats("rotation", pose.rotation, 4)]);
      return this._memory.lend([{ Type: Float32Array, values: all }], (its) =>
        this._one(position, (at, from, to, status) => this._memory.module._web_scene_step(at, from, its, poses.length, to, status)));
    }

    object(index) {
      const [object] = indices("object", [index]);
      return this._answer((to, status) => this._memory.module._web_scene_object(this._handle, object, to, status));
    }
  }

  class Library {
    constructor(module) {
      this._memory = new Memory(module);
      this.laws = LAWS.slice();
    }

    get version() {
      const packed = this._memory.module._forceshade_version();
      return [packed >>> 16, (packed >>> 8) & 255, packed & 255].join(".");
    }

    // Of this package, in which no function reads a file, although the library has those that do.
    has(feature) {
      if (feature === "subject-files") return false;
      const { module } = this._memory;
      return this._memory.lend([String(feature)], (text) => module._forceshade_has(text) === 1);
    }

    get arithmeticFault() {
      return this._memory.text(this._memory.module._forceshade_arithmetic_fault());
    }

    _subject(values, make) {
      const memory = this._memory;
      const address = memory.lend(values, (...addresses) => memory.handle((made) => make(addresses, made)));
      return new Subject(memory, address, memory.module._web_subject_free);
    }

    law(name, options) {
      const { radius = 15.24, width = 25.4, stiffness } = known(`law ${name}`, options, ["radius", "width", "stiffness"]);
      const numbers = [number("radius", radius), number("width", width), number("stiffness", stiffness)];
      return this._subject([String(name)], ([law], made) => this._memory.module._web_law(law, ...numbers, made));
    }

    heightMap(options) {
      const names = ["heights", "columns", "rows", "pitch", "interpolant", "edge", "render", "stiffness"];
      const { heights, columns, rows, pitch, interpolant, edge, render, stiffness } = known("height map", options, names);
      indices("columns and rows", [columns, rows]);
      const values = [{ Type: Float32Array, values: floats("heights", heights, columns * rows) }, interpolant, edge, render];
      const numbers = [number("pitch", pitch), number("stiffness", stiffness)];
      return this._subject(values, ([samples, its, beyond, rendered], made) =>
        this._memory.module._web_height_map(samples, columns, rows, numbers[0], its, beyond, rendered, numbers[1], made));
    }

    mesh(options) {
      const names = ["vertices", "triangles", "sides", "shading", "contact", "crease", "stiffness", "selfIntersecting", "materials", "materialOfTriangle"];
      const { vertices, triangles, sides, shading, contact, crease = 180, stiffness, selfIntersecting = false, materials = [],
              materialOfTriangle } = known("mesh", options, names);
      floats("vertices", vertices);
      indices("triangles", floats("triangles", triangles));
      if (materialOfTriangle) indices("materialOfTriangle", floats("materialOfTriangle", materialOfTriangle, triangles.length / 3));
      const list = materials.flatMap((material) => {
        const { stiffness: own = 0, staticFriction = 0, dynamicFriction = 0 } = known("material", material, ["stiffness", "staticFriction", "dynamicFriction"]);
        return floats("material", [own, staticFriction, dynamicFriction], 3);
      });
      const of = materialOfTriangle && { Type: Uint32Array, values: materialOfTriangle };
      const values = [{ Type: Float32Array, values: vertices }, { Type: Uint32Array, values: triangles }, sides, shading, contact,
                      { Type: Float32Array, values: list }, of];
      const numbers = [number("crease", crease), number("stiffness", stiffness)];
      return this._subject(values, ([corners, faces, which, scheme, rule, all, its], made) =>
        this._memory.module._web_mesh(corners, vertices.length / 3, faces, triangles.length / 3, which, scheme, rule, ...numbers,
                                      selfIntersecting ? 1 : 0, all, materials.length, its, made));
    }

    scene(objects) {
      const memory = this._memory;
      const { module } = memory;
      const address = memory.lend([{ bytes: HANDLE * objects.length }], (handles) => {
        objects.forEach((object, i) => module.HEAPU8.copyWithin(handles + HANDLE * i, object._handle, object._handle + HANDLE));
        return memory.handle((made) => module._web_scene_open(handles, objects.length, made));
      });
      return new Scene(memory, address, module._web_scene_close);
    }
  }

  // The module, of a third of its size: a page of less than 1 MB has room for it.
  async function unpacked() {
    const packed = Uint8Array.from(atob(forceshadePacked), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  async function load() {
    return new Library(await forceshadeModule({ wasmBinary: await unpacked() }));
  }

  const library = { load, ForceshadeError, LAWS: Object.freeze(LAWS) };
  if (typeof module === "object" && module.exports) module.exports = library;
  else root.forceshade = library;
})(globalThis);
