// SPDX-License-Identifier: BSD-3-Clause
// The picture: the surface in section, the hand's point, the cursor that is pushed aside, and the arrows of the forces.
"use strict";

const Drawing = (() => {
  // A picture of so many pixels shows at least the width, and at least from bottom to top, all in mm.
  function boxOf(fit, pixels) {
    const scale = Math.min(pixels.width / fit.width, pixels.height / (fit.top - fit.bottom));  // pixels per mm
    const middle = (fit.top + fit.bottom) / 2;
    const halfWidth = pixels.width / scale / 2, halfHeight = pixels.height / scale / 2;
    return {left: -halfWidth, right: halfWidth, bottom: middle - halfHeight, top: middle + halfHeight, scale};
  }

  const toPixels = (box, x, z) => [(x - box.left) * box.scale, (box.top - z) * box.scale];
  const toMillimetres = (box, px, py) => [box.left + px / box.scale, box.top - py / box.scale];

  // The largest of 1, 2 and 5 times a power of ten that is not above the value.
  function rounded(value) {
    const decade = 10 ** Math.floor(Math.log10(value));
    const step = [5, 2, 1].find((digit) => digit * decade <= value) ?? 1;
    return Number((step * decade).toPrecision(1));
  }

  // Pixels per newton. Within a decade of the stiffness an arrow grows with it; the bar says how much it means.
  const forceScale = (box, stiffness) => (3 * box.scale) / 10 ** Math.ceil(Math.log10(stiffness) - 1e-9);

  function path(context, box, points) {
    context.beginPath();
    points.forEach(([x, z], k) => {
      const [px, py] = toPixels(box, x, z);
      if (k === 0) context.moveTo(px, py);
      else context.lineTo(px, py);
    });
  }

  function surface(context, box, shape, colours) {
    path(context, box, shape.area);
    context.fillStyle = colours.surface;
    context.fill();
    path(context, box, shape.line);
    context.strokeStyle = colours.edge;
    context.lineWidth = 2;
    context.lineJoin = "round";
    context.stroke();
    if (shape.felt.length === 0) return;
    path(context, box, shape.felt);
    context.setLineDash([6, 5]);
    context.stroke();
    context.setLineDash([]);
  }

  function arrow(context, from, [dx, dy], colour, width, dash = []) {
    const length = Math.hypot(dx, dy);
    if (!(length > 1)) return;
    const head = Math.min(3.2 * width, length), ux = dx / length, uy = dy / length;
    const tip = [from[0] + dx, from[1] + dy], neck = [tip[0] - head * ux, tip[1] - head * uy];
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...neck);
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(...tip);
    context.lineTo(neck[0] - 0.55 * head * uy, neck[1] + 0.55 * head * ux);
    context.lineTo(neck[0] + 0.55 * head * uy, neck[1] - 0.55 * head * ux);
    context.fill();
  }

  function disc(context, [px, py], radius, fill, border) {
    context.beginPath();
    context.arc(px, py, radius, 0, 2 * Math.PI);
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    context.strokeStyle = border;
    context.lineWidth = 2;
    context.stroke();
  }

  function bar(context, pixels, row, length, text, colours, colour) {
    const right = pixels.width - 14, y = 20 + 20 * row;
    context.strokeStyle = colour;
    context.lineWidth = 3;
    context.beginPath();
    context.moveTo(right - length, y);
    context.lineTo(right, y);
    context.stroke();
    context.fillStyle = colours.ink;
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.font = "13px system-ui, sans-serif";
    context.fillText(text, right - length - 8, y);
  }

  // The difference of the two forces is drawn this many times as long as the forces.
  const MAGNIFIED = 1e6, LONGEST = 70;  // pixels

  // scene: {box, shape, stiffness, point, cursor, force, naive (or null), godObject (or null), showsHand}; in mm and N.
  function draw(context, pixels, scene, colours) {
    const {box} = scene;
    context.clearRect(0, 0, pixels.width, pixels.height);
    context.fillStyle = colours.air;
    context.fillRect(0, 0, pixels.width, pixels.height);
    surface(context, box, scene.shape, colours);

    const perNewton = forceScale(box, scene.stiffness);
    const bars = {newton: rounded(Math.min(110, pixels.width / 4) / perNewton), mm: rounded(pixels.width / 5 / box.scale)};
    bar(context, pixels, 0, bars.newton * perNewton, `${bars.newton} N`, colours, colours.exact);
    bar(context, pixels, 1, bars.mm * box.scale, `${bars.mm} mm`, colours, colours.ink);

    const hand = toPixels(box, scene.point[0], scene.point[2]), cursor = toPixels(box, scene.cursor[0], scene.cursor[2]);
    context.strokeStyle = colours.ink;
    context.lineWidth = 1;
    if (scene.godObject) {
      const god = toPixels(box, scene.godObject[0], scene.godObject[2]);
      context.beginPath();
      context.moveTo(...hand);
      context.lineTo(...god);
      context.stroke();
      disc(context, god, 6, colours.air, colours.ink);
    }
    if (scene.showsHand) {
      context.beginPath();
      context.moveTo(...hand);
      context.lineTo(...cursor);
      context.stroke();
      disc(context, hand, 5, null, colours.ink);
    }

    const onScreen = ([x, , z]) => [x * perNewton, -z * perNewton];
    if (scene.naive) {
      const beside = [cursor[0] + 12, cursor[1]], along = onScreen(scene.naive);
      arrow(context, beside, along, colours.naive, 4);
      const error = onScreen(scene.naive.map((value, k) => (value - scene.force[k]) * MAGNIFIED));
      const shrink = Math.min(1, LONGEST / Math.hypot(...error));
      if (Math.hypot(...error) > 0)
        arrow(context, [beside[0] + along[0], beside[1] + along[1]], error.map((value) => value * shrink), colours.difference, 3, [4, 3]);
    }
    arrow(context, cursor, onScreen(scene.force), colours.exact, 5);
    disc(context, cursor, 9, colours.tip, colours.air);
  }

  return {boxOf, toMillimetres, toPixels, draw};
})();
