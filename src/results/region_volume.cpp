// SPDX-License-Identifier: MIT
#include "results/region_volume.h"

#include "base/parallel.h"

namespace tpa {

namespace {

// In place of a sum that is not known. Six times the volumes are never as small.
constexpr f64 forgotten = -no_way;

struct Sums {
  f64 *of_block, *of_group;
};
Sums open_sums(const Context& c) {
  return {table_data<f64>(c, table_block_volume), table_data<f64>(c, table_group_volume)};
}

// Six times the volumes between the faces of a block and the first vertex.
f64 measure_block(const Mesh& m, u32 block) {
  const Vec3 from = m.position[0];
  const u32 first = block * block_faces, end = min_of(first + block_faces, m.face_count);
  f64 sum = 0;
  for (u32 f = first; f < end; ++f)
    sum +=
        six_volumes_of(from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
  return sum;
}

// `known`: blocks with a sum, or forgotten.
f64 measure_group(const Mesh& m, u32 group, f64* of_block, u64 known) {
  constexpr u32 blocks = group_faces / block_faces;
  const u32 first = group * blocks, end = static_cast<u32>(min_of(u64{first} + blocks, blocks_of(m.face_count)));
  f64 sum = 0;
  for (u32 i = first; i < end; ++i) {
    if (i >= known || of_block[i] == forgotten) of_block[i] = measure_block(m, i);
    sum += of_block[i];
  }
  return sum;
}

}  // namespace

void forget_volumes(Context& c, const Mesh& m) {
  const Sums sums = open_sums(c);
  const BitSet vertices = open_changed_vertices(c);
  // All volumes are seen from the first vertex.
  if (m.vertex_count == 0 || vertices.contains(0)) c.measured_faces = 0;
  const u32 measured = c.measured_faces;
  if (measured == 0) return;
  const auto forget = [&](u32 f) {
    if (f >= measured) return;
    sums.of_block[f / block_faces] = sums.of_group[f / group_faces] = forgotten;
  };
  for (u32 v : vertices) for_each_outgoing(m, v, [&](u32 h) { forget(face_of(h)); });
  for (u32 f : open_changed_faces(c)) forget(f);
  // The last block and the last group gain faces, or lose some.
  if (measured != m.face_count) forget(min_of(measured, m.face_count) - 1);
  c.measured_faces = min_of(measured, m.face_count);
}

f64 volume_of_region(const Workspace& w, const Exec& exec) {
  const Mesh& m = w.edit.mesh;
  Context& c = w.context;
  if (m.vertex_count == 0) return 0;
  const Sums sums = open_sums(c);
  const u64 known_blocks = blocks_of(c.measured_faces), known_groups = groups_of(c.measured_faces);
  const u32 groups = static_cast<u32>(groups_of(m.face_count));
  constexpr u32 groups_at_once = 4;
  for_chunks(exec, groups, groups_at_once, [&](u32 first, u32 end) {
    for (u32 i = first; i < end; ++i)
      if (i >= known_groups || sums.of_group[i] == forgotten)
        sums.of_group[i] = measure_group(m, i, sums.of_block, known_blocks);
  });
  c.measured_faces = m.face_count;
  f64 six_volumes = 0;
  for (u32 i = 0; i < groups; ++i) six_volumes += sums.of_group[i];
  return abs_of(six_volumes) / 6;
}

}  // namespace tpa
