// SPDX-License-Identifier: MIT
// blobs: drops of a thick fluid, drawn by the hand. Surface tension rounds them, and each keeps its volume.
import { NONE } from "topoadapt-wasm";
import { joined, placed, sphere } from "./shapes.js";

const tension = 0.5, rounds = 2;  // of smoothing in a frame: the pace at which a drop becomes round
const thin = 2.4, snapping = 0.25;  // beyond this curvature, a neck that is pulled gives way by so many edges in a frame
const neighbourhood = 6;  // edges over which the curvature of a neck is a mean: bumps of an edge are no necks
const most_flow = 0.5;  // edges that tension moves in a frame
const most_pull = 0.9;  // edges that the hand moves in a frame
const thinning = 0.8;  // of what stretches; 0.5 keeps its volume
const lobe = [0.75, 1.35], inside = 0.6;  // reaches of the grip, and how deep its middle lies under the hand
const still = 2e-4;  // edges: a fluid that moves less has come to rest

const bodies = [
  { centre: [-1.5, 0.1, 0], radius: 0.95, colour: [0.93, 0.36, 0.27] },
  { centre: [1.15, -0.45, 0.15], radius: 0.8, colour: [0.13, 0.52, 0.78] },
  { centre: [0.75, 1.35, -0.1], radius: 0.6, colour: [0.96, 0.71, 0.2] },
];

export const blobs = {
  title: "Blobs",
  hint: "Drag one blob into another: they merge. Pull a lobe away until its neck snaps.",
  action: "Next blob",
  settings: { detail: 18 },
  remesh_interval: 4,

  make({ detail }, state) {
    const edge = 1.2 / detail;
    const colours = [];
    const parts = bodies.map(({ centre, radius, colour }) => {
      const mesh = placed(sphere(Math.round(detail * radius)), centre, radius);
      for (let v = 0; 3 * v < mesh.positions.length; ++v) colours.push(...colour);
      return mesh;
    });
    state.hand = null;
    return { ...joined(parts), colours, edge };
  },

  begin(world) {
    world.state.volumes = new Map(world.components.map(({ id, volume }) => [id, volume]));
  },

  targets(world, input) {
    const { mesh, stars, state } = world;
    const { components, labels } = mesh.labelledComponents();
    const wanted = wanted_volumes(world, components);
    const old = mesh.positions, positions = old.slice();
    stars.measure(old, mesh.triangles);
    const { normals } = stars;
    const swell = components.map(({ volume, area }, i) => (wanted[i] - volume) / area);
    const grip = grip_of(world, input, labels, old);
    stars.relax(positions, mesh.triangles, tension, rounds);
    const most = (most_flow * world.edge) ** 2;
    const curvatures = grip === null ? null : curvatures_of(world, old, positions);
    let fastest = 0;
    for (let v = 0, at = 0; at < old.length; ++v, at += 3) {
      const nx = normals[at], ny = normals[at + 1], nz = normals[at + 2];
      const length = Math.sqrt(nx * nx + ny * ny + nz * nz) + 1e-300;
      const neck = labels[v] === grip?.label ? stretched(old, at, grip) : 0;
      const snap = neck === 0 ? 0 : neck * Math.max(0, Math.min(1, curvatures[v] / thin - 1)) * snapping * world.edge;
      const push = (swell[labels[v]] - snap) / length;
      const dx = positions[at] - old[at] + push * nx;
      const dy = positions[at + 1] - old[at + 1] + push * ny;
      const dz = positions[at + 2] - old[at + 2] + push * nz;
      const squared = dx * dx + dy * dy + dz * dz;
      const scale = squared > most ? Math.sqrt(most / squared) : 1;
      positions[at] = old[at] + scale * dx;
      positions[at + 1] = old[at + 1] + scale * dy;
      positions[at + 2] = old[at + 2] + scale * dz;
      if (grip !== null && labels[v] === grip.label) drag(positions, at, old, grip);
      fastest = Math.max(fastest, squared);
    }
    world.settled = input.kind === "none" && fastest < (still * world.edge) ** 2;
    return world.settled ? null : { positions };
  },
};

// The sum of the principal curvatures at each vertex, as smoothing felt it.
function curvatures_of({ mesh, stars, edge }, old, smoothed) {
  const { normals } = stars, curvatures = new Float64Array(old.length / 3);
  for (let v = 0, at = 0; at < old.length; ++v, at += 3) {
    const nx = normals[at], ny = normals[at + 1], nz = normals[at + 2];
    const length = Math.sqrt(nx * nx + ny * ny + nz * nz) + 1e-300;
    const flow = (smoothed[at] - old[at]) * nx + (smoothed[at + 1] - old[at + 1]) * ny + (smoothed[at + 2] - old[at + 2]) * nz;
    curvatures[v] = -flow / (length * 0.25 * tension * rounds * edge * edge);
  }
  stars.average(curvatures, mesh.triangles, neighbourhood);
  return curvatures;
}

// The volume of each component: as before, and anew after an event that joined or parted components.
function wanted_volumes(world, components) {
  const { volumes } = world.state;
  const same = components.length === volumes.size && components.every(({ before }) => volumes.has(before) );
  const known = components.map(({ id, before, volume }) => (same ? volumes.get(before) : volume));
  world.state.volumes = new Map(components.map(({ id }, i) => [id, known[i]]));
  return known;
}

// The hand holds the vertex that was nearest at first, and takes it to the pointer at a limited speed.
function grip_of(world, input, labels, positions) {
  const { state, edge } = world;
  if (input.kind !== "pull") {
    state.hand = null;
    world.held = NONE;
    return null;
  }
  const goal = input.at.slice(0, 3).map((x) => x / 1024);
  if (world.held === NONE) {
    world.held = nearest(positions, state.hand ?? goal);
    const n = world.stars.normals.slice(3 * world.held, 3 * world.held + 3);
    const length = Math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) + 1e-300;
    if (state.hand === null) state.inwards = [...n].map((x) => (-inside * x) / length);
  }
  const from = [0, 1, 2].map((k) => positions[3 * world.held + k]);
  const way = goal.map((x, k) => x - from[k]);
  const distance = Math.sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
  const part = distance > most_pull * edge ? (most_pull * edge) / distance : 1;
  const move = way.map((x) => part * x);
  state.hand = from.map((x, k) => x + move[k]);
  return { middle: from.map((x, k) => x + state.inwards[k]), move, label: labels[world.held] };
}

// 1 in the middle of what stretches, 0 in the lobe and far from it.
function stretched(old, at, { middle }) {
  const x = old[at] - middle[0], y = old[at + 1] - middle[1], z = old[at + 2] - middle[2];
  const part = Math.max(0, Math.min(1, (lobe[1] - Math.sqrt(x * x + y * y + z * z)) / (lobe[1] - lobe[0])));
  return 4 * part * (1 - part);
}

// The lobe round the middle of the grip moves as one. What lies behind stretches, and thins as it stretches.
function drag(positions, at, old, { middle, move }) {
  const x = old[at] - middle[0], y = old[at + 1] - middle[1], z = old[at + 2] - middle[2];
  const distance = Math.sqrt(x * x + y * y + z * z), width = lobe[1] - lobe[0];
  const part = Math.max(0, Math.min(1, (lobe[1] - distance) / width));
  const pull = part * part * (3 - 2 * part), slope = (6 * part * (1 - part)) / width;
  const squared = move[0] * move[0] + move[1] * move[1] + move[2] * move[2] + 1e-300;
  const along = x * move[0] + y * move[1] + z * move[2];
  const thinner = thinning * slope * Math.max(0, -along / (distance + 1e-300));
  const aside = (thinner * along) / squared;
  positions[at] += pull * move[0] + aside * move[0] - thinner * x;
  positions[at + 1] += pull * move[1] + aside * move[1] - thinner * y;
  positions[at + 2] += pull * move[2] + aside * move[2] - thinner * z;
}

function nearest(positions, point) {
  let found = 0, least = Infinity;
  for (let v = 0, at = 0; at < positions.length; ++v, at += 3) {
    const x = positions[at] - point[0], y = positions[at + 1] - point[1], z = positions[at + 2] - point[2];
    const squared = x * x + y * y + z * z;
    if (squared < least) {
      least = squared;
      found = v;
    }
  }
  return found;
}
