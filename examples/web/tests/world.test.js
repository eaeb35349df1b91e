// SPDX-License-Identifier: MIT
// The scenes without a picture: what a user does has the topology to show for it, and the same bits when told again.
import assert from "node:assert/strict";
import { test } from "node:test";
import "./raw_deflate.js";
import { World, idle, tool } from "../src/sim/world.js";
import { Inputs, address_of, parse } from "../src/sim/share.js";
import { hit } from "../src/view/hit.js";
import { library } from "./shapes.js";

function play(world, frames, input_of, inputs = new Inputs()) {
  const marks = [];
  for (let frame = 0; frame < frames; ++frame) {
    const input = input_of(frame);
    inputs.add(input);
    world.frame(input);
    marks.push(...world.marks);
  }
  return marks;
}

// The vertex that lies furthest along the x-axis, in a direction.
function end_of(mesh, sign) {
  let best = 0;
  for (let at = 0; at < mesh.positions.length; at += 3)
    if (sign * mesh.positions[at] > sign * mesh.positions[best]) best = at;
  return [...mesh.positions.subarray(best, best + 3)];
}

test("a blob dragged into another merges, and dragged away splits", () => {
  const world = new World(library, "blobs", { detail: 10 });
  const right = [-0.55, 0.1, 0];
  const merged = play(world, 60, (f) => tool("pull", [right[0] + 0.03 * Math.min(f, 40), 0, 0]));
  assert.deepEqual(merged.map(({ type }) => type), ["merge"]);
  assert.equal(world.components.length, 2);
  const left = end_of(world.mesh, -1);
  const split = play(world, 120, (f) => tool("pull", [left[0] - 0.05 * Math.min(f, 70), left[1], left[2]]));
  assert.ok(split.some(({ type }) => type === "split"), JSON.stringify(split));
  assert.equal(world.mesh.validate().selfIntersections, 0);
});

test("a balloon finds the genus of its phantom", () => {
  const world = new World(library, "balloon", { phantom: "chain" });
  play(world, 260, () => idle);
  assert.deepEqual([world.components.length, world.genus], [1, 3]);
  const cut = play(world, 70, () => tool("press", [1.55, 0, 0]));
  assert.equal(cut.filter(({ type }) => type === "genus-down").length, 1);
  assert.equal(world.genus, 2);
});

test("a brush that comes through opens a tunnel", () => {
  const world = new World(library, "carving", { detail: 14 });
  const ray = { origin: [0.2, 0.1, 5], direction: [0, 0, -1] };
  const before = world.volume;
  const marks = play(world, 60, () => {
    const point = hit(world.mesh, ray);
    return point === null ? idle : tool("carve", point, ray.direction);
  });
  assert.deepEqual(marks.map(({ type }) => type), ["genus-up"]);
  assert.equal(world.genus, 1);
  assert.ok(world.volume < before);
});

for (const tangle of ["trefoil", "rings", "crumpled"])
  test(`one call untangles: ${tangle}`, () => {
    const world = new World(library, "tangles", { tangle });
    assert.ok(world.mesh.detect().length > 0);
    play(world, 1, () => ({ kind: "action" }));
    assert.equal(world.mesh.detect().length, 0);
  });

test("an address tells a scene bit for bit", async () => {
  const settings = { brush: 34, detail: 12 };
  const world = new World(library, "carving", settings), inputs = new Inputs();
  play(world, 40, (f) => {
    if (f === 20) return { kind: "brush", at: [20, 0, 0, 0, 0, 0] };
    return f % 9 === 0 ? idle : tool(f > 25 ? "grow" : "carve", [0.3 - 0.01 * f, 0.2, 0.5], [0.1, 0, -1]);
  }, inputs);
  const view = [1, 2, 3], digest = world.mesh.digest();
  const text = await address_of({ scene: "carving", settings, view, inputs, digest });
  assert.ok(text.length < 600, text);
  const told = await parse(text);
  assert.deepEqual([told.scene, told.settings, told.view], ["carving", settings, view]);
  assert.equal(told.inputs.frames, 40);
  const again = new World(library, told.scene, told.settings);
  for (const input of told.inputs) again.frame(input);
  assert.equal(again.mesh.digest(), digest);
  assert.equal(told.digest, digest.toString(16));
  assert.equal(await parse(""), null);
  await assert.rejects(parse("scene=carving&inputs=AAAA"));
  await assert.rejects(parse("scene=carving&detail=100000"));
  await assert.rejects(parse("scene=balloon&phantom=constructor"));
  assert.equal((await parse("scene=balloon&phantom=frame")).settings.phantom, "frame");
});

// Differences between neighbours of how far each lies from the mean of its own, in edges: bumps of the size of an edge.
function roughness({ mesh, stars, edge }) {
  const { positions, triangles } = mesh;
  stars.measure(positions, triangles);
  const { sums, degrees, normals } = stars;
  const heights = Array.from({ length: mesh.vertexCount }, (_, v) => {
    const n = [0, 1, 2].map((k) => normals[3 * v + k]), length = Math.hypot(...n);
    return n.reduce((sum, x, k) => sum + ((sums[3 * v + k] / degrees[v] - positions[3 * v + k]) * x) / length, 0) / edge;
  });
  let sum = 0;
  triangles.forEach((v, h) => (sum += (heights[v] - heights[triangles[h % 3 === 2 ? h - 2 : h + 1]]) ** 2));
  return Math.sqrt(sum / triangles.length);
}

test("a blob pulled quickly into another stays smooth", () => {
  const world = new World(library, "blobs");
  const smooth = roughness(world);
  for (let f = 0; f < 46; ++f) world.frame(tool("pull", f < 2 ? [-0.6, 0.1, 0.1] : [0.6, 0.1, 0.1]));
  assert.equal(world.components.length, 2);
  assert.ok(smooth < 0.01 && roughness(world) < 0.015, `${smooth} ${roughness(world)}`);
});
