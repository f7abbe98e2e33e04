// SPDX-License-Identifier: BSD-3-Clause
// Binary32 numbers as people read them: in decimal digits that name exactly one of them, in bits, and how far two are apart.
"use strict";

const Numbers = (() => {
  const cell = new DataView(new ArrayBuffer(4));

  function bits(value) {
    cell.setFloat32(0, value);
    return cell.getUint32(0);
  }

  const hex = (value) => `0x${bits(value).toString(16).padStart(8, "0")}`;

  // The fewest significant digits, at most nine, whose nearest binary32 number is this one.
  function decimal(value) {
    if (!Number.isFinite(value) || value === 0) return String(value);
    let digits = 1;
    while (Math.fround(Number(value.toPrecision(digits))) !== value) ++digits;
    return Math.abs(value) < 1e-3 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
  }

  // The place of a number among all binary32 numbers in their order; both zeros have 0.
  const rank = (value) => (bits(value) & 0x7fffffff) * (bits(value) >>> 31 ? -1 : 1);

  // The number of binary32 numbers that `other` lies above `value`. Within one binade that is the difference in units in the last place.
  const apart = (value, other) => rank(other) - rank(value);

  const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");

  // "+2 ulp", "−1 ulp" or "same".
  function apartInWords(value, other) {
    if (Number.isNaN(other)) return "not a number";
    const count = apart(value, other);
    if (count === 0) return "same";
    return `${count > 0 ? "+" : "\u2212"}${grouped(Math.abs(count))} ulp`;
  }

  return {hex, decimal, apart, apartInWords};
})();
