// SPDX-License-Identifier: MIT
// true_origins: the parents of new vertices, true to a stated bound (tpa_vertex_origin in topoadapt.h). Blends of
// blends and smoothing lead vertices away from the parents that their making gave them.
#pragma once

#include "block/context.h"

namespace tpa {

// A new vertex lies no farther from the point between its parents than this, in lengths of the longest edge at the
// vertex, or of the distance of the parents if that is longer.
inline constexpr f64 origin_bound = 1;

// Before the commit, when all edits are done. Gives each new vertex the weight of the nearest point between its
// parents; beyond half the bound, the nearest parents of the neighbours where these are nearer; beyond the bound, an
// untrue origin. O(new vertices and their neighbours).
void find_true_origins(Workspace& w);
// The same for all new vertices of a mesh without holes, with `place` for each old vertex. O(V).
void find_true_origins_from(Workspace& w, const Vec3* place);

}  // namespace tpa
