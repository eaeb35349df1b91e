// SPDX-License-Identifier: MIT
// data: what the page carries, unpacked (packing.h). All files of this folder are one script.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

async function inflated(blob) {
  const text = atob(byId("blob" + blob).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function unpackPositions(bytes, count, box) {
  const positions = new Float32Array(3 * count);
  for (let axis = 0; axis < 3; ++axis) {
    const low = 2 * axis * count, high = low + count, scale = (box[axis + 3] - box[axis]) / 65535;
    let step = 0;
    for (let v = 0; v < count; ++v) {
      const zigzag = bytes[low + v] | (bytes[high + v] << 8);
      step = (step + ((zigzag >> 1) ^ -(zigzag & 1))) & 65535;
      positions[3 * v + axis] = box[axis] + step * scale;
    }
  }
  return positions;
}

function unpackTriangles(bytes, from, count) {
  const triangles = new Uint32Array(3 * count);
  let at = from, least = 0;
  const next = () => {
    let value = 0, shift = 0, byte;
    do {
      byte = bytes[at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return value >>> 0;
  };
  for (let f = 0; f < 3 * count; f += 3) {
    least += next();
    triangles[f] = least;
    triangles[f + 1] = least + next();
    triangles[f + 2] = least + next();
  }
  return { triangles, end: at };
}

// Normals weighted by area.
function normalsOf(positions, triangles) {
  const normals = new Float32Array(positions.length);
  for (let f = 0; f < triangles.length; f += 3) {
    const a = 3 * triangles[f], b = 3 * triangles[f + 1], c = 3 * triangles[f + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const v of [a, b, c]) for (let i = 0; i < 3; ++i) normals[v + i] += n[i];
  }
  return normals;
}

const palette = [[111, 168, 220], [240, 150, 90], [110, 195, 140], [214, 120, 170], [225, 200, 90], [150, 130, 220], [90, 200, 205], [200, 110, 100]];

// A colour for each vertex by its component, the largest first.
function partColours(mesh) {
  const root = new Uint32Array(mesh.positions.length / 3);
  for (let v = 0; v < root.length; ++v) root[v] = v;
  const find = (v) => {
    while (root[v] !== v) v = root[v] = root[root[v]];
    return v;
  };
  const { triangles } = mesh;
  for (let f = 0; f < triangles.length; f += 3)
    for (let i = 1; i < 3; ++i) root[find(triangles[f])] = find(triangles[f + i]);
  const sizes = new Map();
  for (let v = 0; v < root.length; ++v) {
    root[v] = find(v);
    sizes.set(root[v], (sizes.get(root[v]) || 0) + 1);
  }
  const rank = new Map([...sizes].sort((a, b) => b[1] - a[1] || a[0] - b[0]).map(([v], i) => [v, i]));
  const colours = new Uint8Array(4 * root.length);
  for (let v = 0; v < root.length; ++v) colours.set([...palette[rank.get(root[v]) % palette.length], 255], 4 * v);
  return colours;
}

// Each edge once: its other triangle names it the other way round.
function edgesOf(triangles) {
  const edges = [];
  for (let f = 0; f < triangles.length; f += 3)
    for (let i = 0; i < 3; ++i) {
      const v = triangles[f + i], w = triangles[f + ((i + 1) % 3)];
      if (v < w) edges.push(v, w);
    }
  return new Uint32Array(edges);
}

const unpacked = new Map();

async function frameMesh(index) {
  if (unpacked.has(index)) return unpacked.get(index);
  const frame = data.frames[index], bytes = await inflated(frame.blob);
  const positions = unpackPositions(bytes, frame.vertices, frame.box);
  const { triangles, end } = unpackTriangles(bytes, 6 * frame.vertices, frame.triangles);
  const marked = [];
  if (frame.marked)
    for (let f = 0; f < frame.triangles; ++f)
      if (bytes[end + f]) marked.push(triangles[3 * f], triangles[3 * f + 1], triangles[3 * f + 2]);
  const mesh = { positions, triangles, marked: new Uint32Array(marked), normals: normalsOf(positions, triangles) };
  unpacked.set(index, mesh);
  return mesh;
}

async function volumeBytes() {
  const bytes = await inflated(data.volume.blob), width = data.volume.size[0];
  for (let i = 0; i < bytes.length; ++i) if (i % width > 0) bytes[i] += bytes[i - 1];
  return bytes;
}

// 12,345 and 1.23e6, with a comma in the thousands.
function text(number, digits = 5) {
  if (Number.isInteger(number)) return number.toLocaleString("en-US");
  return Number(number.toPrecision(digits)).toLocaleString("en-US", { maximumSignificantDigits: digits });
}
