// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a visitor chooses, each as a slider and as a field to type in; R, w and θ of a bump stay consistent.
"use strict";

const Controls = (() => {
  const byId = (id) => document.getElementById(id);
  const STEPS = 1000;

  // The value of a slider: four digits are enough for a thumb, a field takes all of them.
  const ofThumb = (value) => Number(value.toPrecision(4));

  const logarithmic = {
    valueOf: (part, low, high) => low * (high / low) ** part,
    partOf: (value, low, high) => Math.log(value / low) / Math.log(high / low),
  };
  const linear = {
    valueOf: (part, low, high) => low + (high - low) * part,
    partOf: (value, low, high) => (value - low) / (high - low),
  };

  // The slider `id` and the field `id-number`. range() is [low, high]; changed(value, isDone) is called for every motion of the
  // thumb, and once for a number that was typed.
  function number(id, scale, range, words, changed) {
    const slider = byId(id), field = byId(`${id}-number`);
    slider.min = 0;
    slider.max = STEPS;
    slider.step = 1;
    slider.addEventListener("input", () => {
      const [low, high] = range(), part = Number(slider.value) / STEPS;
      changed(part === 0 ? low : part === 1 ? high : Math.min(high, Math.max(low, ofThumb(scale.valueOf(part, low, high)))));
    });
    field.addEventListener("change", () => changed(field.value === "" ? NaN : Number(field.value)));
    const show = (value) => {
      const [low, high] = range();
      slider.value = Math.round(STEPS * Math.min(1, Math.max(0, scale.partOf(value, low, high))));
      slider.setAttribute("aria-valuetext", words(value));
      field.value = words(value).split(" ")[0];
    };
    return {
      show,
      enable: (isEnabled) => {
        slider.disabled = field.disabled = !isEnabled;
      },
      hide: (isHidden) => {
        byId(`${id}-row`).hidden = isHidden;
      },
    };
  }

  const LEAST = {radius: 0.1, width: 1e-3, stiffness: 1e-3}, MOST = {radius: 1e4, stiffness: 1e3};  // of the C header

  // choice: the numbers, which are replaced by changed({name: value, ...}).
  function all(choice, changed) {
    const binary32 = Math.fround;
    const inUnits = (unit) => (value) => `${Numbers.decimal(value)} ${unit}`;
    const ofRadius = (radius) => (radius >= LEAST.radius && choice().width > 2 * radius ? {radius, width: 2 * radius} : {radius});
    const ofAngle = (degrees) => {
      const width = binary32(Bump.widthOf(choice().radius, Math.min(60, degrees)));
      return {width: degrees > 0 ? Math.min(2 * choice().radius, Math.max(binary32(LEAST.width), width)) : NaN};
    };
    const rows = {
      radius: number("radius", logarithmic, () => [LEAST.radius, MOST.radius], inUnits("mm"),
        (value) => changed(ofRadius(binary32(value)))),
      width: number("width", logarithmic, () => [LEAST.width, 2 * choice().radius], inUnits("mm"),
        (value) => changed({width: binary32(value)})),
      theta: number("theta", linear, () => [0.01, 60], (degrees) => `${Number(degrees.toPrecision(6))} degrees`,
        (value) => changed(ofAngle(value))),
      stiffness: number("stiffness", logarithmic, () => [LEAST.stiffness, MOST.stiffness], inUnits("N/mm"),
        (value) => changed({stiffness: binary32(value)})),
      along: number("along", linear, () => [-15, 15], inUnits("mm"), (value) => changed({along: binary32(value)})),
      damping: number("damping", linear, () => [0, binary32(0.02)], inUnits("N·s/mm"), (value) => changed({damping: binary32(value)})),
      push: number("push", linear, () => [0, 200], (value) => `${Math.round(value)} %`, (value) => changed({push: value})),
    };

    // Shows what is chosen, and only what counts for it.
    function show() {
      const now = choice(), isLaw = now.kind === "law", isFlat = isLaw && now.law === "wall";
      for (const name of ["radius", "width", "theta"]) {
        rows[name].enable(!isFlat);
        rows[name].hide(!isLaw);
      }
      rows.along.hide(isLaw);
      for (const name of ["radius", "width", "stiffness", "along", "damping", "push"]) rows[name].show(now[name]);
      rows.theta.show(Bump.theta(now.radius, now.width));
    }
    return {show};
  }

  return {all};
})();
