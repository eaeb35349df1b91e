// SPDX-License-Identifier: MIT
// tangles: meshes that run through themselves, and the one call that makes them clean.
import { joined, placed, random, sphere, torus, tube, turn } from "./shapes.js";

const calm = [0.36, 0.6, 0.62], hot = [0.92, 0.2, 0.22];

// A tube along a trefoil, too thick for its loops.
function trefoil() {
  const point = (part) => {
    const [c, s] = turn(part), [c2, s2] = turn(2 * part), [, s3] = turn(3 * part);
    return [0.52 * (s + 2 * s2), 0.52 * (c - 2 * c2), -0.34 * s3];
  };
  return tube(220, 26, 0.36, (part) => {
    const p = point(part), q = point(part + 1e-4);
    const t = unit([q[0] - p[0], q[1] - p[1], q[2] - p[2]]);
    const u = unit(cross(t, [0, 0, 1])), v = cross(t, u);
    return { centre: p, u, v };
  });
}

// Rings that share their space.
function crossed_rings() {
  return joined([
    torus(1.05, 0.26, 0.075, [0, 1, 2]),
    placed(torus(0.95, 0.26, 0.075, [1, 2, 0]), [0.06, 0.03, 0.02]),
    placed(torus(0.85, 0.26, 0.075, [2, 0, 1]), [-0.03, 0.05, 0.04]),
    placed(sphere(9), [0.02, -0.03, 0.01], 0.52),
  ]);
}

// A ball whose points are displaced by waves, beyond their neighbours.
function crumpled() {
  const next = random(7);
  const waves = Array.from({ length: 9 }, () => ({
    direction: [0, 1, 2].map(() => 2 * next() - 1),
    push: [0, 1, 2].map(() => 0.34 * (2 * next() - 1)),
    phase: next(),
  }));
  const { positions, triangles } = sphere(20);
  const moved = positions.map((x, i) => {
    const p = positions.slice(i - (i % 3), i - (i % 3) + 3);
    return x * 1.05 + waves.reduce((sum, { direction, push, phase }) => {
      const part = 0.55 * (direction[0] * p[0] + direction[1] * p[1] + direction[2] * p[2]) + phase;
      return sum + push[i % 3] * turn(part)[1];
    }, 0);
  });
  return { positions: moved, triangles };
}

export const tangled = {
  trefoil: { title: "Trefoil, too thick", make: trefoil },
  rings: { title: "Rings and a ball", make: crossed_rings },
  crumpled: { title: "Crumpled ball", make: crumpled },
};

export const tangles = {
  title: "Tangles",
  hint: "Red triangles run through each other. One call cuts them exactly and keeps the outside.",
  action: "Untangle",
  settings: { tangle: "trefoil" },
  variants: { name: "tangle", of: tangled },
  remesh_interval: 0,

  make({ tangle }) {
    const mesh = tangled[tangle].make();
    const colours = Array.from({ length: mesh.positions.length }, (_, i) => calm[i % 3]);
    return { ...mesh, colours, edge: 0.08 };
  },

  begin(world) {
    const { mesh, colours, state } = world;
    const pairs = mesh.detect(), triangles = mesh.triangles;
    state.contacts = pairs.length / 2;
    for (const triangle of pairs)
      for (let i = 0; i < 3; ++i) colours.set(hot, 3 * triangles[3 * triangle + i]);
  },

  targets(world, input) {
    const { mesh, state } = world;
    if (input.kind === "action" && state.contacts > 0) {
      const report = mesh.adapt();
      state.contacts = report.unresolved;
      world.commit(report);
      cool(world);
    }
    world.settled = true;
    return null;
  },
};

// New vertices along the seams keep a warm colour, and all others calm down.
function cool(world) {
  const { newCount, origin } = world.mesh.vertexMap();
  for (let v = 0; v < newCount; ++v) world.colours.set(origin(v).weight < 1 ? [0.95, 0.66, 0.3] : calm, 3 * v);
  world.changed.all = true;
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a) {
  const length = Math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return a.map((x) => x / length);
}
