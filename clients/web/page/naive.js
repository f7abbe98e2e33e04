// SPDX-License-Identifier: BSD-3-Clause
// The formulas of the thesis as one writes them at first: binary32, one operation after the other. It is what the page compares with,
// and not what the library does.
"use strict";

// Math.fround of a sum, product, quotient or root of binary32 numbers is the binary32 operation: binary64 has more than twice the
// digits, so that rounding twice is rounding once. The sine, cosine and arcsine of a browser are rounded to binary32 the same way,
// but JavaScript does not fix their bits, so that a last digit of bump-3p may differ from one browser to another.
const Naive = (() => {
  const f = Math.fround;
  const add = (a, b) => f(a + b), sub = (a, b) => f(a - b), mul = (a, b) => f(a * b), div = (a, b) => f(a / b);
  const root = (a) => f(Math.sqrt(a));

  // R − √(R² − (w/2)²) and what follows from it, with the letters of the thesis.
  function geometry(R, w) {
    const half = div(w, 2);
    const d = root(sub(mul(R, R), mul(half, half)));
    const h = sub(R, d);
    const theta = mul(div(2, 3), f(Math.asin(div(w, mul(2, R)))));
    const sine = f(Math.sin(theta)), cosine = f(Math.cos(theta));
    const top = mul(2, sub(mul(half, cosine), mul(d, sine)));
    const topHeight = sub(add(mul(half, sine), mul(d, cosine)), d);
    return {half, d, h, top, topHeight};
  }

  const unit = (x, z) => {
    const length = root(add(mul(x, x), mul(z, z)));
    return [div(x, length), div(z, length)];
  };

  const pushed = (size, [x, z]) => [mul(size, x), mul(size, z)];

  const plane = (K, z) => (z < 0 ? [0, mul(K, -z)] : [0, 0]);

  function cylinder(K, R, d, x, z) {
    const up = add(z, d), distance = root(add(mul(x, x), mul(up, up)));
    return distance < R ? pushed(mul(K, sub(R, distance)), [div(x, distance), div(up, distance)]) : [0, 0];
  }

  // Height of the flat polygons above x, and the direction in which they push.
  function polygons(count, w, g, x) {
    const across = Math.abs(x), up = [0, 1];
    if (across > g.half || count === 1) return [0, up];
    if (count === 2) {
      const slope = div(mul(2, g.h), w);
      return [mul(g.h, sub(1, div(mul(2, across), w))), unit(x < 0 ? -slope : slope, 1)];
    }
    if (across <= div(g.top, 2)) return [g.topHeight, up];
    const slope = div(mul(2, g.topHeight), sub(w, g.top));
    const height = div(mul(g.topHeight, sub(g.half, across)), sub(g.half, div(g.top, 2)));
    return [height, unit(x < 0 ? -slope : slope, 1)];
  }

  // The force (N) of a law at (x, y, z) in mm, for R and w in mm and K in N/mm: three binary32 numbers.
  function force(law, {radius: R, width: w, stiffness: K}, [x, , z]) {
    const g = geometry(R, w);
    const in_section = () => {
      if (law === "wall" || law === "bump-1p") return plane(K, z);
      if (law === "cylinder") return cylinder(K, R, g.d, x, z);
      if (law === "bump-cylinder") {
        const round = cylinder(K, R, g.d, x, z), flat = plane(K, z);
        return [add(round[0], flat[0]), add(round[1], flat[1])];
      }
      const [height, facet] = polygons(Number(law[5]), w, g, x);
      if (!(z < height)) return [0, 0];
      const size = mul(K, sub(height, z));
      if (!law.endsWith("-shaded")) return pushed(size, facet);
      if (Math.abs(x) > g.half) return [0, size];
      return pushed(size, [div(x, R), div(root(sub(mul(R, R), mul(x, x))), R)]);
    };
    const [fx, fz] = in_section();
    return [fx, 0, fz];
  }

  return {force};
})();
