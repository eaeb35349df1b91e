// SPDX-License-Identifier: MIT
// Unites the components of a mesh by Manifold (the package manifold-3d of npm, compiled to WebAssembly).
//
//   node cut_manifold.mjs FOLDER    with FOLDER/node_modules/manifold-3d
//
// Standard input: as doubles, the counts of coordinates and of corners, then both. Standard output: seconds of
// processor time, then the same of the union. Manifold's meshes have coordinates in single precision.
import fs from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const entry = path.resolve(process.argv[2], 'node_modules/manifold-3d/manifold.js');
const manifold = await (await import(pathToFileURL(entry))).default();
manifold.setup();

const bytes = fs.readFileSync(0);
const input = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
const mesh = new manifold.Mesh({
  numProp: 3,
  vertProperties: new Float32Array(input.subarray(2, 2 + input[0])),
  triVerts: new Uint32Array(input.subarray(2 + input[0], 2 + input[0] + input[1])),
});

const bodies = manifold.Manifold.ofMesh(mesh).decompose();
const start = process.cpuUsage();
const union = manifold.Manifold.union(bodies);
const result = union.getMesh();
const used = process.cpuUsage(start);
if (union.status() !== 'NoError') process.exit(1);

const numbers = Float64Array.from(
    [(used.user + used.system) / 1e6, result.vertProperties.length, result.triVerts.length,
     ...result.vertProperties, ...result.triVerts]);
fs.writeSync(1, new Uint8Array(numbers.buffer));
