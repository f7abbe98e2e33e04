// SPDX-License-Identifier: BSD-3-Clause
// in_chromium.js CHROMIUM PROGRAM.js: runs a program that emscripten made in headless Chromium, in a page of a server of this process,
// and prints what it prints. The exit code is the program's; 77 where Chromium is missing. with_npm.sh brings its package.
"use strict";

const fs = require("fs");
const http = require("http");
const path = require("path");

const [chromium, program] = process.argv.slice(2);

function server() {
  const folder = path.dirname(program);
  const page = `<!doctype html><script>
    var Module = { print: (line) => said(line), printErr: (line) => said(line), quit: (code, thrown) => { ended(code); throw thrown; } };
    window.onerror = (words, file, line, column, thrown) => { if (thrown && thrown.name === "ExitStatus") return; said(String(words)); ended(1); };
  </script><script src="/${path.basename(program)}"></script>`;
  const types = { ".js": "text/javascript", ".wasm": "application/wasm" };
  return http.createServer((request, response) => {
    if (request.url === "/") return response.setHeader("Content-Type", "text/html").end(page);
    const file = path.join(folder, path.basename(request.url));
    const is_there = fs.existsSync(file);
    response.writeHead(is_there ? 200 : 404, { "Content-Type": types[path.extname(file)] || "text/plain" });
    return response.end(is_there ? fs.readFileSync(file) : "");
  });
}

async function main() {
  if (!fs.existsSync(chromium)) {
    console.log(`skipped: ${chromium} is not installed`);
    return 77;
  }
  const its = server().listen(0, "127.0.0.1");
  const browser = await require("playwright-core").chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  await page.exposeFunction("said", (line) => console.log(line));
  const code = await new Promise((resolve) => {
    page.exposeFunction("ended", resolve).then(() => page.goto(`http://127.0.0.1:${its.address().port}/`));
  });
  await browser.close();
  its.close();
  return code;
}

main().then((code) => process.exit(code));
