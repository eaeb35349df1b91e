// SPDX-License-Identifier: MIT
#include "results/component_events.h"

namespace tpa {

namespace {

u32 genus_events(const Family& f) { return f.genus_after != f.genus_before ? 1 : 0; }

void add(Workspace& w, i32 type, u32 amount, u32 before, u32 after) {
  w.pending_events.push({type, amount, before, after, {}});
}

}  // namespace

u64 count_component_events(const Parts& parts) {
  u64 count = 0;
  for_each_change(parts, [&](const Family& f) {
    if (f.after_count == 0)
      count += 1;
    else
      count += (f.before_count > 1 ? 1u : 0u) + (f.after_count > 1 ? f.after_count : 0u) + genus_events(f);
  });
  return count;
}

void add_component_events(Workspace& w) {
  const Components& components = w.before;
  const Parts& parts = w.parts;
  for_each_change(parts, [&](const Family& f) {
    const auto say = [&](i32 type, u32 amount) { add(w, type, amount, f.before, f.after); };
    if (f.after_count == 0) {
      say(TPA_EVENT_DEATH, f.before_count);
      return;
    }
    if (f.before_count > 1) say(TPA_EVENT_MERGE, f.before_count);
    if (f.after_count > 1)
      for_each_after(parts, f, [&](u32 i) {
        const Component& piece = components.list.data[i];
        add(w, TPA_EVENT_SPLIT, f.after_count, piece.before, piece.id);
      });
    if (f.genus_after > f.genus_before) say(TPA_EVENT_GENUS_UP, static_cast<u32>(f.genus_after - f.genus_before));
    if (f.genus_after < f.genus_before) say(TPA_EVENT_GENUS_DOWN, static_cast<u32>(f.genus_before - f.genus_after));
  });
}

}  // namespace tpa
