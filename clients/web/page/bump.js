// SPDX-License-Identifier: BSD-3-Clause
// The shapes of the nine laws in binary64, for drawing alone: no force is computed from them.
"use strict";

const Bump = (() => {
  const LAWS = {
    "wall": "The flat plane z = 0 as a spring. It uses K alone.",
    "cylinder": "A whole cylinder, whose axis lies at the depth d below the plane.",
    "bump-cylinder": "The true bump: a cylinder and the plane. Where the hand is in both, both push.",
    "bump-1p": "One flat polygon, the plane itself: the bump is not felt.",
    "bump-2p": "Two flat polygons, a roof. The force jumps at its ridge and at its edges.",
    "bump-3p": "Three flat polygons. Each edge is felt as a jump of the force.",
    "bump-1p-shaded": "The surface is flat, and force shading turns the force as though it were round (dashed).",
    "bump-2p-shaded": "The depth is that below two polygons, the direction is that of the round bump (dashed).",
    "bump-3p-shaded": "The depth is that below three polygons, the direction is that of the round bump (dashed).",
  };

  // θ of the thesis (4.4.3), in degrees: the angle of one of three polygons, two thirds of arcsin(w/2R).
  const theta = (R, w) => (2 / 3) * Math.asin(Math.min(1, w / (2 * R))) * (180 / Math.PI);
  const widthOf = (R, degrees) => 2 * R * Math.sin(1.5 * degrees * (Math.PI / 180));

  function geometry(R, w) {
    const half = w / 2, d = Math.sqrt((R - half) * (R + half)), h = (half * half) / (R + d);
    const t = Math.sin(Math.asin(Math.min(1, half / R)) / 3);
    return {half, d, h, halfTop: R * t, topHeight: 4 * R * t * t * Math.sqrt(1 - t * t)};
  }

  // The circle above x, measured from the plane.
  const arc = (R, g, x) => (g.half * g.half - x * x) / (Math.sqrt(Math.max(0, R * R - x * x)) + g.d);

  function height(law, R, g, x) {
    const across = Math.abs(x);
    if (across > g.half || law === "wall" || law.startsWith("bump-1p")) return 0;
    if (law === "bump-cylinder") return arc(R, g, x);
    if (law.startsWith("bump-2p")) return g.h * (1 - across / g.half);
    return across <= g.halfTop ? g.topHeight : (g.topHeight * (g.half - across)) / (g.half - g.halfTop);
  }

  function samples(from, to, count, more) {
    const all = [...more.filter((x) => x > from && x < to)];
    for (let k = 0; k <= count; ++k) all.push(from + ((to - from) * k) / count);
    return all.sort((a, b) => a - b);
  }

  // The section of a law in a box of mm: `area` is filled, `line` is its border, `felt` is the round shape of force shading.
  function section(law, R, w, box) {
    const g = geometry(R, w);
    if (law === "cylinder") {
      const reach = Math.min(R, Math.max(-box.left, box.right) * 1.1), upper = [], lower = [];
      for (let k = -90; k <= 90; ++k) {
        const x = reach * Math.sin((k * Math.PI) / 180);
        upper.push([x, arc(R, g, x)]);
        lower.push([x, Math.max(-g.d - Math.sqrt(Math.max(0, R * R - x * x)), box.bottom - 1.1 * (box.top - box.bottom))]);
      }
      const area = [...upper, ...lower.reverse()];
      return {area, line: [...area, area[0]], felt: []};
    }
    const line = samples(box.left, box.right, 240, [-g.half, -g.halfTop, 0, g.halfTop, g.half])
      .map((x) => [x, height(law, R, g, x)]);
    const round = law.endsWith("-shaded") ? samples(-g.half, g.half, 120, []).map((x) => [x, arc(R, g, x)]) : [];
    return {area: [...line, [box.right, box.bottom], [box.left, box.bottom]], line, felt: round};
  }

  return {LAWS, theta, widthOf, geometry, section};
})();
