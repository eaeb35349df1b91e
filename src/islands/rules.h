// SPDX-License-Identifier: MIT
// rules: the numbers that decide what happens to a body at a contact. Each is a share of a length, an area or a volume
// of the island itself, with its reason and the test that fails with another value.
#pragma once

#include "base/fp.h"

namespace tpa {

// ---------------------------------------------------------------- the ledger of an island (islands/ledger.h)

// Share of the volume of the components that meet, which an island may take from the region and add to it. One per cent
// is the promise of P3 for coarse bodies; an event of the paper on a ball of 642 vertices changes a quarter of that.
// ledger_test, coarse_test.
inline constexpr f64 ledger_share = 0.01;

// A coarse measure decides only where it lies so many standard deviations from the bound. ledger_test.
inline constexpr f64 deviations = 3;

// ---------------------------------------------------------------- close and cut (islands/separate.h)

// Grid of separation: at most this share of the shortest edge in contact. Merging reaches 64 grids, three per cent of
// that edge, so no edge of the mesh itself is contracted. separate_test, offset_test.
inline constexpr f64 grid_share = 0.03 / 64;

// New vertices are apart by this share of the mean shortest edge in contact: closer ones would fold in the next step.
// tidy_cut_test, evolve_test.
inline constexpr f64 closest_share = 0.5;

// New vertices merge until this share of the ledger is used. Tunnels of a crumpled ball take a tenth of it.
// thin_tunnels_test.
inline constexpr f64 merge_share = 0.75;

// ---------------------------------------------------------------- features (islands/specks.h, turned.h,
// close_tunnels.h)

// Vertices of a speck, so that the search of large components stays local. specks_test.
inline constexpr u32 most_of_speck = 512;

// Largest crumbs of a turned component: layers on its faces of this share of their widths, since a step bounds the
// region up to such a part of the edges (P3), and this share of its volume before the step, since a body is gone if
// most of it is. turned_test, step_region_test, evolve_test, coarse_test.
inline constexpr f64 layer_share = 0.03, crumbs_share = 1.0 / 3;

// Loops round tunnels and handles are at most so many sizes of triangles long. Even triangles make tunnels with a waist
// of four edges, slender ones beside them wider ones. A handle of the mesh itself may be as thin. close_tunnels_test,
// evolve_test.
inline constexpr f64 tunnel_share = 8, handle_share = 4;
// Round a flat tunnel, so many of the longest edges. close_tunnels_test.
inline constexpr f64 flat_share = 4;
// Loops near a vertex that are tried to be cut, until one can be. uneven_figures.
inline constexpr u32 most_loops_cut = 4;

}  // namespace tpa
