// SPDX-License-Identifier: BSD-3-Clause
// The forces of a shaded bump and of a cube. Run it with `node example.mjs` where the package is installed.
import { load } from "forceshade";

const library = await load();
const bump = library.law("bump-2p-shaded", { radius: 15.24, width: 25.4, stiffness: 0.5 });
const { force, status } = bump.force([3, 0, -0.5]);
console.log(`${bump.parameters}: ${status}, ${Array.from(force).join(" ")} N`);

const cube = library.mesh({
  vertices: [0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 0, 0, 9, 9, 0, 9, 9, 9, 9, 0, 9, 9],
  triangles: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7],
  shading: "edge",
  stiffness: 0.5,
});
const path = cube.session(); // a mesh's force depends on the path
path.step([4, 4, 10]);
const pressed = path.step([4, 4, 8.5]);
console.log(`cube: ${pressed.status}, ${Array.from(pressed.force).join(" ")} N, ${path.state().place}`);
