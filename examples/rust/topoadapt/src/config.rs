// SPDX-License-Identifier: MIT
use crate::error::{call, check};
use crate::{Error, Limit, Result};
use core::fmt;
use core::mem::size_of;
use topoadapt_sys::*;

/// Ways to detect contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DetectMode {
    /// Every pair of intersecting triangles, by a tree of boxes over the faces. The default.
    Complete,
    /// The vertex hash of the paper's section 3, with cells of [`Config::cell_size`]; misses triangles that share no cell.
    VertexHash,
}

/// The side of the mesh that is the object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Region {
    /// Triangles wind outward round the object. The default.
    Inside,
    /// The mesh bounds the outside of the object: a closed surface winds inward round a void.
    Outside,
}

/// Memory for a context.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ArenaSize {
    /// Size in bytes, at any address.
    pub bytes: usize,
    /// A power of two. Byte copies of a block need addresses equal modulo it.
    pub alignment: usize,
}

/// Limits and settings of a [`Context`](crate::Context). `topoadapt.h` has range and default of each.
///
/// ```
/// # fn main() -> topoadapt::Result<()> {
/// use topoadapt::{Config, Context};
/// let config = Config::new().max_vertices(1000).smooth_iterations(2);
/// assert!(config.arena_size()?.bytes > 0);
/// let context = Context::new(&config)?;
/// assert_eq!(context.config()?, config);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Config {
    pub(crate) raw: tpa_config,
}

impl Config {
    /// All defaults.
    pub fn new() -> Config {
        let mut raw = tpa_config::default();
        // SAFETY: raw has the size that is told.
        let status = unsafe { tpa_config_init(&mut raw, size_of::<tpa_config>()) };
        check(status).expect("every library takes the structures of version 0.1 or newer");
        Config { raw }
    }

    /// Most vertices at any moment, also within a call. Default 65536.
    #[must_use]
    pub fn max_vertices(mut self, most: u32) -> Config {
        self.raw.max_vertices = most;
        self
    }

    /// Most triangles. Default 0: twice the vertices, and 1024 more.
    #[must_use]
    pub fn max_triangles(mut self, most: u32) -> Config {
        self.raw.max_triangles = most;
        self
    }

    /// Most intersecting pairs of triangles in a pass. Default 0: by the vertices.
    #[must_use]
    pub fn max_contacts(mut self, most: u32) -> Config {
        self.raw.max_contacts = most;
        self
    }

    /// Most edges that a pass can cut. Default 0: by the vertices.
    #[must_use]
    pub fn max_cut_edges(mut self, most: u32) -> Config {
        self.raw.max_cut_edges = most;
        self
    }

    /// Most events of a commit. Default 0: by the vertices.
    #[must_use]
    pub fn max_events(mut self, most: u32) -> Config {
        self.raw.max_events = most;
        self
    }

    /// Most connected components between calls. Default 0: by the vertices.
    #[must_use]
    pub fn max_components(mut self, most: u32) -> Config {
        self.raw.max_components = most;
        self
    }

    /// Most triangles into which an exact cut may divide the faces in contact. Default 0: by the contacts.
    #[must_use]
    pub fn max_pieces(mut self, most: u32) -> Config {
        self.raw.max_pieces = most;
        self
    }

    /// Most sub-steps of [`Context::advance`](crate::Context::advance). Default 0: a single one; from 2 on contexts take
    /// more memory.
    #[must_use]
    pub fn max_substeps(mut self, most: u32) -> Config {
        self.raw.max_substeps = most;
        self
    }

    /// How contacts are found.
    #[must_use]
    pub fn detect_mode(mut self, mode: DetectMode) -> Config {
        self.raw.detect_mode = match mode {
            DetectMode::Complete => TPA_DETECT_COMPLETE,
            DetectMode::VertexHash => TPA_DETECT_VERTEX_HASH,
        };
        self
    }

    /// Length of a cell of [`DetectMode::VertexHash`], in the unit of the coordinates. Default 1.
    #[must_use]
    pub fn cell_size(mut self, length: f64) -> Config {
        self.raw.cell_size = length;
        self
    }

    /// The side of the mesh that is the object.
    #[must_use]
    pub fn region(mut self, region: Region) -> Config {
        self.raw.region = match region {
            Region::Inside => TPA_REGION_INSIDE,
            Region::Outside => TPA_REGION_OUTSIDE,
        };
        self
    }

    /// Rounds of detection and connection. 1 to 64, default 8.
    #[must_use]
    pub fn max_passes(mut self, rounds: u32) -> Config {
        self.raw.max_passes = rounds;
        self
    }

    /// Handles or caps tested for each contact. 1 to 256, default 64.
    #[must_use]
    pub fn max_candidates(mut self, most: u32) -> Config {
        self.raw.max_candidates = most;
        self
    }

    /// Rounds of Taubin smoothing after an event. 0 to 1000, default 4.
    #[must_use]
    pub fn smooth_iterations(mut self, rounds: u32) -> Config {
        self.raw.smooth_iterations = rounds;
        self
    }

    /// Factors of Taubin smoothing. Defaults .6307 and -.6732.
    #[must_use]
    pub fn smooth_factors(mut self, lambda: f64, mu: f64) -> Config {
        self.raw.smooth_lambda = lambda;
        self.raw.smooth_mu = mu;
        self
    }

    /// The config with room for the call that has failed: the limit named by `error` at twice its amount, and at least
    /// at the amount needed, but no higher than the field allows. None if no limit was at fault, or none is high
    /// enough. See [`Context::with_room`](crate::Context::with_room).
    pub fn raised(mut self, error: &Error) -> Option<Config> {
        let (limit, most) = match error.limit()? {
            Limit::Vertices => (&mut self.raw.max_vertices, 1 << 29),
            Limit::Triangles => (&mut self.raw.max_triangles, (1 << 30) + 1024),
            Limit::Contacts => (&mut self.raw.max_contacts, 1 << 30),
            Limit::CutEdges => (&mut self.raw.max_cut_edges, 1 << 28),
            Limit::Events => (&mut self.raw.max_events, 1 << 28),
            Limit::Components => (&mut self.raw.max_components, 1 << 28),
            Limit::Pieces => (&mut self.raw.max_pieces, 1 << 28),
            Limit::Substeps => (&mut self.raw.max_substeps, 1 << 20),
        };
        let enough = error.needed().max(error.available().saturating_mul(2)).min(most);
        if enough < error.needed() {
            return None;
        }
        *limit = u32::try_from(enough).ok()?;
        Some(self)
    }

    /// Memory that a context with this config takes.
    pub fn arena_size(&self) -> Result<ArenaSize> {
        let mut size = tpa_arena_size::default();
        // SAFETY: the library reads the config and writes the size.
        call(|issue| unsafe { tpa_arena_query(&self.raw, &mut size, issue) })?;
        Ok(ArenaSize { bytes: size.bytes, alignment: size.alignment })
    }
}

impl Default for Config {
    fn default() -> Config {
        Config::new()
    }
}

impl fmt::Debug for Config {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.raw.fmt(f)
    }
}
