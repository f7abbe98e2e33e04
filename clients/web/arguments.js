// SPDX-License-Identifier: BSD-3-Clause
// What the interface looks at before the module sees it: every wrong argument is a ForceshadeError in words.
const forceshadeArguments = (() => {
  "use strict";

  class ForceshadeError extends Error {
    constructor(result, message) {
      super(message);
      this.name = "ForceshadeError";
      this.result = result;
    }
  }

  // A value in an error's words: never the whole of a long one, and nothing that JavaScript cannot make a text of.
  function got(value) {
    if (value === null || value === undefined) return String(value);
    if (typeof value === "string") return `the text ${JSON.stringify(value.length > 40 ? value.slice(0, 40) + "…" : value)}`;
    if (typeof value === "number" || typeof value === "boolean") return `the ${typeof value} ${value}`;
    if (typeof value === "bigint") return "a BigInt";
    if (typeof value !== "object") return `a ${typeof value}`;
    return isList(value) ? `an array of ${value.length}` : "an object";
  }

  const badValue = (what, expected, words) => new ForceshadeError("BAD_VALUE", `${what}: expected ${expected}, got ${words}`);
  const isList = (value) => typeof value === "object" && value !== null && Number.isInteger(value.length) && value.length >= 0;

  // Options without a misspelt one. expected: in words, for a value that is no object.
  function known(what, options, names, expected) {
    if (typeof options !== "object" || options === null || isList(options)) throw badValue(what, expected, got(options));
    for (const name of Object.keys(options))
      if (!names.includes(name)) throw badValue(what, `some of ${names.join(", ")}`, name);
    return options;
  }

  function number(what, value) {
    if (typeof value !== "number") throw badValue(what, "a number", got(value));
    return value;
  }

  // A NUL would end it in the module, and what follows be ignored.
  function text(what, value) {
    if (typeof value !== "string") throw badValue(what, "a text", got(value));
    if (value.includes("\0")) throw badValue(what, "a text without NUL", got(value));
    return value;
  }

  const optionalText = (what, value) => (value === undefined ? null : text(what, value));

  // Its place among the names.
  function oneOf(what, value, names) {
    if (!names.includes(value)) throw badValue(what, `one of ${names.join(", ")}`, got(value));
    return names.indexOf(value);
  }

  function flag(what, value) {
    if (typeof value !== "boolean") throw badValue(what, "true or false", got(value));
    return value;
  }

  // The list up to its first place without a value, which its readers refuse; flatMap() would leave such a place out.
  function list(what, value) {
    if (!Array.isArray(value)) throw badValue(what, "an array", got(value));
    const hole = value.findIndex((one) => one === undefined);
    return hole < 0 ? value : [...value.slice(0, hole), undefined];
  }

  // An array of so many numbers, or of three for each position.
  function floats(what, values, count) {
    if (!isList(values) || (count === undefined ? values.length % 3 !== 0 : values.length !== count)) {
      const expected = count === undefined ? "an array of three numbers for each" : `an array of ${count} numbers`;
      throw badValue(what, expected, isList(values) ? `an array of ${values.length}` : got(values));
    }
    for (let i = 0; i < values.length; ++i)
      if (typeof values[i] !== "number") throw badValue(what, "numbers", `${got(values[i])} at ${i}`);
    // An array without a number may still be none: its buffer was transferred, or it is of BigInts.
    if (values.length === 0 && ArrayBuffer.isView(values))
      try {
        new Float32Array(0).set(values);
      } catch {
        throw badValue(what, "an array of numbers", "one of BigInts, or one whose buffer was transferred");
      }
    // Only then, since an object that merely has a length may have one for which there is no memory.
    return Array.isArray(values) || ArrayBuffer.isView(values) ? values : Array.from(values);
  }

  // Numbers from 0, of which WebAssembly would otherwise take the lowest 32 bits, or 8 of a status.
  function indices(what, values, most = 0xffffffff) {
    for (const value of values)
      if (!Number.isInteger(value) || value < 0 || value > most)
        throw badValue(what, `whole numbers from 0${most < 0xffffffff ? ` to ${most}` : ""}`, got(value));
    return values;
  }

  return { ForceshadeError, got, badValue, known, number, text, optionalText, oneOf, flag, list, floats, indices };
})();
