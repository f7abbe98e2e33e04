// SPDX-License-Identifier: BSD-3-Clause
// The surfaces to stroke: a law, a height map or a mesh. Each has a subject of the library that answers with forces, a section to draw,
// and what the view has to show.
"use strict";

const Surfaces = (() => {
  const statusOf = (answer) => ({force: Array.from(answer.force), status: answer.status});

  const near = (value) => Number(value.toPrecision(3));

  // choice: {law, radius, width, stiffness}; lengths in mm, stiffness in N/mm.
  function law(lib, choice) {
    const parameters = {radius: choice.radius, width: choice.width, stiffness: choice.stiffness};
    const subject = lib.law(choice.law, parameters);
    const {h} = Bump.geometry(choice.radius, choice.width), w = choice.width;
    return {
      subject,
      fit: {width: 1.8 * w, top: h + 0.28 * w, bottom: -0.42 * w},
      start: [near(0.27 * w), 0, near(-0.12 * w)],
      begin: () => {},
      to: (point) => statusOf(subject.force(point)),
      naive: (point) => Naive.force(choice.law, parameters, point),
      godObject: () => null,
      section: (y, box) => Bump.section(choice.law, choice.radius, w, box),
      close: () => subject.close(),
    };
  }

  const COLUMNS = 49, SPACING = 0.75;  // mm; the middle of the grid is the origin
  const MAPS = {
    "hills": (x, y) => 3.2 * Math.exp(-((x + 5) ** 2 + y * y) / 22) - 2.2 * Math.exp(-((x - 6) ** 2 + (y - 2) ** 2) / 16),
    "ripples": (x, y) => 1.1 * Math.cos(0.9 * x + 0.25 * y) * Math.exp(-(x * x + y * y) / 160),
  };

  function heightsOf(name) {
    const heights = new Float32Array(COLUMNS * COLUMNS), middle = (COLUMNS - 1) / 2;
    for (let row = 0; row < COLUMNS; ++row)
      for (let column = 0; column < COLUMNS; ++column)
        heights[row * COLUMNS + column] = MAPS[name]((column - middle) * SPACING, (row - middle) * SPACING);
    return heights;
  }

  // choice: {map, render, stiffness}. What is drawn comes from the library, too: deep below a map of stiffness 1 the size of the
  // force is the height of the map above the hand.
  function map(lib, choice) {
    const grid = {heights: heightsOf(choice.map), columns: COLUMNS, rows: COLUMNS, pitch: SPACING};
    const subject = lib.heightMap({...grid, render: choice.render, stiffness: choice.stiffness});
    const probe = lib.heightMap({...grid, render: "height-map", stiffness: 1});
    const isFlat = choice.render === "height-map-shaded", deep = -64;
    const profile = (y, box) => {
      const count = 241, positions = new Float32Array(3 * count);
      for (let k = 0; k < count; ++k) positions.set([box.left + ((box.right - box.left) * k) / (count - 1), y, deep], 3 * k);
      const {forces} = probe.forces(positions);
      return Array.from({length: count}, (_, k) => [positions[3 * k], Math.hypot(...forces.slice(3 * k, 3 * k + 3)) + deep]);
    };
    return {
      subject,
      fit: {width: 34, top: 6.5, bottom: -9.5},
      start: [-2.5, 0, -0.6],
      begin: () => {},
      to: (point) => statusOf(subject.force(point)),
      naive: () => null,
      godObject: () => null,
      section: (y, box) => {
        const shape = profile(y, box), line = isFlat ? [[box.left, 0], [box.right, 0]] : shape;
        return {area: [...line, [box.right, box.bottom], [box.left, box.bottom]], line, felt: isFlat ? shape : []};
      },
      close: () => {
        subject.close();
        probe.close();
      },
    };
  }

  const SIZE = 10, GOLDEN = (1 + Math.sqrt(5)) / 2;  // mm from the middle to a corner
  const MESHES = {
    "octahedron": {
      corners: [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
      triangles: [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
    },
    "icosahedron": {
      corners: [[-1, 0, GOLDEN], [1, 0, GOLDEN], [-1, 0, -GOLDEN], [1, 0, -GOLDEN], [0, GOLDEN, 1], [0, GOLDEN, -1],
        [0, -GOLDEN, 1], [0, -GOLDEN, -1], [GOLDEN, 1, 0], [-GOLDEN, 1, 0], [GOLDEN, -1, 0], [-GOLDEN, -1, 0]],
      triangles: [[0, 1, 4], [0, 4, 9], [9, 4, 5], [4, 8, 5], [4, 1, 8], [8, 1, 10], [8, 10, 3], [5, 8, 3], [5, 3, 2], [2, 3, 7],
        [7, 3, 10], [7, 10, 6], [7, 6, 11], [11, 6, 0], [0, 6, 1], [6, 10, 1], [9, 11, 0], [9, 2, 11], [9, 5, 2], [7, 11, 2]],
    },
  };

  // The corners at the distance SIZE from the middle, and each triangle turned so that its front is outside.
  function triangled(name) {
    const {corners, triangles} = MESHES[name];
    const at = corners.map((corner) => corner.map((value) => Math.fround((SIZE * value) / Math.hypot(...corner))));
    const isOutward = ([a, b, c]) => {
      const u = at[b].map((value, k) => value - at[a][k]), v = at[c].map((value, k) => value - at[a][k]);
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      return normal.reduce((sum, value, k) => sum + value * at[a][k], 0) > 0;
    };
    return {at, faces: triangles.map(([a, b, c]) => (isOutward([a, b, c]) ? [a, b, c] : [a, c, b]))};
  }

  // The section of a convex mesh by the plane y = constant: the points on its edges, in their order around the middle.
  function cut({at, faces}, y) {
    const points = [];
    for (const face of faces)
      for (let k = 0; k < 3; ++k) {
        const a = at[face[k]], b = at[face[(k + 1) % 3]];
        if (a[1] === b[1] || (a[1] - y) * (b[1] - y) > 0) continue;
        const part = (y - a[1]) / (b[1] - a[1]);
        points.push([a[0] + part * (b[0] - a[0]), a[2] + part * (b[2] - a[2])]);
      }
    const x = points.reduce((sum, point) => sum + point[0], 0) / points.length;
    const z = points.reduce((sum, point) => sum + point[1], 0) / points.length;
    return points.sort((a, b) => Math.atan2(a[1] - z, a[0] - x) - Math.atan2(b[1] - z, b[0] - x));
  }

  const PARTS = 2 ** 24;  // of an edge, in the state of a session

  // The god-object of a state (mm), or null where it is in the open.
  function pointOf({at, faces}, state) {
    const along = (from, to, part) => to.map((value, k) => (part / PARTS) * (value - from[k]));
    const sum = (a, b) => a.map((value, k) => value + b[k]);
    const [i, j] = state.index, [k, l] = state.parameter;
    if (state.place === "at-vertex") return at[i];
    if (state.place === "on-edge") return sum(at[i], along(at[i], at[j], k));
    if (state.place !== "in-triangle") return null;
    const [a, b, c] = faces[i].map((corner) => at[corner]);
    return sum(sum(a, along(a, b, k)), along(a, c, l));
  }

  // choice: {mesh, shading, stiffness}.
  function mesh(lib, choice) {
    const shape = triangled(choice.mesh);
    const subject = lib.mesh({
      vertices: Float32Array.from(shape.at.flat()),
      triangles: Uint32Array.from(shape.faces.flat()),
      shading: choice.shading,
      stiffness: choice.stiffness,
    });
    const path = subject.session();
    return {
      subject,
      fit: {width: 34, top: 13, bottom: -12},
      start: [3.2, 0, 3.6],
      // A path begins straight above, in the open: one that began inside would meet no surface.
      begin: ([x, y]) => {
        path.reset();
        path.step([x, y, 4 * SIZE]);
      },
      to: (point) => statusOf(path.step(point)),
      naive: () => null,
      godObject: () => pointOf(shape, path.state()),
      section: (y) => {
        const points = cut(shape, y);
        return {area: points, line: points.length ? [...points, points[0]] : [], felt: []};
      },
      close: () => {
        path.close();
        subject.close();
      },
    };
  }

  return {law, map, mesh};
})();
