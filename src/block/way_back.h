// SPDX-License-Identifier: MIT
// way_back: a copy of the state before a call of several commits, in a table of its own. If a later part of the call
// fails, all commits of its earlier parts are taken back.
#pragma once

#include "block/context.h"

namespace tpa {

// Bytes of the table `kept` for these limits.
u64 bytes_kept(const Limits& l);

// Keeps everything that outlasts a call. O(V).
void keep_state(Context& c);
// Puts it back, but for peaks, and what is found again. Pre: no call is at work on the context. O(V).
void take_back_all(Context& c);

// Of the kept state.
const Context& kept_context(const Context& c);
const Vec3* kept_positions(const Context& c);
const u32* kept_corners(const Context& c);
const Vec3* kept_targets(const Context& c);
BitSet kept_vertices_with_target(const Context& c);

}  // namespace tpa
