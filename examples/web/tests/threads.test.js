// SPDX-License-Identifier: MIT
// Meshes with threads, in Node: the same bits, ended by another thread, and no worker left over.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test as try_it } from "node:test";
import { Worker } from "node:worker_threads";
import { load } from "topoadapt-wasm";
import { sphere } from "../src/sim/shapes.js";

const threads_module = new URL("../topoadapt-wasm/topoadapt-threads.wasm", import.meta.url);
const skip = existsSync(threads_module) ? undefined : "no topoadapt-threads.wasm";
const test = (name, act) => try_it(name, { skip }, act);

const ball = sphere(60);  // 36 002 vertices

function ball_of(library) {
  const mesh = library.mesh({ maxVertices: 60000 });
  mesh.load(new Float64Array(ball.positions), new Uint32Array(ball.triangles));
  return mesh;
}

// Until the workers wait in the module.
async function all_at_work(mesh, library) {
  for (let i = 0; i < 200 && mesh.threads < library.threads; ++i) await new Promise((go) => setTimeout(go, 10));
}

test("threads change no bit", async () => {
  const serial = ball_of(await load()), library = await load({ threads: 3 }), shared = ball_of(library);
  assert.equal(serial.threads, 1);
  await all_at_work(shared, library);
  assert.equal(shared.threads, 3);
  for (const mesh of [serial, shared])
    for (let i = 0; i < 3; ++i) {
      mesh.move(mesh.positions.map((x, k) => (k % 3 === 2 ? 0.95 * x : x)));
      mesh.step();
      mesh.remesh(0.02);
      mesh.smooth(2);
    }
  assert.equal(shared.digest(), serial.digest());
  shared.close();
  assert.equal(shared.threads, 1);
  shared.smooth(1);
  serial.smooth(1);
  assert.equal(shared.digest(), serial.digest());
});

test("a mesh grows in shared memory", async () => {
  const library = await load({ threads: 2 }), mesh = library.mesh({ maxVertices: 8 });
  mesh.load(new Float64Array(ball.positions), new Uint32Array(ball.triangles));
  assert.equal(mesh.vertexCount, ball.positions.length / 3);
  assert.equal(mesh.validate().selfIntersections, 0);
  mesh.close();
});

test("another thread ends a call", async () => {
  const library = await load({ threads: 2 }), mesh = ball_of(library), digest = mesh.digest();
  assert.ok(mesh.cancelled.buffer instanceof SharedArrayBuffer);
  const ending = `const { workerData, parentPort } = require("node:worker_threads");
    parentPort.postMessage("ready");
    setTimeout(() => Atomics.store(workerData, 0, 1), 200);`;
  const other = new Worker(ending, { eval: true, workerData: mesh.cancelled });
  await new Promise((go) => other.once("message", go));
  assert.throws(() => {
    for (let i = 0; i < 10000; ++i) mesh.detect(), mesh.validate();
  }, ({ code }) => code === "E_CANCELLED");
  assert.equal(mesh.digest(), digest);
  mesh.cancelled[0] = 0;
  mesh.validate();
  mesh.close();
  await other.terminate();
});

test("a flag ends calls of a mesh without threads, too", async () => {
  const mesh = ball_of(await load());
  mesh.cancelled[0] = 1;
  assert.throws(() => mesh.validate(), ({ code }) => code === "E_CANCELLED");
  mesh.cancelled[0] = 0;
  mesh.validate();
});

test("numbers of threads that are none are refused", async () => {
  for (const threads of [0, -1, 1.5, "2"]) await assert.rejects(load({ threads }), RangeError);
});

test("the module of threads imports a memory alone", () => {
  const module = new WebAssembly.Module(readFileSync(threads_module));
  assert.deepEqual(WebAssembly.Module.imports(module), [{ module: "env", name: "memory", kind: "memory" }]);
});
