// SPDX-License-Identifier: MIT
use crate::error::count;
use crate::raw::struct_size;
use crate::{Error, Result};
use core::ptr;
use topoadapt_sys::tpa_remesh_options;

/// Settings of [`Context::remesh`](crate::Context::remesh).
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
/// # fn main() -> topoadapt::Result<()> {
/// # let mut context = octahedron()?;
/// use topoadapt::Remesh;
/// // Finer above than below, and all triangles without a vertex above stay.
/// let positions = context.mesh()?.positions;
/// let lengths: Vec<f32> = positions.iter().map(|p| if p[2] > 0. { 1. } else { 4. }).collect();
/// let above: Vec<u32> = (0u32..).zip(positions).filter(|(_, p)| p[2] >= 0.).map(|(id, _)| id).collect();
/// let report = context.remesh(&Remesh::to_lengths(&lengths).part(&above).iterations(2), None)?;
/// assert!(report.splits > 0);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Remesh<'a> {
    settings: tpa_remesh_options,
    part: Option<&'a [u32]>,
    lengths: Option<&'a [f32]>,
}

impl<'a> Remesh<'a> {
    /// One sweep that aims at this length of edges, without relaxation.
    pub fn to_length(length: f64) -> Remesh<'a> {
        let struct_size = struct_size::<tpa_remesh_options>();
        let settings = tpa_remesh_options { struct_size, iterations: 1, target_length: length, ..Default::default() };
        Remesh { settings, part: None, lengths: None }
    }

    /// The same with a length for each vertex of the mesh. An edge aims at the mean of its ends, and so does a new vertex.
    pub fn to_lengths(lengths: &'a [f32]) -> Remesh<'a> {
        Remesh { lengths: Some(lengths), ..Remesh::to_length(0.) }
    }

    /// Only edges between two of these vertices are split, collapsed and flipped, and only these vertices move. New
    /// vertices belong to the part.
    #[must_use]
    pub fn part(mut self, vertices: &'a [u32]) -> Remesh<'a> {
        self.part = Some(vertices);
        self
    }

    /// Sweeps of split, collapse, flip and relax. 1 to 100.
    #[must_use]
    pub fn iterations(mut self, sweeps: u32) -> Remesh<'a> {
        self.settings.iterations = sweeps;
        self
    }

    /// Edges longer than `split` times the length are split, edges shorter than `collapse` times the length collapsed.
    /// 0 means 4/3 and 4/5 (Botsch & Kobbelt 2004). `collapse` is at most `split` / 1.5.
    #[must_use]
    pub fn ratios(mut self, split: f64, collapse: f64) -> Remesh<'a> {
        self.settings.split_ratio = split;
        self.settings.collapse_ratio = collapse;
        self
    }

    /// Tangential relaxation of vertices that an operation has touched. 0 to 1.
    #[must_use]
    pub fn relaxation(mut self, factor: f64) -> Remesh<'a> {
        self.settings.relaxation = factor;
        self
    }

    /// The options for a mesh of so many vertices; they point into the slices.
    pub(crate) fn raw(&self, vertices: usize) -> Result<tpa_remesh_options> {
        if self.lengths.map_or(false, |lengths| lengths.len() != vertices) {
            return Err(Error::of_argument("a length is needed for each vertex of the mesh"));
        }
        Ok(tpa_remesh_options {
            count: count(self.part.map_or(0, <[u32]>::len))?,
            vertices: self.part.map_or(ptr::null(), <[u32]>::as_ptr),
            lengths: self.lengths.map_or(ptr::null(), <[f32]>::as_ptr),
            ..self.settings
        })
    }
}
