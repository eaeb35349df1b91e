// SPDX-License-Identifier: MIT
// layout: the structures of topoadapt.h in the memory of a 32-bit module. Every field has its natural alignment, which
// tests/layout.test.js compares with the compiler's.

const sizes = { u32: 4, i32: 4, f32: 4, pointer: 4, u64: 8, i64: 8, f64: 8 };

/** The layout of a structure: fields by name, with "type" or "type*count". */
function structure(fields) {
  const layout = { size: 0, fields: {} };
  let alignment = 4;
  for (const [name, what] of Object.entries(fields)) {
    const [type, count] = what.split("*");
    const size = sizes[type];
    const offset = Math.ceil(layout.size / size) * size;
    layout.fields[name] = { type, offset, count: count === undefined ? 0 : Number(count) };
    layout.size = offset + size * Number(count ?? 1);
    alignment = Math.max(alignment, size);
  }
  layout.size = Math.ceil(layout.size / alignment) * alignment;
  return layout;
}

const getters = {
  u32: (data, at) => data.getUint32(at, true),
  i32: (data, at) => data.getInt32(at, true),
  f32: (data, at) => data.getFloat32(at, true),
  f64: (data, at) => data.getFloat64(at, true),
  pointer: (data, at) => data.getUint32(at, true),
  u64: (data, at) => Number(data.getBigUint64(at, true)),
  i64: (data, at) => Number(data.getBigInt64(at, true)),
};
const setters = {
  u32: (data, at, value) => data.setUint32(at, value, true),
  i32: (data, at, value) => data.setInt32(at, value, true),
  f32: (data, at, value) => data.setFloat32(at, value, true),
  f64: (data, at, value) => data.setFloat64(at, value, true),
  pointer: (data, at, value) => data.setUint32(at, value, true),
  u64: (data, at, value) => data.setBigUint64(at, BigInt(value), true),
  i64: (data, at, value) => data.setBigInt64(at, BigInt(value), true),
};

/** The fields of the structure at an address, as an object. */
export function read(data, layout, at) {
  const values = {};
  for (const [name, { type, offset, count }] of Object.entries(layout.fields)) {
    const get = (i) => getters[type](data, at + offset + i * sizes[type]);
    values[name] = count === 0 ? get(0) : Array.from({ length: count }, (_, i) => get(i));
  }
  return values;
}

/** Zeros the structure at an address, and sets its struct_size and the given fields. */
export function write(data, layout, at, values) {
  for (let i = 0; i < layout.size; i += 4) data.setUint32(at + i, 0, true);
  if (layout.fields.struct_size !== undefined) data.setUint32(at, layout.size, true);
  update(data, layout, at, values);
}

/** Sets the given fields of the structure at an address. */
export function update(data, layout, at, values) {
  for (const [name, value] of Object.entries(values)) {
    const { type, offset } = layout.fields[name];
    setters[type](data, at + offset, value);
  }
}

export const structures = {
  tpa_issue: structure({
    status: "i32",
    defect: "i32",
    limit: "i32",
    argument: "i32",
    element: "u64",
    other: "u64",
    needed: "u64",
    available: "u64",
  }),
  tpa_config: structure({
    struct_size: "u32",
    cookie: "u32",
    max_vertices: "u32",
    max_triangles: "u32",
    max_contacts: "u32",
    max_cut_edges: "u32",
    max_events: "u32",
    max_components: "u32",
    max_pieces: "u32",
    detect_mode: "u32",
    cell_size: "f64",
    region: "u32",
    max_passes: "u32",
    max_candidates: "u32",
    smooth_iterations: "u32",
    smooth_lambda: "f64",
    smooth_mu: "f64",
    max_substeps: "u32",
    reserved: "u32",
  }),
  tpa_arena_size: structure({ bytes: "u32", alignment: "u32" }),
  tpa_mesh_input: structure({
    struct_size: "u32",
    vertex_count: "u32",
    triangle_count: "u32",
    position_type: "u32",
    index_type: "u32",
    position_stride: "u32",
    triangle_stride: "u32",
    positions: "pointer",
    triangles: "pointer",
  }),
  tpa_mesh_view: structure({
    struct_size: "u32",
    vertex_count: "u32",
    triangle_count: "u32",
    reserved: "u32",
    epoch: "u64",
    positions: "pointer",
    triangles: "pointer",
    opposites: "pointer",
  }),
  tpa_move_input: structure({
    struct_size: "u32",
    count: "u32",
    position_type: "u32",
    position_stride: "u32",
    positions: "pointer",
    vertices: "pointer",
  }),
  tpa_exec: structure({
    struct_size: "u32",
    flags: "u32",
    user: "pointer",
    parallel_for: "pointer",
    budget: "u64",
    cancel: "pointer",
    progress: "pointer",
  }),
  tpa_contacts: structure({ struct_size: "u32", count: "u32", pairs: "pointer" }),
  tpa_validation: structure({
    struct_size: "u32",
    components: "u32",
    self_intersections: "u64",
    euler: "i64",
    genus: "i64",
    volume: "f64",
    area: "f64",
  }),
  tpa_report: structure({
    struct_size: "u32",
    passes: "u32",
    contacts: "u32",
    groups: "u32",
    handles: "u32*4",
    caps: "u32",
    removed_patches: "u32",
    rolled_back_vertices: "u32",
    unresolved: "u32",
    splits: "u32",
    collapses: "u32",
    flips: "u32",
    moved: "u32",
    vertices: "u32",
    triangles: "u32",
    approach: "f64",
    region_before: "f64",
    region_after: "f64",
    region_lost: "f64",
    region_gained: "f64",
    region_reach: "f64",
    substeps: "u32",
    unfinished: "u32",
  }),
  tpa_remesh_options: structure({
    struct_size: "u32",
    iterations: "u32",
    target_length: "f64",
    split_ratio: "f64",
    collapse_ratio: "f64",
    relaxation: "f64",
    count: "u32",
    reserved: "u32",
    vertices: "pointer",
    lengths: "pointer",
  }),
  tpa_smooth_options: structure({
    struct_size: "u32",
    iterations: "u32",
    count: "u32",
    reserved: "u32",
    vertices: "pointer",
  }),
  tpa_event: structure({ type: "i32", amount: "u32", before: "u32", after: "u32", position: "f64*3" }),
  tpa_component: structure({
    id: "u32",
    before: "u32",
    vertices: "u32",
    triangles: "u32",
    genus: "i32",
    reserved: "u32",
    volume: "f64",
    area: "f64",
    box: "f64*6",
  }),
  tpa_vertex_origin: structure({ parents: "u32*2", weight: "f32" }),
  tpa_vertex_map_view: structure({
    struct_size: "u32",
    old_count: "u32",
    new_count: "u32",
    reserved: "u32",
    old_to_new: "pointer",
    origins: "pointer",
  }),
  tpa_triangle_map_view: structure({
    struct_size: "u32",
    old_count: "u32",
    new_count: "u32",
    reserved: "u32",
    origins: "pointer",
  }),
  tpa_range: structure({ first: "u32", count: "u32" }),
  tpa_change_list: structure({
    struct_size: "u32",
    gap: "u32",
    vertex_capacity: "u32",
    triangle_capacity: "u32",
    vertices: "pointer",
    triangles: "pointer",
    vertex_ranges: "u32",
    triangle_ranges: "u32",
    changed_vertices: "u32",
    changed_triangles: "u32",
    old_vertex_count: "u32",
    old_triangle_count: "u32",
    vertex_count: "u32",
    triangle_count: "u32",
  }),
};
