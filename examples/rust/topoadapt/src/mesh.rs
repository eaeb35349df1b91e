// SPDX-License-Identifier: MIT
use alloc::vec::Vec;
use topoadapt_sys::*;

mod sealed {
    pub trait Sealed {}
}

/// Types of coordinates: `f32` and `f64`.
pub trait Coordinate: sealed::Sealed + Copy + Default {
    #[doc(hidden)]
    const TYPE: u32;
}

/// Types of vertex ids in a mesh to load: `u16` and `u32`.
pub trait Index: sealed::Sealed + Copy + Default {
    #[doc(hidden)]
    const TYPE: u32;
}

impl sealed::Sealed for f32 {}
impl sealed::Sealed for f64 {}
impl sealed::Sealed for u16 {}
impl sealed::Sealed for u32 {}
impl Coordinate for f32 {
    const TYPE: u32 = TPA_FLOAT32;
}
impl Coordinate for f64 {
    const TYPE: u32 = TPA_FLOAT64;
}
impl Index for u16 {
    const TYPE: u32 = TPA_UINT16;
}
impl Index for u32 {
    const TYPE: u32 = TPA_UINT32;
}

/// The present mesh, without a copy. The view borrows its context, so no call that changes the mesh is possible while
/// the view is in use:
///
/// ```compile_fail,E0502
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
/// # fn main() -> topoadapt::Result<()> {
/// # let mut context = octahedron()?;
/// let mesh = context.mesh()?;
/// context.step(None)?;
/// println!("{:?}", mesh.positions[0]);
/// # Ok(()) }
/// ```
///
/// A view of the mesh after the step is another view:
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
/// # fn main() -> topoadapt::Result<()> {
/// # let mut context = octahedron()?;
/// let mesh = context.mesh()?;
/// println!("{:?}", mesh.positions[0]);
/// context.step(None)?;
/// let mesh = context.mesh()?;
/// println!("{:?}", mesh.positions[0]);
/// # Ok(()) }
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// x y z of each vertex.
    pub positions: &'a [[f64; 3]],
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Half-edge `3 * triangle + i` runs from corner `i` to corner `(i + 1) % 3`. For each half-edge the half-edge of
    /// the same edge in the other triangle.
    pub opposites: &'a [[u32; 3]],
    /// Grows with every commit; equal epochs of a context mean equal ids.
    pub epoch: u64,
}

/// Pairs of triangles that meet, from [`Context::detect`](crate::Context::detect).
#[derive(Clone, Copy, Debug)]
pub struct Contacts<'a> {
    pub(crate) mesh: Mesh<'a>,
    pub(crate) pairs: &'a [[u32; 2]],
}

impl<'a> Contacts<'a> {
    /// Two triangles for each pair, in ascending order.
    pub fn pairs(&self) -> &'a [[u32; 2]] {
        self.pairs
    }

    /// The mesh of these triangles.
    pub fn mesh(&self) -> Mesh<'a> {
        self.mesh
    }
}

/// What [`Context::validate`](crate::Context::validate) finds.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validation {
    /// Connected components.
    pub components: u32,
    /// Pairs of triangles that meet beyond their common vertex or edge; exact.
    pub self_intersections: u64,
    /// V - E + F of all components.
    pub euler: i64,
    /// Sum of the components' genera.
    pub genus: i64,
    /// Enclosed volume, signed, with rounding errors of double precision.
    pub volume: f64,
    /// Area, likewise.
    pub area: f64,
}

/// An exported mesh: positions, and vertices of triangles.
pub type Export<P, I> = (Vec<[P; 3]>, Vec<[I; 3]>);
