// SPDX-License-Identifier: BSD-3-Clause
// The forces of an independent program, tests/golden/bump_forces.csv, as numbers.
"use strict";

const fs = require("node:fs");

// "-0x1.000002p-30", "inf", "nan"
function number(text) {
  const words = {nan: NaN, inf: Infinity, "-inf": -Infinity};
  if (text in words) return words[text];
  const [, sign, one, digits = "", exponent] = /^(-?)0x([01])(?:\.([0-9a-f]+))?p([+-]\d+)$/.exec(text);
  return (sign ? -1 : 1) * Number.parseInt(one + digits, 16) * 2 ** (Number(exponent) - 4 * digits.length);
}

// For each line: {law, radius, width, stiffness, position, force, status}, in mm and N.
function forces(file) {
  const [head, ...rows] = fs.readFileSync(file, "utf8").trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => {
    const text = (name) => row[head.indexOf(name)];
    const numbers = (...names) => names.map((name) => number(text(name)));
    const [radius, width, stiffness] = numbers("R_mm", "w_mm", "K_N_per_mm");
    const [fx, fz] = numbers("fx_binary32", "fz_binary32");
    const position = numbers("x_mm", "y_mm", "z_mm");
    return {law: text("law"), radius, width, stiffness, position, force: [fx, 0, fz], status: text("status")};
  });
}

module.exports = {forces};
