// SPDX-License-Identifier: MIT
// surface: the mesh of a world on the graphics processor. What a commit left alone is not sent again.
import * as three from "three";

export class Surface {
  #room = { vertices: 0, triangles: 0 };
  #toggled = false;

  constructor(scene) {
    this.material = new three.MeshStandardMaterial({ vertexColors: true, roughness: 0.36 });
    this.body = new three.Mesh(new three.BufferGeometry(), this.material);
    this.body.castShadow = this.body.receiveShadow = true;
    this.body.frustumCulled = false;
    this.lines = new three.LineSegments(
      new three.BufferGeometry(),
      new three.LineBasicMaterial({ color: 0x1d2731, transparent: true, opacity: 0.42 }),
    );
    this.lines.frustumCulled = false;
    this.lines.visible = false;
    // Lines lie a little before the faces.
    this.material.polygonOffset = true;
    this.material.polygonOffsetFactor = this.material.polygonOffsetUnits = 1;
    scene.add(this.body, this.lines);
  }

  get wireframe() {
    return this.lines.visible;
  }

  set wireframe(shown) {
    this.lines.visible = shown;
    this.#toggled = true;
  }

  /** Takes over what has changed in a world since the last time; false if nothing has. */
  update(world) {
    const { mesh, changed, colours } = world;
    if (!changed.all && changed.vertices.length + changed.triangles.length === 0) {
      const toggled = this.#toggled;
      if (toggled && this.lines.visible) this.#update_edges(mesh);
      this.#toggled = false;
      return toggled;
    }
    const grown = this.#make_room(mesh.vertexCount, mesh.triangleCount);
    const whole = { first: 0, count: mesh.vertexCount };
    const positions = mesh.positions, triangles = mesh.triangles;
    send(this.position, positions, 3, changed.all || grown ? [whole] : changed.vertices);
    send(this.index, triangles, 3,
      changed.all || grown ? [{ first: 0, count: mesh.triangleCount }] : changed.triangles);
    world.stars.measure(positions, triangles);
    send(this.normal, world.stars.normals, 3, [whole]);
    send(this.colour, as_light(softened(colours, world.stars, triangles)), 3, [whole]);
    this.body.geometry.setDrawRange(0, triangles.length);
    if (this.lines.visible) this.#update_edges(mesh);
    world.clear_changes();
    this.#toggled = false;
    return true;
  }

  // Edges, once each: half-edges with a greater number than their opposites.
  #update_edges(mesh) {
    const triangles = mesh.triangles, opposites = mesh.opposites, index = this.edge_index.array;
    let count = 0;
    for (let h = 0; h < opposites.length; ++h) {
      if (opposites[h] < h) continue;
      index[count++] = triangles[h];
      index[count++] = triangles[h % 3 === 2 ? h - 2 : h + 1];
    }
    this.edge_index.clearUpdateRanges();
    this.edge_index.addUpdateRange(0, count);
    this.edge_index.needsUpdate = true;
    this.lines.geometry.setDrawRange(0, count);
  }

  // True if the arrays were made anew.
  #make_room(vertices, triangles) {
    if (vertices <= this.#room.vertices && triangles <= this.#room.triangles) return false;
    this.#room = { vertices: Math.ceil(1.5 * vertices), triangles: Math.ceil(1.5 * triangles) };
    const attribute = (type, count, size) => {
      const made = new three.BufferAttribute(new type(count * size), size);
      return made.setUsage(three.DynamicDrawUsage);
    };
    this.position = attribute(Float32Array, this.#room.vertices, 3);
    this.normal = attribute(Float32Array, this.#room.vertices, 3);
    this.colour = attribute(Float32Array, this.#room.vertices, 3);
    this.index = attribute(Uint32Array, 3 * this.#room.triangles, 1);
    this.edge_index = attribute(Uint32Array, 3 * this.#room.triangles, 1);
    for (const object of [this.body, this.lines]) {
      object.geometry.dispose();
      object.geometry = new three.BufferGeometry();
      object.geometry.setAttribute("position", this.position);
    }
    this.body.geometry.setAttribute("normal", this.normal);
    this.body.geometry.setAttribute("color", this.colour);
    this.body.geometry.setIndex(this.index);
    this.lines.geometry.setIndex(this.edge_index);
    return true;
  }
}

// Where colours meet they lie on single vertices, in a ragged line. Means over some edges make the line soft.
const softness = 5;
function softened(colours, stars, triangles) {
  const soft = new Float32Array(colours.length), channel = new Float64Array(colours.length / 3);
  for (let k = 0; k < 3; ++k) {
    for (let v = 0; v < channel.length; ++v) channel[v] = colours[3 * v + k];
    stars.average(channel, triangles, softness);
    for (let v = 0; v < channel.length; ++v) soft[3 * v + k] = channel[v];
  }
  return soft;
}

// Colours as on a screen, in linear light: near enough by their squares.
function as_light(colours) {
  const light = new Float32Array(colours.length);
  for (let i = 0; i < colours.length; ++i) light[i] = colours[i] * colours[i];
  return light;
}

// Copies ranges of elements of `size` numbers into an attribute, and marks them for the next picture, which forgets the marks.
function send(attribute, from, size, ranges) {
  if (ranges.length === 0) return;
  for (const { first, count } of ranges) {
    const begin = size * first, end = size * (first + count);
    attribute.array.set(from.subarray(begin, end), begin);
    attribute.addUpdateRange(begin, end - begin);
  }
  attribute.needsUpdate = true;
}
