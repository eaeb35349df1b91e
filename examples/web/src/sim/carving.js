// SPDX-License-Identifier: MIT
// carving: a brush pushes the surface away from the hand, or draws it out. What faces the hand moves: a brush that comes
// through the back opens a tunnel.
import { placed, sphere } from "./shapes.js";

const depth = 0.55;  // edges that the middle of the brush moves in a frame
const stone = [0.83, 0.79, 0.72], cut = [0.36, 0.56, 0.62], grown = [0.87, 0.55, 0.36];

export const carving = {
  title: "Carving",
  hint: "Press and hold to carve; hold Shift, or choose Grow, to add. Carve through to open a tunnel.",
  action: "Grow",
  settings: { brush: 30, detail: 22 },
  remesh_interval: 2,

  make({ brush, detail }, state) {
    const mesh = placed(sphere(detail), [0, 0, 0], [1.55, 1.2, 0.55]);
    state.brush = brush;
    const colours = Array.from({ length: mesh.positions.length }, (_, i) => stone[i % 3]);
    return { ...mesh, colours, edge: 1.5 / detail };
  },

  targets(world, input) {
    const { mesh, stars, state, edge } = world;
    if (input.kind === "brush") state.brush = input.at[0];
    if (input.kind !== "carve" && input.kind !== "grow") {
      world.settled = true;
      return null;
    }
    const radius = state.brush / 100;
    const centre = input.at.slice(0, 3).map((x) => x / 1024), d = input.at.slice(3).map((x) => x / 64);
    const colour = input.kind === "carve" ? cut : grown;
    const old = mesh.positions;
    stars.measure(old, mesh.triangles);
    const { normals, sums, degrees } = stars;
    const vertices = [], targets = [];
    // The brush is a ball that dips into the surface. Carving moves what is inside along the ray until it is outside.
    const dip = input.kind === "carve" ? 0.45 * radius : 0;
    for (let v = 0, at = 0; at < old.length; ++v, at += 3) {
      const x = old[at] - centre[0] + dip * d[0], y = old[at + 1] - centre[1] + dip * d[1];
      const z = old[at + 2] - centre[2] + dip * d[2];
      const inside = radius * radius - (x * x + y * y + z * z);
      if (inside <= 0 || normals[at] * d[0] + normals[at + 1] * d[1] + normals[at + 2] * d[2] >= 0) continue;
      const near = inside / (radius * radius), along = x * d[0] + y * d[1] + z * d[2];
      const way = Math.sqrt(along * along + inside) - along;
      const push = input.kind === "carve" ? Math.min(way, depth * edge) : -depth * edge * near * near;
      vertices.push(v);
      for (let k = 0; k < 3; ++k) {
        targets.push(old[at + k] + push * d[k] + 0.1 * (sums[at + k] / degrees[v] - old[at + k]));
        world.colours[at + k] += 0.25 * Math.min(1, 2 * near) * (colour[k] - world.colours[at + k]);
      }
    }
    if (vertices.length === 0) return null;
    return { positions: new Float64Array(targets), vertices: new Uint32Array(vertices) };
  },
};
