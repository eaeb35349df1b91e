// SPDX-License-Identifier: MIT
//! topoadapt: topology changes of moving triangle meshes, in fixed memory. A closed mesh that runs into itself merges,
//! splits, opens handles, and is closed, oriented, 2-manifold and free of self-intersections again.
//!
//! ```
//! # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
//! # fn main() -> topoadapt::Result<()> {
//! use topoadapt::{Config, Context, Event};
//!
//! let (positions, triangles) = balls(&[[-1.3, 0., 0.], [1.3, 0., 0.]], 1.);
//! let mut context = Context::new(&Config::new().max_vertices(4000))?;
//! context.load(&positions, &triangles)?;
//! for _ in 0..2 {
//!     let nearer: Vec<[f64; 3]> =
//!         context.mesh()?.positions.iter().map(|&[x, y, z]| [x - 0.2 * x.signum(), y, z]).collect();
//!     context.move_all(&nearer)?;
//!     context.step(None)?;
//! }
//! assert!(context.events().any(|event| matches!(event, Event::Merge { components: 2, .. })));
//! # Ok(()) }
//! ```
//!
//! `topoadapt.h` has the contract of every function; the guarantees hold here as well. Beyond that:
//! - A [`Context`] owns its block, or borrows it from the caller. Its views borrow the context, so a stale view is a
//!   compile error ([`Mesh`] shows such an error).
//! - A failure is an [`Error`] with status, element, limit and text, and leaves the mesh as before.
//! - The library itself allocates nothing. This crate allocates for [`Context::new`], clones, and whatever is returned as
//!   a `Vec`.
//!
//! Without the feature `std`, which is on by default, the crate needs `alloc` alone: [`Exec`] has no threads then, and
//! [`Error`] is no `std::error::Error`.
#![deny(missing_docs, unsafe_op_in_unsafe_fn)]
#![no_std]

extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

mod arena;
mod components;
mod config;
mod context;
mod error;
mod events;
mod exec;
pub mod handles;
mod maps;
mod mesh;
mod raw;
mod remesh;
mod report;
mod results;
#[cfg(feature = "std")]
mod threads;

pub use arena::Arena;
pub use components::{Component, Components};
pub use config::{ArenaSize, Config, DetectMode, Region};
pub use context::Context;
pub use error::{Defect, Error, Limit, Result, Status};
pub use events::{Event, Events};
pub use exec::Exec;
pub use maps::{Changes, Origin, TriangleMap, VertexMap};
pub use mesh::{Contacts, Coordinate, Export, Index, Mesh, Validation};
pub use remesh::Remesh;
pub use report::Report;
pub use results::MemoryTable;

/// The example of the README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// Major, minor and patch version of the linked library.
pub fn version() -> (u32, u32, u32) {
    // SAFETY: a pure function.
    let version = unsafe { topoadapt_sys::tpa_version() };
    (version >> 16, version >> 8 & 255, version & 255)
}

/// Version and compiler of the linked library, in a line.
pub fn build_info() -> &'static str {
    // SAFETY: a terminated string in static storage.
    unsafe { raw::text_of(topoadapt_sys::tpa_build_info()) }
}
