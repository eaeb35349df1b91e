// SPDX-License-Identifier: MIT
// world: a scene at work, without a picture. A frame depends on the scene, its settings and the inputs so far alone: the
// same inputs give the same bits in every browser.
import { Stars } from "./stars.js";
import { scenes } from "./scenes.js";
import { NONE } from "topoadapt-wasm";

/** What a user does in a frame. Points are in units of 1/1024, directions of 1/64: whole numbers, so they can be told. */
export const idle = { kind: "none" };
export function tool(kind, point, direction = [0, 0, 0]) {
  return { kind, at: [...point.map((x) => Math.round(1024 * x)), ...direction.map((x) => Math.round(64 * x))] };
}

export class World {
  constructor(library, name, settings = {}) {
    this.name = name;
    this.scene = scenes[name];
    this.settings = { ...this.scene.settings, ...settings };
    this.library = library;
    this.stars = new Stars();
    this.frames = 0;
    this.settled = false;
    this.marks = [];
    this.state = {};
    this.held = NONE;  // a vertex followed through the commits
    const start = this.scene.make(this.settings, this.state);
    this.edge = start.edge;
    this.mesh = library.mesh({ maxVertices: 16384 });
    this.mesh.load(new Float64Array(start.positions), new Uint32Array(start.triangles));
    this.colours = new Float32Array(start.colours);
    this.#name_components();
    this.changed = { all: true, vertices: [], triangles: [] };
    this.scene.begin?.(this);
  }

  /** Advances by a frame. marks receives the events; changed, what to draw anew. */
  frame(input = idle) {
    ++this.frames;
    this.marks = [];
    if (input.kind !== "none") this.settled = false;
    if (this.settled) return;
    const targets = this.scene.targets(this, input);
    if (targets !== null) {
      this.mesh.move(targets.positions, targets.vertices ?? null);
      this.commit(this.mesh.step());
      const interval = this.scene.remesh_interval;
      const every = typeof interval === "number" ? interval : 0;
      if (every > 0 && this.frames % every === 0) {
        const report = this.mesh.remesh(this.edge, { relaxation: 0.4 });
        if (report.splits + report.collapses + report.flips + report.moved > 0) this.commit(report);
      }
    }
  }

  /** Takes over what a call of the library changed. */
  commit(report) {
    const changes = this.mesh.changes({ capacity: 32, gap: 16 });
    const { changed } = this;
    if (changed.all || changed.vertices.length + changed.triangles.length > 0) {
      changed.all = true;
    } else {
      changed.vertices = changes.vertices;
      changed.triangles = changes.triangles;
    }
    const events = this.mesh.events();
    const renumbered = report.contacts > 0 || report.splits + report.collapses > 0 || events.length > 0;
    if (this.held !== NONE) this.held = this.mesh.vertexMap().oldToNew[this.held];
    if (renumbered) this.colours = this.mesh.carryVertices(this.colours, 3);
    this.report = report;
    if (events.length > 0) this.#mark(events);
    this.#name_components();
  }

  clear_changes() {
    this.changed = { all: false, vertices: [], triangles: [] };
  }

  get genus() {
    return this.components.reduce((sum, component) => sum + component.genus, 0);
  }

  get volume() {
    return this.components.reduce((sum, component) => sum + component.volume, 0);
  }

  #name_components() {
    this.components = this.mesh.components();
  }

  // One mark for all events of a type. Handles and caps have places; that of others is the middle of the new vertices.
  #mark(events) {
    const placed = events.find((event) => event.type === "handle" || event.type === "cap");
    const place = placed?.position ?? this.#middle_of_new();
    for (const type of ["merge", "split", "genus-up", "genus-down", "death", "rollback"]) {
      const alike = events.filter((event) => event.type === type);
      const position = type === "rollback" ? alike[0]?.position : place;
      if (alike.length === 0 || position === null) continue;
      const amount = type === "split" ? alike.length : alike.reduce((sum, event) => sum + event.amount, 0);
      this.marks.push({ type, amount, position: [...position] });
    }
  }

  #middle_of_new() {
    const { newCount, origin } = this.mesh.vertexMap();
    const positions = this.mesh.positions, sum = [0, 0, 0];
    let count = 0;
    for (let v = 0; v < newCount; ++v) {
      if (origin(v).parents[1] === NONE) continue;
      ++count;
      for (let k = 0; k < 3; ++k) sum[k] += positions[3 * v + k];
    }
    return count === 0 ? null : sum.map((x) => x / count);
  }
}
