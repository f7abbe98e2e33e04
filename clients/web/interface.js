// SPDX-License-Identifier: BSD-3-Clause
// The module's interface for programs in JavaScript: package/forceshade.d.ts describes it. It stands behind the module's own code and
// arguments.js in one file, a classic script, which works in node, in a page from a server and in one from `file:`.
(function (root) {
  "use strict";

  const LAWS = ["wall", "cylinder", "bump-cylinder", "bump-1p", "bump-2p", "bump-3p", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"];
  const STATUSES = ["free", "contact", "invalid", "unfinished"];
  const PLACES = ["nowhere", "in-the-open", "at-vertex", "on-edge", "in-triangle"];
  const SIDES = ["front", "back"];
  const MEETINGS = ["nothing", "line", "edge", "triangle", "triangles", "foot-in-triangle", "foot-on-edge", "foot-on-line"];
  const HANDLE = 8; // bytes
  const KIND = 0, NAME = 1, PARAMETERS = 2;

  const { ForceshadeError, got, badValue, known, number, text, optionalText, oneOf, flag, list, floats, indices } = forceshadeArguments;

  // The memory of the module, where arguments and answers lie.
  class Memory {
    constructor(module) {
      this.module = module;
    }

    check(result) {
      if (result === 0) return;
      const name = this.text(this.module._forceshade_name_of_result(result));
      throw new ForceshadeError(name, (this.text(this.module._forceshade_message()) || name).trimEnd());
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
          const address = this.room(size);
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

    // The address of so many bytes, of which the module would take the lowest 32 bits.
    room(size) {
      const address = size <= 0xffffffff ? this.module._malloc(Math.max(size, 8)) : 0;
      if (address === 0) throw new ForceshadeError("NO_MEMORY", `no memory for ${size} bytes`);
      return address;
    }

    floats(address, count) {
      return new Float32Array(this.module.HEAPU8.buffer, address, count).slice();
    }

    // A handle, at an address of its own, that this call makes.
    handle(make) {
      const address = this.room(HANDLE);
      try {
        this.check(make(address));
      } catch (error) {
        this.module._free(address);
        throw error;
      }
      return address;
    }
  }

  // A subject, session or scene: a handle, and room for the three floats of a position and of a force and for a status. No property
  // can be enumerated, since JSON and the console would write the whole memory of the module.
  class Held {
    constructor(memory, address, free) {
      Object.defineProperties(this, { _memory: { value: memory }, _free: { value: free }, _at: { value: address, writable: true },
                                      _room: { value: memory.room(28) } });
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
    get _word() {
      return "subject";
    }

    force(position) {
      return this._one(position, (at, from, to, status) => this._memory.module._web_forces(at, 1, from, to, status));
    }

    forces(positions) {
      return this._many(positions, this._memory.module._web_forces);
    }

    session() {
      const { module } = this._memory, address = this._memory.handle((made) => module._web_session_open(this._handle, made));
      return new Session(this._memory, address, module._web_session_close);
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
    get _word() {
      return "session";
    }

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
      return memory.lend([{ bytes: 120 }], (address) => {
        memory.check(memory.module._web_session_state(this._handle, address));
        const all = Array.from(new Float64Array(memory.module.HEAPU8.buffer, address, 15));
        return { place: PLACES[all[0]], side: SIDES[all[1]], slipping: all[2] === 1, position: all.slice(3, 6),
                 index: all.slice(6, 8), parameter: all.slice(8, 10), meeting: MEETINGS[all[10]], further: all.slice(11, 13),
                 cell: all.slice(13, 15) };
      });
    }

    resume(state) {
      const names = ["place", "side", "slipping", "position", "index", "parameter", "meeting", "further", "cell"];
      known("state", state, names, "a state, as state() answers it");
      // One that was kept before meshes could be irregular has no further members.
      const { meeting = MEETINGS[0], further = [0, 0], cell = [0, 0] } = state, its = { ...state, meeting, further, cell };
      const pairs = (...keys) => keys.flatMap((key) => Array.from(indices(key, floats(key, its[key], 2))));
      const all = [oneOf("place", its.place, PLACES), oneOf("side", its.side, SIDES), flag("slipping", its.slipping) ? 1 : 0,
                   ...floats("position", its.position, 3), ...pairs("index", "parameter"), oneOf("meeting", its.meeting, MEETINGS),
                   ...pairs("further", "cell")];
      this._memory.lend([{ Type: Float64Array, values: all }], (address) => {
        this._memory.check(this._memory.module._web_session_resume(this._handle, address));
      });
    }
  }

  class Scene extends Held {
    get _word() {
      return "scene";
    }

    step(position, poses) {
      const all = list("poses", poses).flatMap((pose) => {
        const { translation, rotation } = known("pose", pose, ["translation", "rotation"], "an object with translation and rotation");
        return [...floats("translation", translation, 3), ...floats("rotation", rotation, 4)];
      });
      return this._memory.lend([{ Type: Float32Array, values: all }], (its) =>
        this._one(position, (at, from, to, status) => this._memory.module._web_scene_step(at, from, its, poses.length, to, status)));
    }

    object(index) {
      const [object] = indices("object", [index]);
      return this._answer((to, status) => this._memory.module._web_scene_object(this._handle, object, to, status));
    }
  }

  // No object of the module: the parameters are numbers of each call, and the state of its path lies here.
  class Damping {
    constructor(memory, numbers) {
      Object.defineProperties(this, { _memory: { value: memory }, _numbers: { value: numbers }, _state: { value: new Float32Array(8) } });
      this.steps([], { forces: [], statuses: [] }); // looks at the numbers
    }

    step(position, answer, periods = 1) {
      const { force, status } = known("answer", answer, ["force", "status"], "a force with its status, as step() answers them");
      const one = { forces: floats("force", force, 3), statuses: [oneOf("status", status, STATUSES)] };
      const { forces, statuses } = this.steps(floats("position", position, 3), one, [periods]);
      return { force: forces, status: STATUSES[statuses[0]] };
    }

    steps(positions, answers, periods) {
      const names = ["forces", "statuses"], count = floats("positions", positions).length / 3, memory = this._memory;
      const { forces, statuses } = known("answers", answers, names, "forces with their statuses, as steps() answers them");
      const since = periods === undefined ? null : { Type: Uint32Array, values: indices("periods", floats("periods", periods, count)) };
      const values = [{ Type: Float32Array, values: this._numbers }, { Type: Float32Array, values: this._state }, since,
                      { Type: Float32Array, values: positions }, { Type: Float32Array, values: floats("forces", forces, 3 * count) },
                      { Type: Uint8Array, values: indices("statuses", floats("statuses", statuses, count), STATUSES.length - 1) }];
      return memory.lend(values, (numbers, state, each, from, to, said) => {
        memory.check(memory.module._web_damping_steps(numbers, state, each, count, from, to, said));
        this._state.set(memory.floats(state, 8));
        return { forces: memory.floats(to, 3 * count), statuses: memory.module.HEAPU8.slice(said, said + count) };
      });
    }

    reset() {
      this._state.fill(0);
    }

    state() {
      const [hasPosition, periods, ...all] = this._state;
      return { position: hasPosition === 1 ? all.slice(0, 3) : null, velocity: all.slice(3), periods };
    }

    resume(state) {
      known("state", state, ["position", "velocity", "periods"], "a state, as state() answers it");
      const { position, velocity } = state, [periods] = indices("periods", [state.periods]);
      const at = position === null ? [0, 0, 0] : Array.from(floats("position", position, 3));
      this._state.set([position === null ? 0 : 1, Math.min(periods, 255), ...at, ...Array.from(floats("velocity", velocity, 3))]);
    }
  }

  class Library {
    constructor(module) {
      Object.defineProperty(this, "_memory", { value: new Memory(module) });
      this.laws = LAWS.slice();
    }

    get version() {
      const packed = this._memory.module._forceshade_version();
      return [packed >>> 16, (packed >>> 8) & 255, packed & 255].join(".");
    }

    // True for the features of this package, in which no function reads a file, although the library has some that do.
    has(feature) {
      if (text("feature", feature) === "subject-files") return false;
      const { module } = this._memory;
      return this._memory.lend([feature], (text) => module._forceshade_has(text) === 1);
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
      oneOf("law", name, LAWS);
      const { radius = 15.24, width = 25.4, stiffness } =
        known(`law ${name}`, options, ["radius", "width", "stiffness"], "options with stiffness");
      const numbers = [number("radius", radius), number("width", width), number("stiffness", stiffness)];
      return this._subject([name], ([law], made) => this._memory.module._web_law(law, ...numbers, made));
    }

    heightMap(options) {
      const names = ["heights", "columns", "rows", "pitch", "interpolant", "edge", "render", "stiffness"];
      const { heights, columns, rows, pitch, interpolant, edge, render, stiffness } =
        known("height map", options, names, "options with heights, columns, rows, pitch and stiffness");
      indices("columns", [columns]);
      indices("rows", [rows]);
      const values = [{ Type: Float32Array, values: floats("heights", heights, columns * rows) }, optionalText("interpolant", interpolant),
                      optionalText("edge", edge), optionalText("render", render)];
      const numbers = [number("pitch", pitch), number("stiffness", stiffness)];
      return this._subject(values, ([samples, its, beyond, rendered], made) =>
        this._memory.module._web_height_map(samples, columns, rows, numbers[0], its, beyond, rendered, numbers[1], made));
    }

    mesh(options) {
      const names = ["vertices", "triangles", "sides", "shading", "contact", "crease", "stiffness", "selfIntersecting", "materials",
                     "materialOfTriangle"];
      const { vertices, triangles, sides, shading, contact, crease = 180, stiffness, selfIntersecting = false, materials = [],
              materialOfTriangle } = known("mesh", options, names, "options with vertices, triangles and stiffness");
      const corners = { Type: Float32Array, values: floats("vertices", vertices) };
      const faces = { Type: Uint32Array, values: indices("triangles", floats("triangles", triangles)) };
      const of = materialOfTriangle === undefined ? null : { Type: Uint32Array, values:
        indices("materialOfTriangle", floats("materialOfTriangle", materialOfTriangle, triangles.length / 3)) };
      if (of !== null && materials.length === 0) throw badValue("materialOfTriangle", "materials beside it", "none");
      const numbersOf = list("materials", materials).flatMap((material) => {
        const names = ["stiffness", "staticFriction", "dynamicFriction"];
        const { stiffness: own = 0, staticFriction = 0, dynamicFriction = 0 } =
          known("material", material, names, `an object with ${names.join(", ")}`);
        return [number("stiffness", own), number("staticFriction", staticFriction), number("dynamicFriction", dynamicFriction)];
      });
      const values = [corners, faces, optionalText("sides", sides), optionalText("shading", shading), optionalText("contact", contact),
                      { Type: Float32Array, values: numbersOf }, of];
      const crosses = flag("selfIntersecting", selfIntersecting) ? 1 : 0;
      const numbers = [number("crease", crease), number("stiffness", stiffness)];
      return this._subject(values, ([points, its, which, scheme, rule, all, ofEach], made) =>
        this._memory.module._web_mesh(points, vertices.length / 3, its, triangles.length / 3, which, scheme, rule, ...numbers, crosses, all,
                                      materials.length, ofEach, made));
    }

    damping(options) {
      const names = ["rate", "share", "damping", "most", "drag", "fullAt"];
      const { rate, share = 1, damping = 0, most = 2, drag = 0, fullAt = 0.25 } = known("damping", options, names, "options with rate");
      const numbers = Object.entries({ rate, share, damping, most, drag, fullAt });
      return new Damping(this._memory, numbers.map(([name, value]) => number(name, value)));
    }

    scene(objects) {
      const memory = this._memory;
      for (const object of list("objects", objects))
        if (!(object instanceof Subject) || object._memory !== memory) throw badValue("objects", "subjects of this library", got(object));
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
