// SPDX-License-Identifier: MIT
// Mesh: a context of the library in the memory of an instance of its own.
import { error_of } from "./errors.js";
import { read, structures } from "./layout.js";

const OK = 0;
const E_LIMIT = -7;
const FLOAT32 = 1, FLOAT64 = 2, UINT16 = 3, UINT32 = 4;
export const NONE = 0xffffffff;

// Slots of memory for small structures.
const ISSUE = 0, TEXT = 1, INPUT = 2, REPORT = 3, EXEC = 4, RESULT = 5, CONFIG = 6, SIZE = 7, CANCEL = 8;

const limits = ["", "max_vertices", "max_triangles", "max_contacts", "max_cut_edges", "max_events", "max_components",
  "max_pieces", "max_substeps"];
const config_fields = {
  maxVertices: "max_vertices",
  maxTriangles: "max_triangles",
  maxContacts: "max_contacts",
  maxCutEdges: "max_cut_edges",
  maxEvents: "max_events",
  maxComponents: "max_components",
  maxPieces: "max_pieces",
  maxSubsteps: "max_substeps",
  detectMode: "detect_mode",
  cellSize: "cell_size",
  region: "region",
  maxPasses: "max_passes",
  maxCandidates: "max_candidates",
  smoothIterations: "smooth_iterations",
  smoothLambda: "smooth_lambda",
  smoothMu: "smooth_mu",
};

const event_types = ["", "handle", "cap", "removal", "rollback", "merge", "split", "genus-up", "genus-down", "", "death"];

// Workers of meshes that nobody closed.
const forgotten = new FinalizationRegistry((workers) => workers.forEach((worker) => worker.terminate()));

export class Mesh {
  #memory;
  #context = 0;
  #grow;
  #max_bytes;
  #views = new Map();

  /** See index.d.ts. */
  constructor(memory, options = {}) {
    this.#memory = memory;
    if (memory.workers.length > 0) forgotten.register(this, [...memory.workers]);
    const { grow = true, maxBytes = 2 ** 30, ...fields } = options;
    this.#grow = grow;
    this.#max_bytes = maxBytes;
    const m = this.#memory;
    m.put(CONFIG, "tpa_config");
    this.#check(m.calls.tpa_config_init(m.slot(CONFIG), structures.tpa_config.size));
    m.set(CONFIG, "tpa_config", { max_vertices: 16384 });
    for (const [name, value] of Object.entries(fields)) {
      if (config_fields[name] === undefined) throw new TypeError(`no option ${name}`);
      m.set(CONFIG, "tpa_config", { [config_fields[name]]: value });
    }
    this.#place((at, bytes) => m.calls.tpa_init(at, bytes, m.slot(CONFIG), m.slot(RESULT), m.slot(ISSUE)));
  }

  // ---------------------------------------------------------------- mesh in and out

  load(positions, triangles) {
    this.#run((m) =>
      m.calls.tpa_load(
        this.#context,
        m.put(INPUT, "tpa_mesh_input", {
          vertex_count: positions.length / 3,
          triangle_count: triangles.length / 3,
          position_type: number_type(positions),
          index_type: number_type(triangles),
          positions: m.stage_copy(positions),
          triangles: m.stage_copy(triangles),
        }),
        m.slot(ISSUE),
      ),
    );
  }

  get vertexCount() {
    return this.#view().vertex_count;
  }

  get triangleCount() {
    return this.#view().triangle_count;
  }

  get epoch() {
    return this.#view().epoch;
  }

  get positions() {
    const view = this.#view();
    return this.#array("positions", Float64Array, view.positions, 3 * view.vertex_count);
  }

  get triangles() {
    const view = this.#view();
    return this.#array("triangles", Uint32Array, view.triangles, 3 * view.triangle_count);
  }

  get opposites() {
    const view = this.#view();
    return this.#array("opposites", Uint32Array, view.opposites, 3 * view.triangle_count);
  }

  move(targets, vertices = null) {
    const wanted = vertices?.length ?? this.vertexCount;
    if (targets.length !== 3 * wanted)
      throw new RangeError(`${targets.length} numbers in place of 3 for each of ${wanted} vertices`);
    this.#run((m) =>
      m.calls.tpa_move(
        this.#context,
        m.put(INPUT, "tpa_move_input", {
          count: targets.length / 3,
          position_type: number_type(targets),
          positions: m.stage_copy(targets),
          vertices: m.stage_copy(vertices),
        }),
        m.slot(ISSUE),
      ),
    );
  }

  dropTargets() {
    this.#check(this.#memory.calls.tpa_drop_targets(this.#context));
  }

  // ---------------------------------------------------------------- work

  step(options) {
    return this.#work(options, (m, exec) =>
      m.calls.tpa_step(this.#context, exec, m.slot(REPORT), m.slot(ISSUE)));
  }

  advance(thickness, options) {
    return this.#work(options, (m, exec) =>
      m.calls.tpa_advance(this.#context, thickness, exec, m.slot(REPORT), m.slot(ISSUE)));
  }

  adapt(options) {
    return this.#work(options, (m, exec) =>
      m.calls.tpa_adapt(this.#context, exec, m.slot(REPORT), m.slot(ISSUE)));
  }

  remesh(targetLength, options = {}) {
    const { iterations = 1, splitRatio = 0, collapseRatio = 0, relaxation = 0.5, vertices = null, lengths = null } = options;
    return this.#work(options, (m, exec) => {
      const input = m.put(INPUT, "tpa_remesh_options", {
        iterations,
        target_length: targetLength,
        split_ratio: splitRatio,
        collapse_ratio: collapseRatio,
        relaxation,
        count: vertices?.length ?? 0,
        vertices: m.stage_copy(vertices),
        lengths: m.stage_copy(lengths),
      });
      return m.calls.tpa_remesh(this.#context, input, exec, m.slot(REPORT), m.slot(ISSUE));
    });
  }

  smooth(iterations, options = {}) {
    const { vertices = null } = options;
    return this.#work(options, (m, exec) => {
      const input = m.put(INPUT, "tpa_smooth_options", {
        iterations,
        count: vertices?.length ?? 0,
        vertices: m.stage_copy(vertices),
      });
      return m.calls.tpa_smooth(this.#context, input, exec, m.slot(REPORT), m.slot(ISSUE));
    });
  }

  reorder() {
    this.#run((m) => m.calls.tpa_reorder(this.#context, m.slot(ISSUE)));
  }

  detect(options = {}) {
    this.#run((m) =>
      m.calls.tpa_detect(this.#context, this.#exec(options), m.put(RESULT, "tpa_contacts"), m.slot(ISSUE)));
    const { count, pairs } = this.#memory.get(RESULT, "tpa_contacts");
    return new Uint32Array(this.#memory.buffer, pairs, 2 * count).slice();
  }

  validate(options = {}) {
    this.#run((m) =>
      m.calls.tpa_validate(this.#context, this.#exec(options), m.put(RESULT, "tpa_validation"), m.slot(ISSUE)));
    const { self_intersections, ...rest } = this.#memory.get(RESULT, "tpa_validation");
    delete rest.struct_size;
    return { selfIntersections: self_intersections, ...rest };
  }

  // ---------------------------------------------------------------- results of the last commit

  events() {
    const m = this.#memory;
    this.#check(m.calls.tpa_events(this.#context, m.slot(RESULT), m.slot(RESULT) + 4));
    const at = m.u32(m.slot(RESULT)), count = m.u32(m.slot(RESULT) + 4);
    return Array.from({ length: count }, (_, i) => {
      const event = read(m.data, structures.tpa_event, at + i * structures.tpa_event.size);
      return { ...event, type: event_types[event.type] };
    });
  }

  get componentCount() {
    const m = this.#memory;
    this.#check(m.calls.tpa_components(this.#context, 0, 0, 0, m.slot(RESULT), m.slot(ISSUE)));
    return m.u32(m.slot(RESULT));
  }

  components() {
    return this.#components(false).components;
  }

  labelledComponents() {
    return this.#components(true);
  }

  rolledBack() {
    const m = this.#memory;
    this.#check(m.calls.tpa_rolled_back(this.#context, m.slot(RESULT), m.slot(RESULT) + 4));
    return new Uint32Array(m.buffer, m.u32(m.slot(RESULT)), m.u32(m.slot(RESULT) + 4)).slice();
  }

  vertexMap() {
    const m = this.#memory;
    this.#check(m.calls.tpa_vertex_map(this.#context, m.put(RESULT, "tpa_vertex_map_view")));
    const map = m.get(RESULT, "tpa_vertex_map_view");
    const oldToNew = new Uint32Array(m.buffer, map.old_to_new, map.old_count);
    // Three words for each origin: two parents and a weight.
    const words = new Uint32Array(m.buffer, map.origins, 3 * map.new_count);
    const weights = new Float32Array(m.buffer, map.origins, 3 * map.new_count);
    const origin = (v) => ({ parents: [words[3 * v], words[3 * v + 1]], weight: weights[3 * v + 2] });
    return { oldCount: map.old_count, newCount: map.new_count, oldToNew, origin };
  }

  triangleMap() {
    const m = this.#memory;
    this.#check(m.calls.tpa_triangle_map(this.#context, m.put(RESULT, "tpa_triangle_map_view")));
    const map = m.get(RESULT, "tpa_triangle_map_view");
    return {
      oldCount: map.old_count,
      newCount: map.new_count,
      origins: new Uint32Array(m.buffer, map.origins, map.new_count),
    };
  }

  changes(options = {}) {
    const { gap = 0, capacity = 64 } = options;
    const m = this.#memory;
    m.unstage();
    const vertices = m.stage(8 * capacity), triangles = m.stage(8 * capacity);
    const list = m.put(RESULT, "tpa_change_list", {
      gap,
      vertex_capacity: capacity,
      triangle_capacity: capacity,
      vertices,
      triangles,
    });
    this.#check(m.calls.tpa_changes(this.#context, list, m.slot(ISSUE)));
    const found = m.get(RESULT, "tpa_change_list");
    const ranges = (at, count) =>
      Array.from({ length: count }, (_, i) => ({ first: m.u32(at + 8 * i), count: m.u32(at + 8 * i + 4) }));
    return {
      vertices: ranges(vertices, found.vertex_ranges),
      triangles: ranges(triangles, found.triangle_ranges),
      changedVertices: found.changed_vertices,
      changedTriangles: found.changed_triangles,
      oldVertexCount: found.old_vertex_count,
      oldTriangleCount: found.old_triangle_count,
      vertexCount: found.vertex_count,
      triangleCount: found.triangle_count,
    };
  }

  carryVertices(before, floats) {
    return this.#carry("tpa_carry_vertices", before, floats, this.vertexMap().oldCount, this.vertexCount);
  }

  carryTriangles(before, floats) {
    return this.#carry("tpa_carry_triangles", before, floats, this.triangleMap().oldCount, this.triangleCount);
  }

  // ---------------------------------------------------------------- state

  save() {
    const m = this.#memory;
    m.unstage();
    m.calls.tpa_save(this.#context, 0, 0, m.slot(RESULT), m.slot(ISSUE));
    const bytes = m.u32(m.slot(RESULT)), at = m.stage(bytes);
    this.#check(m.calls.tpa_save(this.#context, at, bytes, m.slot(RESULT), m.slot(ISSUE)));
    return new Uint8Array(m.buffer, at, bytes).slice();
  }

  restore(state) {
    this.#run((m) => m.calls.tpa_restore(this.#context, m.stage_copy(state), state.length, m.slot(ISSUE)));
  }

  digest() {
    const m = this.#memory;
    this.#check(m.calls.tpa_digest(this.#context, m.slot(RESULT)));
    return m.data.getBigUint64(m.slot(RESULT), true);
  }

  get threads() {
    const m = this.#memory;
    return m.workers.length > 0 ? 1 + m.calls.web_workers() : 1;
  }

  get cancelled() {
    const m = this.#memory;
    return new Int32Array(m.buffer, m.slot(CANCEL), 1);
  }

  close() {
    this.#memory.close();
  }

  get bytes() {
    return this.#memory.buffer.byteLength;
  }

  // ---------------------------------------------------------------- within

  #check(status) {
    if (status === OK) return;
    const m = this.#memory;
    // Calls without an issue fail for their arguments or state alone.
    if (m.data.getInt32(m.slot(ISSUE), true) !== status) m.put(ISSUE, "tpa_issue", { status });
    throw error_of(m, ISSUE, TEXT);
  }

  // Makes a call, and again in a larger block after each limit that is reached. The call stages its arrays each time.
  #run(call) {
    const m = this.#memory;
    for (;;) {
      m.unstage();
      const status = call(m);
      if (status !== E_LIMIT || !this.#grow) return this.#check(status);
      const error = error_of(m, ISSUE, TEXT);
      if (!this.#enlarge(error)) throw error;
    }
  }

  #work(options = {}, call) {
    this.#run((m) => {
      m.put(REPORT, "tpa_report");
      return call(m, this.#exec(options));
    });
    return report_of(this.#memory.get(REPORT, "tpa_report"));
  }

  #exec({ budget = 0 }) {
    const m = this.#memory, parallel_for = m.workers.length > 0 ? m.calls.web_parallel_for() : 0;
    return m.put(EXEC, "tpa_exec", { budget, parallel_for, cancel: m.slot(CANCEL) });
  }

  // Raises a limit to twice its value, and at least enough. False where no block of this size may be had.
  #enlarge({ limit, needed, available }) {
    const m = this.#memory, before = m.get(CONFIG, "tpa_config")[limits[limit]];
    m.set(CONFIG, "tpa_config", { [limits[limit]]: Math.min(Math.max(2 * available, needed), NONE) });
    const status = m.calls.tpa_arena_query(m.slot(CONFIG), m.slot(SIZE), m.slot(ISSUE));
    if (status !== OK || m.get(SIZE, "tpa_arena_size").bytes > this.#max_bytes) {
      m.set(CONFIG, "tpa_config", { [limits[limit]]: before });
      return false;
    }
    this.#place((at, bytes) =>
      m.calls.tpa_grow(this.#context, at, bytes, m.slot(CONFIG), m.slot(RESULT), m.slot(ISSUE)));
    return true;
  }

  // Makes a context of the present config in a new block by `fill`, and puts the block in the place of the old one.
  #place(fill) {
    const m = this.#memory;
    this.#check(m.calls.tpa_arena_query(m.slot(CONFIG), m.slot(SIZE), m.slot(ISSUE)));
    const { bytes, alignment } = m.get(SIZE, "tpa_arena_size");
    const at = m.room_for_block(bytes, alignment);
    this.#check(fill(at, bytes));
    this.#context = m.adopt_block(at, bytes, alignment);
  }

  #view() {
    const m = this.#memory;
    this.#check(m.calls.tpa_view(this.#context, m.put(RESULT, "tpa_mesh_view")));
    return m.get(RESULT, "tpa_mesh_view");
  }

  // A view over the memory; the last one of the name, where it still fits.
  #array(name, type, at, length) {
    const last = this.#views.get(name);
    const buffer = this.#memory.buffer;
    if (last?.buffer === buffer && last.byteOffset === at && last.length === length) return last;
    const array = new type(buffer, at, length);
    this.#views.set(name, array);
    return array;
  }

  #components(wants_labels) {
    const m = this.#memory;
    const count = this.componentCount, labels_bytes = wants_labels ? 4 * this.vertexCount : 0;
    m.unstage();
    const at = m.stage(count * structures.tpa_component.size);
    const labels = wants_labels ? m.stage(labels_bytes) : 0;
    this.#check(m.calls.tpa_components(this.#context, at, count, labels, m.slot(RESULT), m.slot(ISSUE)));
    const components = Array.from({ length: count }, (_, i) => {
      const { reserved, ...component } = read(m.data, structures.tpa_component, at + i * structures.tpa_component.size);
      return component;
    });
    return { components, labels: new Uint32Array(m.buffer, labels, labels_bytes / 4).slice() };
  }

  #carry(name, before, floats, old_count, new_count) {
    if (before.length !== floats * old_count)
      throw new RangeError(`${before.length} numbers in place of ${floats} for each of ${old_count} elements`);
    const m = this.#memory;
    m.unstage();
    const from = m.stage_copy(before), to = m.stage(4 * floats * new_count);
    this.#check(m.calls[name](this.#context, from, floats, to));
    return new Float32Array(m.buffer, to, floats * new_count).slice();
  }
}

function number_type(array) {
  if (array instanceof Float64Array) return FLOAT64;
  if (array instanceof Float32Array) return FLOAT32;
  if (array instanceof Uint32Array) return UINT32;
  if (array instanceof Uint16Array) return UINT16;
  throw new TypeError("a Float64Array, Float32Array, Uint32Array or Uint16Array is wanted");
}

// The fields of tpa_report in camel case.
function report_of(fields) {
  const report = {};
  for (const [name, value] of Object.entries(fields))
    if (name !== "struct_size" && name !== "reserved")
      report[name.replace(/_(.)/g, (_, letter) => letter.toUpperCase())] = value;
  return report;
}
