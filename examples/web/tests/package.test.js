// SPDX-License-Identifier: MIT
// The package topoadapt-wasm, in Node.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { NONE, TopoadaptError } from "topoadapt-wasm";
import { approach, library, two_balls } from "./shapes.js";

// The enclosed volume, from the triangles alone.
function volume_of({ positions: p, triangles: t }) {
  let sum = 0;
  for (let h = 0; h < t.length; h += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => p.subarray(3 * t[h + i], 3 * t[h + i] + 3));
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

test("the module imports nothing and tells its version", () => {
  const module = new WebAssembly.Module(readFileSync(new URL("../topoadapt-wasm/topoadapt.wasm", import.meta.url)));
  assert.deepEqual(WebAssembly.Module.imports(module), []);
  assert.match(library.version, /^\d+\.\d+\.\d+$/);
  assert.ok(library.buildInfo.includes(library.version));
});

test("two balls become one, and the arrays say so", () => {
  const mesh = two_balls();
  assert.equal(mesh.components().length, 2);
  let merges = [];
  for (let i = 0; i < 10 && merges.length === 0; ++i) {
    approach(mesh, 0.05);
    merges = mesh.events().filter(({ type }) => type === "merge");
  }
  assert.equal(merges.length, 1);
  const handle = mesh.events().find(({ type }) => type === "handle");
  assert.ok(Math.hypot(...handle.position) < 0.3, `handle at ${handle.position}`);
  const [component, ...others] = mesh.components();
  assert.deepEqual([others.length, component.genus, component.vertices], [0, 0, mesh.vertexCount]);
  assert.ok(Math.abs(component.volume - volume_of(mesh)) < 1e-9);
  assert.equal(mesh.vertexCount - mesh.triangles.length / 2 + mesh.triangleCount, 2);
  mesh.opposites.forEach((other, h, opposites) => assert.equal(opposites[other], h));
  const { selfIntersections, components } = mesh.validate();
  assert.deepEqual([selfIntersections, components], [0, 1]);
});

test("changes are what differs", () => {
  const mesh = two_balls();
  const at = 30, before = mesh.positions.slice();
  mesh.move(new Float64Array(before.subarray(3 * at, 3 * at + 3).map((x) => 1.01 * x)), new Uint32Array([at]));
  const report = mesh.step();
  assert.equal(report.contacts, 0);
  const { vertices, triangles, changedVertices } = mesh.changes();
  assert.deepEqual([vertices, triangles, changedVertices], [[{ first: at, count: 1 }], [], 1]);
  const differing = mesh.positions.findIndex((x, i) => x !== before[i]);
  assert.equal(Math.floor(differing / 3), at);
});

test("a reached limit grows the context, with the same bits", () => {
  const run = (options) => {
    const mesh = two_balls(options);
    for (let i = 0; i < 10; ++i) approach(mesh, 0.05);
    return mesh;
  };
  const plenty = run({ maxVertices: 65536 });
  const little = run({ maxVertices: 4, maxContacts: 1, maxCutEdges: 3, maxEvents: 1 });
  assert.equal(little.digest(), plenty.digest());
  assert.ok(little.bytes < plenty.bytes);
  assert.throws(() => run({ maxVertices: 4, grow: false }), ({ code, limit }) => code === "E_LIMIT" && limit === 1);
  assert.throws(() => run({ maxVertices: 4, maxBytes: 100000 }), ({ code }) => code === "E_LIMIT");
});

test("views are taken again after the memory has grown", () => {
  const mesh = two_balls({ maxVertices: 1284 });
  const old = mesh.positions, volume = volume_of(mesh);
  assert.equal(mesh.positions, old);
  mesh.remesh(0.08, { iterations: 3 });
  assert.equal(old.length, 0, "the old view is detached");
  assert.equal(mesh.positions.length, 3 * mesh.vertexCount);
  assert.ok(mesh.vertexCount > 1284);
  assert.ok(Math.abs(volume_of(mesh) / volume - 1) < 0.02);
});

test("attributes follow the maps", () => {
  const mesh = two_balls();
  const ones = new Float32Array(mesh.vertexCount).fill(1), faces = new Float32Array(mesh.triangleCount).fill(2);
  while (mesh.componentCount > 1) approach(mesh, 0.05);
  assert.ok(mesh.carryVertices(ones, 1).every((x) => x === 1));
  assert.ok(mesh.carryTriangles(faces, 1).every((x) => x === 2));
  const { oldToNew, origin, oldCount } = mesh.vertexMap();
  assert.equal(oldCount, ones.length);
  for (let old = 0; old < oldCount; ++old)
    if (oldToNew[old] !== NONE) assert.deepEqual(origin(oldToNew[old]), { parents: [old, NONE], weight: 1 });
  assert.throws(() => mesh.carryVertices(ones.subarray(1), 1), RangeError);
});

test("a saved state goes on alike", () => {
  const mesh = two_balls(), other = library.mesh({ maxVertices: 8 });
  approach(mesh, 0.05);
  other.restore(mesh.save());
  assert.equal(other.digest(), mesh.digest());
  for (const each of [mesh, other]) for (let i = 0; i < 6; ++i) approach(each, 0.05);
  assert.equal(other.digest(), mesh.digest());
});

test("a tangled mesh is detected and untangled", () => {
  const mesh = two_balls();
  const { positions, triangles } = mesh;
  const tangled = library.mesh();
  tangled.load(positions.map((x, i) => (i % 3 === 0 ? x - 0.5 * Math.sign(x) : x)), triangles);
  const pairs = tangled.detect();
  assert.ok(pairs.length > 0 && pairs.length % 2 === 0);
  assert.throws(() => tangled.step(), ({ code }) => code === "E_TANGLED");
  assert.equal(tangled.adapt().unresolved, 0);
  assert.equal(tangled.detect().length, 0);
  assert.equal(tangled.componentCount, 1);
  const moved = tangled.smooth(2).moved;
  assert.ok(moved > 0);
  const before = tangled.positions.slice();
  tangled.reorder();
  assert.notDeepEqual(tangled.positions.slice(), before);
  assert.deepEqual(tangled.carryVertices(Float32Array.from(before), 3), Float32Array.from(tangled.positions));
});

test("errors are exceptions that say what is wrong, and change nothing", () => {
  const mesh = two_balls(), digest = mesh.digest();
  const fails = (act, code, text) =>
    assert.throws(act, (error) => error instanceof TopoadaptError && error.code === code && text.test(error.message));
  fails(() => mesh.load(new Float64Array(9), new Uint32Array(3)), "E_ARGUMENT", /vertex_count/);
  fails(() => mesh.load(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
    new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 3, 2])), "E_MESH", /edge/);
  fails(() => mesh.move(new Float64Array([NaN, 0, 0]), new Uint32Array([0])), "E_MESH", /vertex 0/);
  for (const stale of [mesh.positions.slice(3), new Float64Array(2 * mesh.positions.length), new Float64Array(0)])
    assert.throws(() => mesh.move(stale), /for each of \d+ vertices/);
  assert.throws(() => mesh.move(new Float64Array(6), new Uint32Array([0])), RangeError);
  fails(() => mesh.remesh(-1), "E_ARGUMENT", /target_length/);
  fails(() => mesh.restore(new Uint8Array(100)), "E_DATA", /./);
  fails(() => library.mesh().step(), "E_STATE", /./);
  fails(() => library.mesh({ maxPasses: 1000 }), "E_CONFIG", /max_passes/);
  assert.throws(() => library.mesh({ maxPass: 1 }), TypeError);
  assert.throws(() => mesh.move([0, 0, 0], new Uint32Array([0])), TypeError);
  assert.equal(mesh.digest(), digest);
  fails(() => {
    mesh.move(mesh.positions.map((x) => 1.01 * x));
    mesh.step({ budget: 1 });
  }, "E_BUDGET", /./);
});

test("the types name what is there", () => {
  const types = readFileSync(new URL("../topoadapt-wasm/index.d.ts", import.meta.url), "utf8");
  const [body] = /export class Mesh \{[^}]*?\n\}/s.exec(types.replace(/\{[^{}\n]*\}/g, ""));
  const told = [...body.matchAll(/^ {2}(?:readonly )?(\w+)[(:]/gm)].map(([, name]) => name).sort();
  const names = Object.getOwnPropertyNames(two_balls().constructor.prototype).sort();
  assert.deepEqual(told, names.filter((name) => name !== "constructor"));
});
