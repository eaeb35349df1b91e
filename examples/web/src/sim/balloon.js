// SPDX-License-Identifier: MIT
// balloon: a small ball grows inside a phantom until it rests on the walls, as in the paper's section 6. Arms that meet
// close handles. The phantom is the place where a distance is negative.
import { placed, sphere } from "./shapes.js";

const speed = 0.4;  // edges for each frame, where no wall is near
const tension = 0.25;
const still = 0.004;  // edges
const finger = 0.42;  // radius of what is kept free round a pressing hand
const width = 1;  // edges: so near a wall, the balloon slows down

const length2 = (a, b) => Math.sqrt(a * a + b * b);
const length3 = (a, b, c) => Math.sqrt(a * a + b * b + c * c);
const ring = (x, y, z, radius, tube) => length2(length2(x, y) - radius, z) - tube;

export const phantoms = {
  rings: {
    title: "Two rings that cross (genus 3)",
    seed: [0, 0, 1.02],
    edge: 0.072,
    distance: (x, y, z) => Math.min(ring(x, z, y, 1.02, 0.3), ring(y, z, x, 1.02, 0.3)),
  },
  frame: {
    title: "Cube with a hollow (genus 5)",
    seed: [1.02, 1.02, 1.02],
    edge: 0.085,
    distance: (x, y, z) =>
      Math.max(Math.abs(x) - 1.15, Math.abs(y) - 1.15, Math.abs(z) - 1.15, 1.36 - length3(x, y, z)),
  },
  chain: {
    title: "Three rings in a row (genus 3)",
    seed: [-1.55, 0, 0],
    edge: 0.066,
    distance: (x, y, z) =>
      Math.min(ring(x + 1, y, z, 0.55, 0.19), ring(x, y, z, 0.55, 0.19), ring(x - 1, y, z, 0.55, 0.19)),
  },
};

export const balloon = {
  title: "Balloon",
  hint: "A balloon grows in the glass phantom; where its arms meet, a handle closes. Press on an arm to cut it.",
  action: "Next phantom",
  settings: { phantom: "rings" },
  variants: { name: "phantom", of: phantoms },
  remesh_interval: 3,

  make({ phantom }, state) {
    const { seed, edge } = phantoms[phantom];
    const radius = 0.14;
    const mesh = placed(sphere(Math.max(3, Math.round((1.2 * radius) / edge) + 1)), seed, radius);
    const colours = Array.from({ length: mesh.positions.length }, (_, i) => [0.96, 0.42, 0.38][i % 3]);
    state.distance = phantoms[phantom].distance;
    return { ...mesh, colours, edge };
  },

  targets(world, input) {
    const { mesh, stars, state, edge } = world;
    const old = mesh.positions, positions = old.slice();
    stars.measure(old, mesh.triangles);
    const { normals, sums, degrees, shortest } = stars;
    const hand = input.kind === "press" ? input.at.slice(0, 3).map((x) => x / 1024) : [1e3, 0, 0];
    let fastest = 0;
    for (let v = 0, at = 0; at < old.length; ++v, at += 3) {
      const x = old[at], y = old[at + 1], z = old[at + 2];
      const nx = normals[at], ny = normals[at + 1], nz = normals[at + 2];
      const wall = Math.max(state.distance(x, y, z), finger - length3(x - hand[0], y - hand[1], z - hand[2]));
      const drive = Math.max(-1, Math.min(1, -wall / (width * edge)));
      const push = (speed * edge * drive) / (Math.sqrt(nx * nx + ny * ny + nz * nz) + 1e-300);
      const dx = push * nx + tension * (sums[at] / degrees[v] - x);
      const dy = push * ny + tension * (sums[at + 1] / degrees[v] - y);
      const dz = push * nz + tension * (sums[at + 2] / degrees[v] - z);
      const squared = dx * dx + dy * dy + dz * dz, most = 0.2 * shortest[v];
      const scale = squared > most ? Math.sqrt(most / squared) : 1;
      positions[at] += scale * dx;
      positions[at + 1] += scale * dy;
      positions[at + 2] += scale * dz;
      fastest = Math.max(fastest, squared);
    }
    world.settled = input.kind === "none" && fastest < (still * edge) ** 2;
    return world.settled ? null : { positions };
  },
};
