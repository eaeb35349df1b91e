// SPDX-License-Identifier: MIT
use topoadapt_sys::*;

/// What a step, an adaptation, a remeshing or a smoothing has done. `topoadapt.h` has more on each field.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Rounds of detection and connection, of all components together.
    pub passes: u32,
    /// Intersecting pairs at the start of the first pass.
    pub contacts: u32,
    /// Groups of colliding clusters, or of cut faces, that were treated.
    pub groups: u32,
    /// Handles inserted between two, three, four, more polygons.
    pub handles: [u32; 4],
    /// Polygons closed by a cap.
    pub caps: u32,
    /// Swallowed or inverted patches and components removed.
    pub removed_patches: u32,
    /// Step: vertices kept at their old positions, listed by [`Context::rolled_back`](crate::Context::rolled_back).
    pub rolled_back_vertices: u32,
    /// Adaptation: intersecting pairs left.
    pub unresolved: u32,
    /// Remeshing: edges split.
    pub splits: u32,
    /// Remeshing: edges collapsed.
    pub collapses: u32,
    /// Remeshing: edges flipped.
    pub flips: u32,
    /// Vertices moved by smoothing.
    pub moved: u32,
    /// Vertices after the call.
    pub vertices: u32,
    /// Triangles after the call.
    pub triangles: u32,
    /// Step: no two points of the surface approached each other by more, on the ways to their targets.
    pub approach: f64,
    /// Volume where the winding number was 1 or more.
    pub region_before: f64,
    /// Volume that the result encloses.
    pub region_after: f64,
    /// Volume of the region that the result leaves out.
    pub region_lost: f64,
    /// Volume by which the result exceeds the region.
    pub region_gained: f64,
    /// No change of the region lies farther from triangles in contact.
    pub region_reach: f64,
    /// Advance: sub-steps made.
    pub substeps: u32,
    /// What the end of the budget left, in a call that keeps what is done; else 0.
    pub unfinished: u32,
}

impl Report {
    pub(crate) fn of(raw: &tpa_report) -> Report {
        Report {
            passes: raw.passes,
            contacts: raw.contacts,
            groups: raw.groups,
            handles: raw.handles,
            caps: raw.caps,
            removed_patches: raw.removed_patches,
            rolled_back_vertices: raw.rolled_back_vertices,
            unresolved: raw.unresolved,
            splits: raw.splits,
            collapses: raw.collapses,
            flips: raw.flips,
            moved: raw.moved,
            vertices: raw.vertices,
            triangles: raw.triangles,
            approach: raw.approach,
            region_before: raw.region_before,
            region_after: raw.region_after,
            region_lost: raw.region_lost,
            region_gained: raw.region_gained,
            region_reach: raw.region_reach,
            substeps: raw.substeps,
            unfinished: raw.unfinished,
        }
    }
}
