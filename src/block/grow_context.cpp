// SPDX-License-Identifier: MIT
#include "block/grow_context.h"

#include <string.h>

#include "block/issue.h"
#include "block/marks.h"
#include "block/saved_state.h"

namespace tpa {

namespace {

void copy_table(const Context& from, Context& to, TableId table, u64 bytes) {
  memcpy(table_data<u8>(to, table), table_data<u8>(from, table), static_cast<size_t>(bytes));
}

void copy_sets(const Context& from, Context& to) {
  Workspace w = open(to);
  const Vec3* target = table_data<Vec3>(from, table_target);
  for (u32 v : open_targets(from)) set_target(w, v, target[v]);
  for (u32 v : open_rolled_back(from)) w.rolled_back.add(v);
  list_rolled_back(to);
  to.all_changed = from.all_changed;
  // Else the sets are those of an earlier mesh, which may have been too large for the new block.
  if (!from.loaded || from.all_changed) return;
  BitSet vertices = open_changed_vertices(to), faces = open_changed_faces(to);
  for (u32 v : open_changed_vertices(from)) vertices.add(v);
  for (u32 f : open_changed_faces(from)) faces.add(f);
}

tpa_status label_components(Context& c, tpa_issue& issue) {
  Workspace w = open(c);
  const u32 components = find_components(w.edit.mesh, w.before, w.work_vertices.data);
  if (components > c.limits.components) return fail_limit(issue, TPA_LIMIT_COMPONENTS, components, c.limits.components);
  c.component_count = c.component_nodes = components;
  c.components_known = true;
  note_peak(c, Measure::components, components);
  return TPA_OK;
}

}  // namespace

bool state_fits(const Context& from, const Limits& limits, tpa_issue& issue) {
  u32 count[saved_counts];
  count_elements(from, count);
  return elements_fit(count, limits, issue);
}

tpa_status carry_state(const Context& from, Context& to, tpa_issue& issue) {
  u32 count[saved_counts];
  count_elements(from, count);
  for (u32 array = 0; array < saved_tables; ++array) {
    const SavedArrayInfo& info = saved_array_info(array);
    copy_table(from, to, info.table, count[info.count] * info.element_bytes());
  }
  copy_table(from, to, table_opposite, 3 * sizeof(u32) * u64{from.face_count});
  memcpy(to.peak, from.peak, sizeof to.peak);
  to.known_clean = from.known_clean;
  adopt_counts(to, count, from.epoch, from.loaded);
  copy_sets(from, to);
  return label_components(to, issue);
}

}  // namespace tpa
