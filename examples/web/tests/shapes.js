// SPDX-License-Identifier: MIT
// What the tests share: the library, and two balls that come together.
import { load } from "topoadapt-wasm";
import { joined, placed, sphere } from "../src/sim/shapes.js";

export const library = await load();

export function two_balls(options) {
  const ball = sphere(8);
  const { positions, triangles } = joined([placed(ball, [-1.2, 0, 0]), placed(ball, [1.2, 0.1, 0])]);
  const mesh = library.mesh(options);
  mesh.load(new Float64Array(positions), new Uint32Array(triangles));
  return mesh;
}

/** Moves all vertices towards the plane x = 0. */
export function approach(mesh, distance) {
  mesh.move(mesh.positions.map((x, i) => (i % 3 === 0 ? x - Math.sign(x) * distance : x)));
  return mesh.step();
}
