// SPDX-License-Identifier: MIT
use alloc::vec::Vec;
use core::ops::Range;
use topoadapt_sys::*;

fn some(id: u32) -> Option<u32> {
    (id != TPA_NONE).then_some(id)
}

/// Origin of a vertex, in ids before the commit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// The vertex itself, wherever it has moved.
    Old(u32),
    /// A new vertex near `weight * parents[0] + (1 - weight) * parents[1]`.
    Between {
        /// Two vertices before the commit.
        parents: [u32; 2],
        /// Share of `parents[0]`; 0 to 1.
        weight: f32,
    },
    /// A new vertex without a known origin; some old vertex stands for it, at no stated distance.
    Unknown(u32),
}

/// How the last commit renumbered, removed and made vertices.
#[derive(Clone, Copy, Debug)]
pub struct VertexMap<'a> {
    pub(crate) old_to_new: &'a [u32],
    pub(crate) origins: &'a [tpa_vertex_origin],
}

impl<'a> VertexMap<'a> {
    /// Number of vertices before the commit.
    pub fn old_count(&self) -> usize {
        self.old_to_new.len()
    }

    /// Number of vertices after the commit.
    pub fn new_count(&self) -> usize {
        self.origins.len()
    }

    /// The id after the commit of a vertex before; None for a removed or unknown vertex.
    pub fn new_id(&self, old: u32) -> Option<u32> {
        self.old_to_new.get(old as usize).copied().and_then(some)
    }

    /// The origin of a vertex after the commit; None for an unknown vertex.
    pub fn origin(&self, new: u32) -> Option<Origin> {
        self.origins.get(new as usize).map(Self::read)
    }

    /// The origins of all vertices after the commit, by id.
    pub fn origins(&self) -> impl ExactSizeIterator<Item = Origin> + 'a {
        self.origins.iter().map(Self::read)
    }

    fn read(raw: &tpa_vertex_origin) -> Origin {
        match raw.parents {
            [old, TPA_NONE] => Origin::Old(old),
            [a, b] if a == b && raw.weight == 0. => Origin::Unknown(a),
            parents => Origin::Between { parents, weight: raw.weight },
        }
    }
}

/// How the last commit made triangles.
#[derive(Clone, Copy, Debug)]
pub struct TriangleMap<'a> {
    pub(crate) old_count: u32,
    pub(crate) origins: &'a [u32],
}

impl<'a> TriangleMap<'a> {
    /// Number of triangles before the commit.
    pub fn old_count(&self) -> usize {
        self.old_count as usize
    }

    /// Number of triangles after the commit.
    pub fn new_count(&self) -> usize {
        self.origins.len()
    }

    /// The triangle before the commit that this triangle is, or is part of; None for triangles of handles and caps, and
    /// for unknown triangles.
    pub fn origin(&self, new: u32) -> Option<u32> {
        self.origins.get(new as usize).copied().and_then(some)
    }

    /// The origins of all triangles after the commit, by id.
    pub fn origins(&self) -> impl ExactSizeIterator<Item = Option<u32>> + 'a {
        self.origins.iter().copied().map(some)
    }
}

/// Parts of the mesh to copy into arrays of before the last commit, on a graphics processor for instance.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Changes {
    /// Ids of vertices with new positions, ascending.
    pub vertices: Vec<Range<u32>>,
    /// Ids of triangles with new corners, ascending.
    pub triangles: Vec<Range<u32>>,
    /// Vertices that changed, without those between them.
    pub changed_vertices: u32,
    /// Triangles that changed, without those between them.
    pub changed_triangles: u32,
    /// Vertices before the commit.
    pub old_vertex_count: u32,
    /// Triangles before the commit.
    pub old_triangle_count: u32,
    /// Vertices after the commit.
    pub vertex_count: u32,
    /// Triangles after the commit.
    pub triangle_count: u32,
}

/// The first `count` ranges.
pub(crate) fn ranges(raw: &[tpa_range], count: u32) -> Vec<Range<u32>> {
    raw.iter().take(count as usize).map(|range| range.first..range.first + range.count).collect()
}
