// SPDX-License-Identifier: BSD-3-Clause
// The page: a mouse, a finger or the arrow keys move the hand's point; the library answers with the force; a frame is drawn where
// something has changed.
"use strict";

(() => {
  const byId = (id) => document.getElementById(id);
  const canvas = byId("picture"), context = canvas.getContext("2d");
  const choice = {kind: "law", law: "bump-2p-shaded", map: "hills", render: "height-map", mesh: "octahedron", shading: "vertex",
    radius: Math.fround(15.24), width: Math.fround(25.4), stiffness: 0.5, along: 0, damping: 0, push: 100};
  const FINGER = 44;  // pixels that the hand's point lies above a finger, which would hide it
  const PERIOD = 10;  // ms of a tick of damping: a pointer tells of its place every 7 to 17
  let lib = null, surface = null, controls = null, colours = null, shape = null, box = null;
  let point = null, spring = null, answer = null, naive = null, godObject = null;
  let damper = null, ticked = 0, resting = null;
  let pixels = {width: 0, height: 0}, frames = 0, isDue = false, speaking = null;

  // ---- The force at the hand's point ----

  const binary32 = (values) => values.map((value) => Math.fround(value));

  function stroke(to) {
    point = binary32(to);
    spring = surface.to(point);
    godObject = surface.godObject();
    damp();
  }

  // The force by the speed since the last tick. A tick in which the hand rests follows where no motion does.
  function damp() {
    clearTimeout(resting);
    const isOn = choice.damping > 0, now = performance.now(), periods = Math.max(1, Math.round((now - ticked) / PERIOD));
    ticked = now;
    answer = spring;
    if (isOn) {
      const {force, status} = damper.step(point, spring, periods);
      answer = {force: Array.from(force), status};
      if (damper.state().velocity.some((each) => each !== 0)) resting = setTimeout(damp, 5 * PERIOD);
    }
    naive = isOn ? null : surface.naive(point);
    due();
  }

  function begin(to) {
    surface.begin(binary32(to));
    damper.reset();
    stroke(to);
  }

  // The coupling constant C of the hand, N/mm: that of the surface, divided by the push-back that was chosen.
  const coupling = () => choice.stiffness / (choice.push / 100);

  // The cursor is drawn beside the hand's point by the lateral force over C.
  const cursor = () => [point[0] + answer.force[0] / coupling(), point[1], point[2]];

  // ---- What is stroked ----

  // The switch: what it changes of each kind, and which choices it is for.
  const shaded = {
    law: (isOn) => ({law: choice.law.replace("-shaded", "") + (isOn ? "-shaded" : "")}),
    map: (isOn) => ({render: isOn ? "height-map-shaded" : "height-map"}),
    mesh: (isOn) => ({shading: isOn ? "vertex" : "none"}),
  };
  const isShaded = () => ({law: choice.law.endsWith("-shaded"), map: choice.render === "height-map-shaded",
    mesh: choice.shading !== "none"})[choice.kind];
  const hasBoth = () => choice.kind !== "law" || /^bump-\dp/.test(choice.law);

  const damperOf = (damping) => lib.damping({rate: 1000 / PERIOD, damping});

  function rebuild(changes) {
    const wanted = {...choice, ...changes};
    let made = null;
    try {
      made = Surfaces[wanted.kind](lib, wanted);
    } catch (error) {
      byId("fault").textContent = error.message;
      if (surface) describe();
      return;
    }
    byId("fault").textContent = "";
    const before = surface && wanted.kind === choice.kind ? point.map((value) => value / surface.fit.width) : null;
    surface?.close();
    surface = made;
    Object.assign(choice, wanted);
    const [x, , z] = before ? before.map((value) => value * surface.fit.width) : surface.start;
    layOut();
    begin([x, choice.along, z]);
    describe();
  }

  function change(changes) {
    if (!["along", "push", "damping"].some((name) => name in changes)) {
      rebuild(changes);
      return;
    }
    const {along, push, damping} = {...choice, ...changes};
    const isGood = Math.abs(along) <= 15 && push >= 0 && push <= 200 && (damping === 0 || damping >= 1e-5) && damping <= 0.02;
    byId("fault").textContent = isGood ? "" : `y is ${along} mm, the damping ${damping} N·s/mm and the push-back ${push} %; ` +
      "expected -15 to 15 mm, 0 or 0.00001 to 0.02 N·s/mm, and 0 to 200 %";
    if (isGood) Object.assign(choice, {along, push, damping});
    damper = damperOf(choice.damping);
    layOut();
    stroke([point[0], choice.along, point[2]]);
    describe();
  }

  function describe() {
    controls.show();
    for (const kind of ["law", "map", "mesh"]) {
      byId(`kind-${kind}`).checked = choice.kind === kind;
      byId(`of-${kind}`).hidden = choice.kind !== kind;
    }
    for (const name of ["law", "map", "render", "mesh", "shading"]) byId(name).value = choice[name];
    byId("switch").disabled = !hasBoth();
    byId(isShaded() ? "shaded" : "not-shaded").checked = true;
    byId("about-law").textContent = Bump.LAWS[choice.law];
    byId("name").textContent = `${surface.subject.name}: ${surface.subject.parameters}`;
    byId("naive-note").textContent = choice.damping > 0 ? "There is no naive computation of a damped force on this page."
      : choice.kind === "law" ? ""
      : `There is no naive computation of a ${choice.kind === "map" ? "height map" : "mesh"} on this page: it is made for the nine laws.`;
    byId("mesh-key").hidden = choice.kind !== "mesh";
    for (const key of document.querySelectorAll(".of-laws")) key.hidden = choice.kind !== "law";
    for (const key of document.querySelectorAll(".of-naive")) key.hidden = !showsNaive();
  }

  const showsNaive = () => naive !== null && byId("shows-naive").checked;

  // ---- The picture ----

  function layOut() {
    box = Drawing.boxOf(surface.fit, pixels);
    shape = surface.section(choice.along, box);
    due();
  }

  function resize() {
    const ratio = window.devicePixelRatio || 1, {width, height} = canvas.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    pixels = {width, height};
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    context.setTransform(canvas.width / width, 0, 0, canvas.height / height, 0, 0);
    if (surface) layOut();
  }

  function readColours() {
    const style = getComputedStyle(document.documentElement);
    colours = {};
    for (const name of ["air", "surface", "edge", "ink", "exact", "naive", "difference", "tip"])
      colours[name] = style.getPropertyValue(`--${name}`).trim();
    if (surface) due();
  }

  function due() {
    if (!isDue) requestAnimationFrame(frame);
    isDue = true;
  }

  function frame() {
    isDue = false;
    ++frames;
    Drawing.draw(context, pixels, {box, shape, stiffness: choice.stiffness, point, cursor: cursor(), godObject,
      force: answer.force, naive: showsNaive() ? naive : null, showsHand: byId("shows-hand").checked}, colours);
    tell();
  }

  // ---- The numbers ----

  function tell() {
    byId("status").textContent = answer.status;
    byId("status").dataset.status = answer.status;
    const coordinates = ["x", "y", "z"].map((axis, k) => `${axis} = ${Numbers.decimal(point[k])}`);
    byId("position").textContent = `${coordinates.join(", ")} mm`;
    ["x", "y", "z"].forEach((axis, k) => {
      byId(`exact-${axis}`).textContent = Numbers.decimal(answer.force[k]);
      byId(`exact-${axis}-bits`).textContent = Numbers.hex(answer.force[k]);
      byId(`naive-${axis}`).textContent = naive ? Numbers.decimal(naive[k]) : "none";
      byId(`naive-${axis}-bits`).textContent = naive ? Numbers.hex(naive[k]) : "";
      byId(`apart-${axis}`).textContent = naive ? Numbers.apartInWords(answer.force[k], naive[k]) : "";
    });
    const word = choice.push > 0 ? `C = ${Number(coupling().toPrecision(4))} N/mm` : "the cursor stays at the hand's point";
    byId("coupling").textContent = word;
    speaking ??= setTimeout(speak, 500);
  }

  // A sentence for a reader of the screen, at most twice a second.
  function speak() {
    speaking = null;
    const short = (value) => Number(Math.abs(value).toPrecision(3));
    const [fx, , fz] = answer.force;
    const side = (value, right, left) => (value < 0 ? left : right);
    const across = `${short(point[0])} mm ${side(point[0], "right", "left")}`;
    const where = `Hand ${across}, ${short(point[2])} mm ${side(point[2], "above", "below")} zero`;
    const push = `pushed ${short(fx)} newtons to the ${side(fx, "right", "left")} and ${short(fz)} newtons ${side(fz, "up", "down")}`;
    byId("live").textContent = `${where}: ${answer.status === "contact" ? push : answer.status}.`;
  }

  // ---- The hand ----

  function pointed(event) {
    const bounds = canvas.getBoundingClientRect();
    const px = Math.min(pixels.width, Math.max(0, event.clientX - bounds.left));
    const py = Math.min(pixels.height, Math.max(0, event.clientY - bounds.top - (event.pointerType === "touch" ? FINGER : 0)));
    const [x, z] = Drawing.toMillimetres(box, px, py);
    return [x, choice.along, z];
  }

  function listen() {
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (event.pointerType !== "mouse") begin(pointed(event));
    });
    canvas.addEventListener("pointerenter", (event) => {
      if (event.pointerType === "mouse") begin(pointed(event));
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.isPrimary) stroke(pointed(event));
    });
    canvas.addEventListener("keydown", (event) => {
      const step = (surface.fit.width / 150) * (event.shiftKey ? 0.1 : 1);
      const moves = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
      if (event.key in moves) {
        const [x, z] = moves[event.key], within = (value, low, high) => Math.min(high, Math.max(low, value));
        stroke([within(point[0] + x, box.left, box.right), choice.along, within(point[2] + z, box.bottom, box.top)]);
      } else if (event.key === "Home") {
        begin([surface.start[0], choice.along, surface.start[2]]);
      } else if ((event.key === "PageUp" || event.key === "PageDown") && choice.kind !== "law") {
        const along = choice.along + (event.key === "PageUp" ? 1 : -1) * (event.shiftKey ? 0.1 : 1);
        change({along: Math.fround(Math.min(15, Math.max(-15, along)))});
      } else {
        return;
      }
      event.preventDefault();
    });
    for (const kind of ["law", "map", "mesh"]) byId(`kind-${kind}`).addEventListener("change", () => change({kind}));
    for (const name of ["law", "map", "render", "mesh", "shading"])
      byId(name).addEventListener("change", () => change({[name]: byId(name).value}));
    for (const button of document.querySelectorAll("button[data-radius]"))
      button.addEventListener("click", () => rebuild({kind: "law", radius: Math.fround(Number(button.dataset.radius)),
        width: Math.fround(Number(button.dataset.width)), stiffness: Math.fround(Number(button.dataset.stiffness))}));
    for (const isOn of [true, false])
      byId(isOn ? "shaded" : "not-shaded").addEventListener("change", () => change(shaded[choice.kind](isOn)));
    byId("shows-hand").addEventListener("change", due);
    byId("shows-naive").addEventListener("change", () => {
      describe();
      due();
    });
    new ResizeObserver(resize).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", readColours);
  }

  async function start() {
    lib = await forceshade.load();
    byId("version").textContent = lib.version;
    for (const law of lib.laws) byId("law").append(new Option(law, law));
    damper = damperOf(0);
    controls = Controls.all(() => choice, change);
    readColours();
    resize();
    rebuild({});
    listen();
  }

  // For tests: how many frames have been drawn, and what they show.
  window.forceshadePage = {
    ready: start().catch((error) => {
      byId("fault").textContent = `The library could not be started in this browser, which needs WebAssembly with SIMD: ${error.message}`;
      throw error;
    }),
    frames: () => frames,
    state: () => ({...choice, point, force: answer.force, status: answer.status, naive, cursor: cursor(), godObject, box,
      coupling: coupling(), name: surface.subject.name, parameters: surface.subject.parameters}),
  };
})();
