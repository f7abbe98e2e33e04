// SPDX-License-Identifier: BSD-3-Clause
// Three browsers behind the few things that a test of the page does with one: Chromium by playwright-core, Firefox by puppeteer-core,
// and WebKitGTK by its driver, in the words of W3C WebDriver.
"use strict";

const {spawn} = require("node:child_process");
const fs = require("node:fs");

// What each browser gives: open(url, {width, height, dark}), evaluate(words), mouse([[x, y], ...]), touch([[x, y], ...]), press(key),
// picture(file), and said(): the requests and complaints of the page since open(). A number of mouse() and touch() is in pixels of
// the window, and the button or finger is down from the first place to the last.

// What playwright-core and puppeteer-core do by the same names: opens the address, and notes what the page requests and complains of.
async function followed(page, url) {
  const requests = [], complaints = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("console", (message) => ["error", "warning", "warn"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  await page.goto(url);
  return {requests, complaints};
}

async function dragged(page, places) {
  await page.mouse.move(...places[0]);
  await page.mouse.down();
  for (const place of places) await page.mouse.move(...place);
  await page.mouse.up();
}

async function chromium() {
  const browser = await require("playwright-core").chromium.launch({executablePath: "/usr/bin/chromium", args: ["--no-sandbox"]});
  let context = null, page = null, its = null;
  return {
    name: `Chromium ${browser.version()}`,
    touches: true,
    async open(url, {width, height, dark}) {
      await context?.close();
      context = await browser.newContext({viewport: {width, height}, colorScheme: dark ? "dark" : "light", hasTouch: true});
      page = await context.newPage();
      its = await followed(page, url);
    },
    evaluate: (words) => page.evaluate(words),
    mouse: (places) => dragged(page, places),
    async touch(places) {
      const session = await context.newCDPSession(page);
      const at = ([x, y]) => [{x, y, id: 1}];
      await session.send("Input.dispatchTouchEvent", {type: "touchStart", touchPoints: at(places[0])});
      for (const place of places) await session.send("Input.dispatchTouchEvent", {type: "touchMove", touchPoints: at(place)});
      await session.send("Input.dispatchTouchEvent", {type: "touchEnd", touchPoints: []});
    },
    press: (key) => page.keyboard.press(key),
    picture: (file) => page.screenshot({path: file, fullPage: true}),
    said: () => its,
    close: () => browser.close(),
  };
}

async function firefox() {
  const launch = (dark) => require("puppeteer-core").launch({browser: "firefox", executablePath: "/usr/bin/firefox-esr", headless: true,
    extraPrefsFirefox: {"layout.css.prefers-color-scheme.content-override": dark ? 0 : 1, "dom.w3c_touch_events.enabled": 1}});
  let isDark = false, browser = await launch(isDark), page = null, its = null;
  return {
    name: (await browser.version()).replace("/", " "),
    touches: true,
    async open(url, {width, height, dark}) {
      if (dark !== isDark) {
        await browser.close();
        browser = await launch(isDark = dark);
      } else {
        await page?.close();
      }
      page = await browser.newPage();
      await page.setViewport({width, height});
      its = await followed(page, url);
    },
    evaluate: (words) => page.evaluate(words),
    mouse: (places) => dragged(page, places),
    async touch(places) {
      await page.touchscreen.touchStart(...places[0]);
      for (const place of places) await page.touchscreen.touchMove(...place);
      await page.touchscreen.touchEnd();
    },
    async press(key) {
      const [last, ...held] = key.split("+").reverse();
      for (const each of held) await page.keyboard.down(each);
      await page.keyboard.press(last);
      for (const each of held) await page.keyboard.up(each);
    },
    picture: (file) => page.screenshot({path: file, fullPage: true}),
    said: () => its,
    close: () => browser.close(),
  };
}

const CODES = {ArrowLeft: "\uE012", ArrowUp: "\uE013", ArrowRight: "\uE014", ArrowDown: "\uE015", PageUp: "\uE00E", Home: "\uE011",
  Shift: "\uE008", Tab: "\uE004"};
const MINI_BROWSERS = ["/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser", "/usr/lib/x86_64-linux-gnu/webkit2gtk-4.0/MiniBrowser"];

async function webkit() {
  const port = 20000 + (process.pid % 20000), driver = spawn("WebKitWebDriver", [`--port=${port}`], {stdio: "ignore"});
  const request = async (method, path, body) => {
    const told = await fetch(`http://127.0.0.1:${port}${path}`, {method, body: body && JSON.stringify(body)});
    const {value} = await told.json();
    if (!told.ok) throw new Error(`${method} ${path}: ${value.error}, ${value.message}`);
    return value;
  };
  for (let tries = 0; ; ++tries) {
    try {
      await request("GET", "/status");
      break;
    } catch (error) {
      if (tries === 50) throw error;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }
  const options = {binary: MINI_BROWSERS.find((file) => fs.existsSync(file)), args: ["--automation"]};
  const session = await request("POST", "/session", {capabilities: {alwaysMatch: {"webkitgtk:browserOptions": options}}});
  const at = `/session/${session.sessionId}`, {browserName, browserVersion} = session.capabilities;
  const evaluate = (words) => request("POST", `${at}/execute/async`, {args: [], script: `const done = arguments[arguments.length - 1];
    (async () => (${words}))().then((value) => done({value}), (error) => done({error: String(error)}));`})
    .then(({value, error}) => {
      if (error) throw new Error(error);
      return value;
    });
  const pointer = (kind, places) => ({type: "pointer", id: kind, parameters: {pointerType: kind}, actions: [
    {type: "pointerMove", duration: 0, x: Math.round(places[0][0]), y: Math.round(places[0][1])}, {type: "pointerDown", button: 0},
    ...places.map(([x, y]) => ({type: "pointerMove", duration: 0, x: Math.round(x), y: Math.round(y)})),
    {type: "pointerUp", button: 0}]});
  return {
    name: `WebKitGTK, ${browserName} ${browserVersion}`,
    touches: false,  // its driver has no fingers
    isAlwaysLight: true,  // MiniBrowser follows the theme of the desktop
    async open(url, {width, height}) {
      await request("POST", `${at}/window/rect`, {width, height});
      await request("POST", `${at}/url`, {url});
      const [inner, outer] = await evaluate("[innerWidth, outerWidth]");
      if (inner !== width) await request("POST", `${at}/window/rect`, {width: width + outer - inner, height});
    },
    evaluate,
    mouse: (places) => request("POST", `${at}/actions`, {actions: [pointer("mouse", places)]}),
    async press(key) {
      const keys = key.split("+").map((each) => CODES[each] ?? each);
      const actions = [...keys.map((value) => ({type: "keyDown", value})), ...keys.reverse().map((value) => ({type: "keyUp", value}))];
      await request("POST", `${at}/actions`, {actions: [{type: "key", id: "keyboard", actions}]});
    },
    async picture(file) {
      fs.writeFileSync(file, Buffer.from(await request("GET", `${at}/screenshot`), "base64"));
    },
    said: () => null,  // its driver tells neither; the page and the server do
    async close() {
      await request("DELETE", at).catch(() => {});
      driver.kill();
    },
  };
}

module.exports = {chromium, firefox, webkit};
