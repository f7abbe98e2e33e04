// SPDX-License-Identifier: BSD-3-Clause
// Every kind of value in the place of every argument of a library: each is taken, or refused by a ForceshadeError in words. The
// library is that of the package, or interface.js over a module that computes nothing.
import assert from "node:assert/strict";

const VALUES = [undefined, null, 3, -1, 0.5, NaN, "x", "", "wall\0", true, Symbol("s"), 1n, {}, [], [1, 2, "3"], [[1, 2, 3]], () => 0,
                new Date(0), Object.create(null), new Map(), new DataView(new ArrayBuffer(12)), new BigInt64Array(3), { length: 3 },
                { length: 1e9 }, { length: 3e9 }, new BigInt64Array(0), transferred(), new Array(2)];

function transferred() {
  const values = new Float32Array(9);
  structuredClone(values.buffer, { transfer: [values.buffer] });
  return values;
}

export function refusesWrongArguments(library, ForceshadeError) {
  const law = (options) => library.law("wall", { stiffness: 1, ...options });
  const map = (options) => library.heightMap({ heights: new Float32Array(9), columns: 3, rows: 3, pitch: 4, stiffness: 1, ...options });
  const mesh = (options) =>
    library.mesh({ vertices: [0, 0, 0, 8, 0, 0, 0, 8, 0], triangles: [0, 1, 2], stiffness: 1, ...options });
  const wall = law(), path = wall.session(), scene = library.scene([wall]);
  const oil = library.damping({ rate: 1000, damping: 0.002 }), answer = { force: [0, 0, 1], status: "contact" };
  const speed = { position: [0, 0, 0], velocity: [0, 0, 0], periods: 0 }, answers = { forces: [0, 0, 1], statuses: [1] };
  const pose = { translation: [0, 0, 0], rotation: [1, 0, 0, 0] };
  const state = { place: "nowhere", side: "front", slipping: false, position: [0, 0, 0], index: [0, 0], parameter: [0, 0] };

  for (const [what, call] of Object.entries({
    law: (value) => library.law(value, { stiffness: 1 }),
    "law's options": (value) => library.law("wall", value),
    "law's numbers": (value) => [law({ radius: value }), law({ width: value }), law({ stiffness: value })],
    "height map": (value) => library.heightMap(value),
    heights: (value) => map({ heights: value }), columns: (value) => map({ columns: value }), rows: (value) => map({ rows: value }),
    pitch: (value) => map({ pitch: value }), interpolant: (value) => map({ interpolant: value }), edge: (value) => map({ edge: value }),
    render: (value) => map({ render: value }),
    mesh: (value) => library.mesh(value),
    vertices: (value) => mesh({ vertices: value }), triangles: (value) => mesh({ triangles: value }),
    sides: (value) => mesh({ sides: value }),
    shading: (value) => mesh({ shading: value }), contact: (value) => mesh({ contact: value }), crease: (value) => mesh({ crease: value }),
    crossing: (value) => mesh({ selfIntersecting: value }), materials: (value) => mesh({ materials: value }),
    "one material": (value) => mesh({ materials: [value] }), friction: (value) => mesh({ materials: [{ staticFriction: value }] }),
    "their triangles": (value) => mesh({ materials: [{}], materialOfTriangle: value }),
    scene: (value) => library.scene(value), "scene's object": (value) => library.scene([value]),
    feature: (value) => library.has(value),
    position: (value) => wall.force(value), coordinate: (value) => wall.force([0, value, 0]), positions: (value) => wall.forces(value),
    "position of a step": (value) => path.step(value), steps: (value) => path.steps(value), state: (value) => path.resume(value),
    ...Object.fromEntries(Object.keys(state).map((key) => [`state's ${key}`, (value) => path.resume({ ...state, [key]: value })])),
    poses: (value) => scene.step([0, 0, 0], value), pose: (value) => scene.step([0, 0, 0], [value]),
    translation: (value) => scene.step([0, 0, 0], [{ ...pose, translation: value }]),
    rotation: (value) => scene.step([0, 0, 0], [{ ...pose, rotation: value }]),
    object: (value) => scene.object(value),
    damping: (value) => library.damping(value), rate: (value) => library.damping({ rate: value }),
    "position of a damped step": (value) => oil.step(value, answer), answer: (value) => oil.step([0, 0, 0], value),
    "answer's force": (value) => oil.step([0, 0, 0], { ...answer, force: value }),
    "answer's status": (value) => oil.step([0, 0, 0], { ...answer, status: value }),
    "a period": (value) => oil.step([0, 0, 0], answer, value), periods: (value) => oil.steps([0, 0, 0], answers, value),
    "damped positions": (value) => oil.steps(value, answers), answers: (value) => oil.steps([0, 0, 0], value),
    "damped forces": (value) => oil.steps([0, 0, 0], { ...answers, forces: value }),
    "their statuses": (value) => oil.steps([0, 0, 0], { ...answers, statuses: value }),
    ...Object.fromEntries(Object.keys(speed).map((key) => [`speed's ${key}`, (value) => oil.resume({ ...speed, [key]: value })])),
    speed: (value) => oil.resume(value),
  }))
    for (const value of VALUES)
      try {
        call(value);
      } catch (error) {
        assert.ok(error instanceof ForceshadeError, `${what}: ${typeof value}: ${error.stack}`);
        assert.match(error.result, /^[A-Z_]+$/);
        assert.ok(error.message.length > 0 && error.message.length < 300 && !error.message.includes("\0"), error.message);
      }

  // Where WebAssembly takes the lowest 32 bits of a number; the largest that these hold is no matter of the range.
  const wholeNumbers = () => [
    ["triangles", (value) => mesh({ triangles: [0, 1, value] })],
    ["materialOfTriangle", (value) => mesh({ materials: [{}], materialOfTriangle: [value] })],
    ["columns", (value) => map({ columns: value })],
    ["rows", (value) => map({ rows: value })],
    ["object", (value) => scene.object(value)],
    ["periods", (value) => oil.step([0, 0, 0], answer, value)],
    ...["index", "parameter", "further", "cell"].flatMap((key) =>
      [0, 1].map((at) => [key, (value) => path.resume({ ...state, [key]: at === 0 ? [value, 0] : [0, value] })])),
  ];
  for (const [what, call] of wholeNumbers())
    try {
      call(0xffffffff);
    } catch (error) {
      assert.doesNotMatch(error.message, /expected whole numbers/, what);
    }

  for (const [words, call] of [
    [/^law: expected one of wall, cylinder, .*, got the text "nope"$/, () => library.law("nope")],
    [/^law: expected one of wall, .*, got undefined$/, () => library.law()],
    [/^law wall: expected options with stiffness, got undefined$/, () => library.law("wall")],
    [/^law wall: expected options with stiffness, got the number 1$/, () => library.law("wall", 1)],
    [/^stiffness: expected a number, got undefined$/, () => library.law("wall", {})],
    [/^law wall: expected some of radius, width, stiffness, got K$/, () => library.law("wall", { K: 1 })],
    [/^height map: expected options with heights, columns, rows, pitch and stiffness, got undefined$/, () => library.heightMap()],
    [/^mesh: expected options with vertices, triangles and stiffness, got undefined$/, () => library.mesh()],
    [/^position: expected an array of 3 numbers, got the number 3$/, () => wall.force(3, 0, -0.5)],
    [/^position: expected an array of 3 numbers, got the number 3$/, () => path.step(3, 0, -0.5)],
    [/^position: expected an array of 3 numbers, got an array of 2$/, () => wall.force([0, 0])],
    [/^position: expected numbers, got the text "0" at 2$/, () => wall.force([0, 0, "0"])],
    [/^position: expected an array of 3 numbers, got the text "1,2,3"$/, () => wall.force("1,2,3")],
    [/^positions: expected an array of three numbers for each, got an array of 4$/, () => wall.forces([0, 0, 0, 0])],
    [/^heights: expected an array of 9 numbers, got an array of 8$/, () => map({ heights: new Array(8).fill(0) })],
    [/^rows: expected whole numbers from 0, got undefined$/, () => map({ rows: undefined })],
    [/^edge: expected a text, got the number 3$/, () => map({ edge: 3 })],
    [/^triangles: expected whole numbers from 0, got the number -1$/, () => mesh({ triangles: [0, 0, -1] })],
    [/^selfIntersecting: expected true or false, got the text "no"$/, () => mesh({ selfIntersecting: "no" })],
    [/^materials: expected an array, got an object$/, () => mesh({ materials: {} })],
    [/^materialOfTriangle: expected an array of 1 numbers, got the number 0$/, () => mesh({ materialOfTriangle: 0 })],
    [/^materialOfTriangle: expected materials beside it, got none$/, () => mesh({ materialOfTriangle: [0] })],
    [/^objects: expected an array, got undefined$/, () => library.scene()],
    [/^objects: expected subjects of this library, got an object$/, () => library.scene([path])],
    [/^damping: expected options with rate, got undefined$/, () => library.damping()],
    [/^rate: expected a number, got undefined$/, () => library.damping({})],
    [/^damping: expected some of rate, share, damping, most, drag, fullAt, got full_at$/, () => library.damping({ full_at: 1 })],
    [/^answer: expected a force with its status, as step\(\) answers them, got undefined$/, () => oil.step([0, 0, 0])],
    [/^forces: expected an array of 3 numbers, got an array of 2$/, () => oil.steps([0, 0, 0], { ...answers, forces: [0, 0] })],
    [/^state: expected a state, as state\(\) answers it, got undefined$/, () => oil.resume()],
    [/^poses: expected an array, got undefined$/, () => scene.step([0, 0, 0])],
    [/^state: expected a state, as state\(\) answers it, got undefined$/, () => path.resume()],
    [/^side: expected one of front, back, got the text "left"$/, () => path.resume({ ...state, side: "left" })],
    [/^feature: expected a text, got undefined$/, () => library.has()],
    [/^translation: expected an array of 3 numbers, got an array of 4$/,
      () => scene.step([0, 0, 0], [{ ...pose, translation: [0, 0, 0, 0] }])],
    [/^rotation: expected an array of 4 numbers, got an array of 3$/, () => scene.step([0, 0, 0], [{ ...pose, rotation: [1, 0, 0] }])],
    [/^pose: expected an object with translation and rotation, got undefined$/, () => scene.step([0, 0, 0], new Array(1))],
    [/^material: expected an object with .*, got undefined$/, () => mesh({ materials: new Array(1) })],
    [/^positions: expected an array of numbers, got one of BigInts, or one whose buffer was transferred$/,
      () => wall.forces(transferred())],
    ...[4, 256, 257].map((value) => [new RegExp(`^statuses: expected whole numbers from 0 to 3, got the number ${value}$`),
      () => oil.steps([0, 0, 0], { ...answers, statuses: [value] })]),
    [/^edge: expected a text without NUL, got the text "tile\\u0000"$/, () => map({ edge: "tile\0" })],
    [/^law: expected one of .*, got the text "x{40}…"$/, () => library.law("x".repeat(41))],
    [/^law: expected one of .*, got the text "x{40}"$/, () => library.law("x".repeat(40))],
    ...wholeNumbers().flatMap(([what, call]) =>
      [2 ** 32, -1, 0.5, NaN].map((value) =>
        [new RegExp(`^${what}: expected whole numbers from 0, got the number ${value}$`), () => call(value)])),
  ])
    assert.throws(call, (error) => error instanceof ForceshadeError && error.result === "BAD_VALUE" && words.test(error.message),
      String(call));

  // An option that is undefined is one that is not given.
  law({ radius: undefined, width: undefined });
  mesh({ crease: undefined, sides: undefined, materials: undefined });
  path.resume({ ...state, meeting: undefined, further: undefined, cell: undefined });
  library.damping({ rate: 1000, share: undefined, damping: undefined, most: undefined, drag: undefined, fullAt: undefined });
  assert.doesNotThrow(() => wall.force({ length: 3, 0: 0, 1: 0, 2: 1 })); // an ArrayLike, as forceshade.d.ts has it
  for (const one of [library, wall, path, scene, oil]) assert.ok(JSON.stringify(one).length < 300);
  for (const one of [wall, path, scene, oil]) assert.deepEqual(Object.keys(one), []);
}
