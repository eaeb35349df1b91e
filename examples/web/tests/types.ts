// SPDX-License-Identifier: MIT
// A program that tsc checks: the types of topoadapt-wasm allow what works, and nothing else.
import { load, Mesh, NONE, TopoadaptError, type Component, type Report } from "topoadapt-wasm";

export async function merge(bytes: ArrayBuffer): Promise<Component[]> {
  const library = await load(bytes);
  const { threads } = await load({ threads: 4 });
  if (threads > 1) return [];
  const mesh: Mesh = library.mesh({ maxVertices: 1000, grow: true });
  mesh.load(new Float32Array(12), new Uint16Array(12));
  try {
    mesh.move(mesh.positions.map((x) => 1.1 * x));
    const report: Report = mesh.step({ budget: 1e6 });
    mesh.remesh(0.1, { iterations: 2, relaxation: 0.5 });
    const ids: Uint32Array = mesh.detect();
    Atomics.store(mesh.cancelled, 0, 0);
    for (const { type, position } of mesh.events()) if (type === "handle") position.map((x) => x + ids.length);
    if (report.handles[0] > 0 && mesh.vertexMap().oldToNew[0] === NONE) mesh.smooth(1, { vertices: ids });
  } catch (error) {
    if (error instanceof TopoadaptError && error.code === "E_LIMIT") return [];
    throw error;
  }
  return mesh.components();
}

declare const mesh: Mesh;
// @ts-expect-error plain arrays are no typed arrays
mesh.move([0, 0, 0]);
// @ts-expect-error views are not for assignment
mesh.positions = new Float64Array(3);
// @ts-expect-error meshes come from a library
new Mesh();
// @ts-expect-error no such option
mesh.remesh(0.1, { sweeps: 1 });
