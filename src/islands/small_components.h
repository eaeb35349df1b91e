// SPDX-License-Identifier: MIT
// small_components: components that are found and removed at the cost of their own size.
#pragma once

#include "block/context.h"

namespace tpa {

// Marks of vertices in w.work_vertices: found by this search, or by an earlier one. The caller sets them back.
inline constexpr u8 found_now = 1, found_before = 2;

// Adds the component of v to w.work_vertices. False if it has more than `most` vertices, or others of it are found
// before. O(most), but at hubs.
bool collect_small_component(Workspace& w, u32 v, u32 most);

// Removes a component, with all of its vertices given.
void remove_component(Edit& e, NearFaces& near, Span<const u32> vertices);

// Visits the faces of a component, with all of its vertices given: each by the half-edge from its lowest vertex.
template <class Visit>
void for_each_face_of(const Mesh& m, Span<const u32> vertices, Visit visit) {
  for (u32 v : vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      if (v < head(m, h) && v < apex(m, h)) visit(h);
    });
}

}  // namespace tpa
