// SPDX-License-Identifier: BSD-3-Clause
// in_chromium.js PROGRAM.js: runs a program that emscripten made in headless Chromium, in a page of a server of this process,
// and prints what it prints. The exit code is the program's; 77 where Chromium is missing. with_npm.sh brings its package.
"use strict";

const fs = require("fs");
const http = require("http");
const path = require("path");
const browsers = require("./browsers.js");

const [program] = process.argv.slice(2);

function server() {
  const folder = path.dirname(program);
  const page = `<!doctype html><script>
    var lines = [], done = new Promise((ended) => {
      window.Module = { print: (line) => lines.push(line), printErr: (line) => lines.push(line),
        quit: (code, thrown) => { ended({ code, lines }); throw thrown; } };
      window.onerror = (words, file, line, column, thrown) => {
        if (thrown && thrown.name === "ExitStatus") return;
        lines.push(String(words));
        ended({ code: 1, lines });
      };
    });
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
  if (!fs.existsSync("/usr/bin/chromium")) {
    console.log("skipped: /usr/bin/chromium is not installed");
    return 77;
  }
  const its = server().listen(0, "127.0.0.1");
  const browser = await browsers.chromium();
  await browser.open(`http://127.0.0.1:${its.address().port}/`, { width: 800, height: 600 });
  const { code, lines } = await browser.evaluate("done");
  for (const line of lines) console.log(line);
  await browser.close();
  its.close();
  return code;
}

main().then((code) => process.exit(code));
