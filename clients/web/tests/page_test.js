// SPDX-License-Identifier: BSD-3-Clause
// page_test.js BROWSER PAGE.html FORCES.csv PICTURES: opens the page from a file and from a server, strokes it with mouse, finger and
// keys, and compares what it shows with the library and with FORCES.csv of an independent program. Pictures go into the folder.
"use strict";

const assert = require("node:assert/strict");
const {spawn} = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const {pathToFileURL} = require("node:url");
const browsers = require("./browsers.js");
const {forces} = require("./golden.js");

const MOST_BYTES = 1_000_000;
const WIDE = {width: 1280, height: 900}, NARROW = {width: 360, height: 740};
const [kind, page, golden, pictures] = process.argv.slice(2);
const tests = [];
const test = (name, run) => tests.push({name, run});

// ---- What is done in the page ----

const state = () => browser.evaluate("forceshadePage.ready.then(() => forceshadePage.state())");
const settled = () => browser.evaluate("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve(1))))");
const text = (id) => browser.evaluate(`document.getElementById("${id}").textContent`);
const choose = (id, value) => browser.evaluate(`(() => { const it = document.getElementById("${id}"); it.value = "${value}";
  it.dispatchEvent(new Event("change", {bubbles: true})); })()`);
const click = (id) => browser.evaluate(`document.getElementById("${id}").click()`);

async function open(url, size = WIDE, dark = false) {
  await browser.open(url, {...size, dark});
  await state();
  await settled();
}

// Places in pixels of the window, from parts of the picture's width and height.
async function places(parts) {
  await browser.evaluate("document.getElementById('picture').scrollIntoView({block: 'center'})");
  const [left, top, width, height] = await browser.evaluate(`(() => {
    const {left, top, width, height} = document.getElementById("picture").getBoundingClientRect();
    return [left, top, width, height]; })()`);
  return parts.map(([x, y]) => [left + x * width, top + y * height]);
}

const across = (depth, count = 40) => Array.from({length: count + 1}, (_, k) => [0.15 + (0.7 * k) / count, depth]);

function bits(value) {
  const cell = new DataView(new ArrayBuffer(4));
  cell.setFloat32(0, value);
  return `0x${cell.getUint32(0).toString(16).padStart(8, "0")}`;
}

// The numbers in the table name the binary32 numbers of the state, in digits and in bits.
async function expectShown(now) {
  await settled();
  for (const [k, axis] of ["x", "y", "z"].entries()) {
    assert.equal(await text(`exact-${axis}-bits`), bits(now.force[k]));
    assert.equal(bits(parseFloat(await text(`exact-${axis}`))), bits(now.force[k]));
    assert.equal(await text(`naive-${axis}-bits`), now.naive ? bits(now.naive[k]) : "");
  }
  assert.equal(await text("status"), now.status);
}

// The force of a law in the state is what a subject of its own gives there, and the cursor lies beside the hand by F_x/C.
async function expectForceOfLaw(now) {
  const {force, status} = await browser.evaluate(`forceshade.load().then((lib) => {
    const subject = lib.law("${now.law}", {radius: ${now.radius}, width: ${now.width}, stiffness: ${now.stiffness}});
    const answer = subject.force([${now.point}]);
    subject.close();
    return {force: Array.from(answer.force), status: answer.status};
  })`);
  assert.deepEqual(now.force, force);
  assert.equal(now.status, status);
  assert.equal(now.cursor[0], now.point[0] + now.force[0] / now.coupling);
}

// ---- What must hold ----

let browser = null, server = null;

test("weighs no more than 1 MB in one file", async () => {
  const size = fs.statSync(page).size;
  assert.ok(size <= MOST_BYTES, `${size} bytes`);
  console.log(`  ${size} bytes`);
});

test("requests nothing beside itself, and complains of nothing, from a file and from a server", async () => {
  for (const url of [pathToFileURL(page).href, server.url]) {
    server.requests.length = 0;
    await open(url);
    await browser.mouse(await places(across(0.6)));
    assert.deepEqual(await browser.evaluate("performance.getEntriesByType('resource').map((each) => each.name)"), []);
    if (url === server.url) assert.deepEqual(server.requests, [`GET /${path.basename(page)}`]);
    const said = browser.said();
    if (said) {
      // Firefox tells of its own fonts and of the empty icon, which are data, and not of a file that it opens.
      const others = said.requests.filter((each) => each !== url && !each.startsWith("data:"));
      assert.deepEqual([others, said.complaints], [[], []]);
    }
    assert.equal(await text("fault"), "");
  }
  // What cannot fail shows nothing: a request that the page is made to try is refused by its own policy.
  await assert.rejects(browser.evaluate(`fetch("${server.url}").then((told) => told.text())`));
});

test("begins with the forces that are known", async () => {
  await open(server.url);
  const now = await state();
  assert.deepEqual([now.law, now.point.map(bits)], ["bump-2p-shaded", KNOWN.point]);
  assert.deepEqual([now.force.map(bits), now.naive.map(bits)], [KNOWN.exact, KNOWN.naive]);
  assert.equal(await text("apart-x"), KNOWN.apart);
  await expectShown(now);
});

test("begins with the switch, without which the push jumps at the top", async () => {
  await open(server.url);
  assert.equal(await browser.evaluate("document.querySelector('input, select, button, canvas').id"), "shaded");
  const jump = async () => {
    const forces = [];
    for (const part of [[0.49, 0.7], [0.51, 0.7]]) {
      await browser.mouse(await places([part]));
      const now = await state();
      await expectForceOfLaw(now);
      forces.push(now.force[0]);
    }
    return forces[1] - forces[0];
  };
  const smooth = await jump();
  await click("not-shaded");
  assert.equal((await state()).law, "bump-2p");
  const sharp = await jump();
  assert.ok(smooth > 0 && sharp > 10 * smooth, `${sharp} N beside ${smooth} N`);
  await click("shaded");
  assert.equal((await state()).law, "bump-2p-shaded");
  const isOff = () => browser.evaluate("document.getElementById('switch').disabled");
  await choose("law", "wall");
  assert.equal(await isOff(), true);
  await click("kind-map");
  await click("shaded");
  assert.deepEqual([await isOff(), (await state()).render], [false, "height-map-shaded"]);
  await click("kind-mesh");
  await click("not-shaded");
  assert.deepEqual([await isOff(), (await state()).shading], [false, "none"]);
});

test("has the forces of the independent program, to the bit", async () => {
  const cases = forces(golden).filter(({status}) => status !== "invalid");
  const wrong = await browser.evaluate(`forceshade.load().then((lib) => ${JSON.stringify(cases)}.filter(
    ({law, radius, width, stiffness, position, ...expected}) => {
      const subject = lib.law(law, {radius, width, stiffness}), {force, status} = subject.force(position);
      subject.close();
      return force.some((value, k) => value !== expected.force[k]) || status !== expected.status;
    }).length)`);
  assert.equal(wrong, 0);
  assert.ok(cases.length > 1000 && new Set(cases.map(({law}) => law)).size === 9);
  console.log(`  ${cases.length} positions of nine laws, 0 wrong`);
});

test("is stroked by a mouse, in each of the nine laws", async () => {
  await open(server.url);
  const touched = {};
  for (const law of await browser.evaluate("forceshade.load().then((lib) => Array.from(lib.laws))")) {
    await choose("law", law);
    for (const part of across(0.7, 8)) {
      await browser.mouse(await places([part]));
      const now = await state();
      assert.equal(now.law, law);
      await expectForceOfLaw(now);
      const size = Math.hypot(...now.force), error = Math.hypot(...now.force.map((value, k) => value - now.naive[k]));
      assert.ok(error <= 1e-5 * size, `naive ${now.naive} for ${now.force}`);
      if (part[0] === 0.15 || part[0] > 0.5) await expectShown(now);
      if (now.status === "contact") touched[law] = (touched[law] ?? 0) + 1;
    }
  }
  assert.equal(Object.keys(touched).length, 9, JSON.stringify(touched));
});

test("is stroked by a finger, whose point lies above it", async () => {
  if (!browser.touches) return "this driver has no fingers";
  await open(server.url, NARROW);
  const [first, ...more] = await places(across(0.75, 20)), before = await state();
  await browser.touch([first, ...more]);
  const now = await state(), [x, y] = more.at(-1);
  assert.notDeepEqual(now.point, before.point);
  const shown = await browser.evaluate(`(() => { const {left, top} = document.getElementById("picture").getBoundingClientRect();
    const {box, point} = forceshadePage.state();
    return [left + (point[0] - box.left) * box.scale, top + (box.top - point[2]) * box.scale]; })()`);
  assert.ok(Math.abs(shown[0] - x) < 1 && Math.abs(shown[1] - (y - 44)) < 1, `${shown} for a finger at ${[x, y]}`);
  await expectForceOfLaw(now);
  await expectShown(now);
  return undefined;
});

test("is stroked by keys", async () => {
  await open(server.url);
  await browser.evaluate("document.getElementById('picture').focus()");
  const begin = await state(), stays = [];
  for (const [key, axis, sign] of [["ArrowLeft", 0, -1], ["ArrowDown", 2, -1], ["ArrowRight", 0, 1], ["ArrowUp", 2, 1],
    ["Shift+ArrowLeft", 0, -1]]) {
    const before = await state();
    await browser.press(key);
    const now = await state(), moved = now.point[axis] - before.point[axis];
    assert.ok(moved * sign > 0, key);
    stays.push(Math.abs(moved));
    await expectForceOfLaw(now);
    await expectShown(now);
  }
  assert.ok(Math.abs(stays[4] / stays[0] - 0.1) < 0.001);
  await browser.press("Home");
  assert.deepEqual((await state()).point, begin.point);
  await new Promise((resolve) => setTimeout(resolve, 700));
  assert.match(await text("live"),
               /^Hand [\d.]+ mm right, [\d.]+ mm below zero: pushed [\d.]+ newtons to the right and [\d.]+ newtons up\.$/);
});

test("keeps R, w and theta consistent, and w at most 2R", async () => {
  await open(server.url);
  const theta = ({radius, width}) => (2 / 3) * Math.asin(width / (2 * radius)) * (180 / Math.PI);
  const field = (id) => browser.evaluate(`Number(document.getElementById("${id}-number").value)`);
  const expectFields = async () => {
    const now = await state();
    assert.deepEqual([await field("radius"), await field("width"), await field("stiffness")].map(Math.fround),
                     [now.radius, now.width, now.stiffness]);
    assert.ok(Math.abs(await field("theta") - theta(now)) < 1e-3);
    assert.ok(now.width <= 2 * now.radius);
    await expectForceOfLaw(now);
    return now;
  };
  await choose("theta-number", 30);
  assert.ok(Math.abs(theta(await expectFields()) - 30) < 1e-5);
  await choose("theta-number", 60);
  const widest = await expectFields();
  assert.equal(widest.width, 2 * widest.radius);
  await choose("radius-number", 4);
  assert.equal((await expectFields()).width, 8);
  for (const id of ["radius", "width", "theta", "stiffness"]) {
    const before = await expectFields();
    await browser.evaluate(`document.getElementById("${id}").focus()`);
    await browser.press("ArrowLeft");
    const now = await expectFields(), changed = id === "theta" ? "width" : id;
    assert.ok(now[changed] < before[changed], id);
  }
  for (const [id, wrong] of [["width-number", 9000], ["radius-number", -1], ["stiffness-number", 1e4], ["stiffness-number", ""]]) {
    const before = await state();
    await choose(id, wrong);
    assert.notEqual(await text("fault"), "", id);
    const {radius, width, stiffness} = await expectFields();
    assert.deepEqual([radius, width, stiffness], [before.radius, before.width, before.stiffness]);
  }
  await choose("stiffness-number", 2);
  assert.equal(await text("fault"), "");
  await choose("push-number", 50);
  assert.equal((await expectFields()).coupling, 4);
});

test("shows where naive binary32 has no digits left", async () => {
  await open(server.url);
  await choose("law", "bump-2p");
  await browser.evaluate("document.querySelector('button[data-radius=\"1000\"]').click()");
  const now = await state(), exact = 5e-4 / 1;  // 2h/w of R = 1000 mm, w = 2 mm
  assert.ok(Math.abs(now.force[0] / now.force[2] / exact - 1) < 1e-6);
  assert.ok(Math.abs(now.naive[0] / now.naive[2] / exact - 1) > 0.01);
  await expectForceOfLaw(now);
});

test("strokes height maps and meshes, whose naive column is empty", async () => {
  await open(server.url);
  const seen = [];
  const stroke = async (kind, depth) => {
    let contacts = 0;
    assert.equal((await state()).kind, kind);
    for (const part of across(depth, 8)) {
      await browser.mouse(await places([part]));
      contacts += (await state()).status === "contact";
    }
    const now = await state();
    assert.equal(await text("fault"), "");
    await expectShown(now);
    assert.equal(now.naive, null);
    assert.ok(contacts > 0, JSON.stringify(now));
    seen.push(`${now.name}, ${now.parameters}: ${contacts} of 9 in contact`);
  };
  await click("kind-map");
  for (const map of ["hills", "ripples"])
    for (const render of ["height-map", "height-map-shaded", "height-map-conservative"]) {
      await choose("map", map);
      await choose("render", render);
      await stroke("map", 0.6);
    }
  await click("kind-mesh");
  assert.equal((await state()).status, "contact");  // its first place is inside, and its path begins outside
  for (const mesh of ["octahedron", "icosahedron"])
    for (const shading of ["none", "vertex", "edge"]) {
      await choose("mesh", mesh);
      await choose("shading", shading);
      assert.deepEqual([(await state()).mesh, (await state()).shading], [mesh, shading]);
      await stroke("mesh", 0.4);
    }
  // Without shading the force is K times the way from the hand to the god-object.
  await choose("shading", "none");
  await choose("along-number", 1.5);
  await browser.mouse(await places([[0.5, 0.02], [0.5, 0.3]]));
  const {point, force, godObject, stiffness, status} = await state();
  assert.deepEqual([status, point[1]], ["contact", 1.5]);
  force.forEach((value, k) => assert.ok(Math.abs(value - stiffness * (godObject[k] - point[k])) < 1e-6));
  console.log(seen.map((line) => `  ${line}`).join("\n"));
});

// The three places of the hand come in one task of the page, between which no time passes but that of a machine that is late.
test("damps the force by the speed of the hand, and not where it rests", async () => {
  await open(server.url);
  await choose("damping-number", 0.02);
  assert.equal((await state()).naive, null);
  assert.match(await text("naive-note"), /damped/);
  const [pressed, released] = await browser.evaluate(`forceshade.load().then((lib) => {
    const picture = document.getElementById("picture"), {left, top, width, height} = picture.getBoundingClientRect();
    const {law, radius, stiffness, width: chord} = forceshadePage.state(), subject = lib.law(law, {radius, width: chord, stiffness});
    const sizes = [0.7, 0.72, 0.7].map((part) => {
      picture.dispatchEvent(new PointerEvent("pointermove", {clientX: left + 0.5 * width, clientY: top + part * height, isPrimary: true,
        pointerType: "mouse"}));
      const {point, force} = forceshadePage.state();
      return Math.hypot(...force) / Math.hypot(...subject.force(point).force);
    });
    return sizes.slice(1);
  })`);
  assert.ok(pressed > 1.05 && pressed < 2.001 && released < 0.95, `${pressed} and ${released} of the force without damping`);
  const isAtRest = async () => {
    const {law, radius, width, stiffness, point, force} = await state();
    return browser.evaluate(`forceshade.load().then((lib) => lib.law("${law}", ${JSON.stringify({radius, width, stiffness})})
      .force([${point}]).force.every((value, k) => value === [${force}][k]))`);
  };
  while (!await isAtRest()) await settled();
  for (const wrong of [-1, 0.03, ""]) {
    await choose("damping-number", wrong);
    assert.match(await text("fault"), /damping/);
    assert.equal((await state()).damping, Math.fround(0.02));
  }
  await choose("damping-number", 0);
  assert.equal(await text("fault"), "");
  await expectForceOfLaw(await state());
});

test("draws the cursor and the arrows of both forces, and only one arrow where there is no naive force", async () => {
  await open(server.url);
  const drawn = () => browser.evaluate(`(() => {
    const picture = document.getElementById("picture"), {data} = picture.getContext("2d").getImageData(0, 0, picture.width, picture.height);
    const style = getComputedStyle(document.documentElement), counts = {};
    for (const name of ["tip", "exact", "naive", "difference"]) {
      const hex = style.getPropertyValue("--" + name).trim(), rgb = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
      counts[name] = 0;
      for (let k = 0; k < data.length; k += 4) counts[name] += rgb.every((value, c) => Math.abs(data[k + c] - value) < 3) ? 1 : 0;
    }
    return counts; })()`);
  const withoutNaive = await drawn();
  assert.ok(withoutNaive.exact > 200 && withoutNaive.naive === 0 && withoutNaive.difference === 0, JSON.stringify(withoutNaive));
  await click("shows-naive");
  await settled();
  const ofLaw = await drawn();
  assert.ok(ofLaw.tip > 100 && ofLaw.exact > 200 && ofLaw.naive > 100 && ofLaw.difference > 3, JSON.stringify(ofLaw));
  await click("kind-map");
  await settled();
  const ofMap = await drawn();
  assert.ok(ofMap.tip > 100 && ofMap.exact > 200 && ofMap.naive === 0 && ofMap.difference === 0, JSON.stringify(ofMap));
});

test("draws a frame for what changes, and none for what does not", async () => {
  await open(server.url);
  const told = await browser.evaluate(`new Promise((resolve) => {
    const picture = document.getElementById("picture"), {left, top, width, height} = picture.getBoundingClientRect();
    const begin = performance.now(), first = forceshadePage.frames();
    let refreshes = 0;
    const move = (now) => {
      ++refreshes;
      const part = 0.5 + 0.3 * Math.sin((now - begin) / 300);
      picture.dispatchEvent(new PointerEvent("pointermove", {clientX: left + part * width, clientY: top + 0.65 * height, isPrimary: true,
        pointerType: "mouse"}));
      if (now - begin < 2000) requestAnimationFrame(move);
      else requestAnimationFrame(() => resolve({frames: forceshadePage.frames() - first, refreshes, seconds: (now - begin) / 1000}));
    };
    requestAnimationFrame(move);
  })`);
  assert.ok(told.frames > 0 && Math.abs(told.frames - told.refreshes) <= 1, JSON.stringify(told));
  console.log(`  ${(told.frames / told.seconds).toFixed(1)} frames a second over ${told.seconds.toFixed(2)} s`);
  await settled();
  const still = await browser.evaluate("forceshadePage.frames()");
  await settled();
  assert.equal(await browser.evaluate("forceshadePage.frames()"), still);
});

test("fits wide and narrow windows, in light and dark", async () => {
  for (const [word, size] of [["wide", WIDE], ["narrow", NARROW]])
    for (const dark of browser.isAlwaysLight ? [false] : [false, true]) {
      await open(server.url, size, dark);
      for (const surface of ["law", "map", "mesh"]) {
        await click(`kind-${surface}`);
        await settled();
        const [needs, has, paper] = await browser.evaluate(
          "[document.documentElement.scrollWidth, innerWidth, getComputedStyle(document.body).backgroundColor]");
        assert.ok(needs <= has, `${needs} of ${has} pixels`);
        if (!browser.isAlwaysLight) assert.equal(has, size.width);
        const brightness = paper.match(/\d+/g).slice(0, 3).reduce((sum, value) => sum + Number(value), 0);
        assert.equal(brightness < 384, dark);
        await new Promise((resolve) => setTimeout(resolve, 600));
        await browser.picture(path.join(pictures, `${kind}-${word}-${dark ? "dark" : "light"}-${surface}.png`));
      }
    }
});

const KNOWN = {point: ["0x40db851f", "0x00000000", "0xc0433333"], exact: ["0x3fb22809", "0x00000000", "0x4030b635"],
  naive: ["0x3fb22808", "0x00000000", "0x4030b635"], apart: "−1 ulp"};

// Python's server, and the requests that it tells of.
async function serve(folder, name) {
  const port = 40000 + (process.pid % 20000), requests = [];
  const child = spawn("python3", ["-u", "-m", "http.server", "--bind", "127.0.0.1", String(port)], {cwd: folder});
  child.stderr.on("data", (told) => requests.push(...[...String(told).matchAll(/"(GET \S+) HTTP/g)].map((found) => found[1])));
  await new Promise((resolve, reject) => {
    child.stdout.once("data", resolve);
    child.once("exit", () => reject(new Error("python3 -m http.server has ended")));
  });
  return {url: `http://127.0.0.1:${port}/${name}`, requests, close: () => child.kill()};
}

async function main() {
  fs.mkdirSync(pictures, {recursive: true});
  server = await serve(path.dirname(path.resolve(page)), path.basename(page));
  let failed = 0;
  try {
    browser = await browsers[kind]();
    console.log(browser.name);
    for (const {name, run} of tests) {
      try {
        const skipped = await run();
        console.log(`${skipped ? "left out" : "ok"}: ${name}${skipped ? `: ${skipped}` : ""}`);
      } catch (error) {
        ++failed;
        console.log(`FAILED: ${name}\n${error.stack}`);
      }
    }
  } finally {
    await browser?.close();
    server.close();
  }
  return failed;
}

main().then((failed) => process.exit(failed ? 1 : 0), (error) => {
  console.error(error);
  process.exit(1);
});
