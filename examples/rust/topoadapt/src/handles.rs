// SPDX-License-Identifier: MIT
//! The database of handles (section 4 of the paper): surfaces between two to four polygons of 3 to 15 sides.
//!
//! ```
//! # fn main() -> topoadapt::Result<()> {
//! use topoadapt::handles;
//! let sides = [5, 4];
//! let info = handles::describe(&sides)?;
//! let faces = handles::get(&sides, 0)?;
//! assert_eq!(faces.len(), info.faces as usize);
//! # Ok(()) }
//! ```
use crate::error::{check, count};
use crate::raw::struct_size;
use crate::Result;
use alloc::vec;
use alloc::vec::Vec;
use topoadapt_sys::*;

/// The handles between given polygons.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Info {
    /// Stored generators, modulo rotations of each polygon and exchanges of equal polygons.
    pub generators: u32,
    /// Distinct handles of all generators together.
    pub handles: u64,
    /// Faces of each handle.
    pub faces: u32,
    /// Whether all most even handles are there; else the 32 most even generators of more.
    pub complete: bool,
}

/// The handles for polygons with these numbers of sides, in any order.
pub fn describe(sides: &[u32]) -> Result<Info> {
    let mut raw = tpa_handle_info { struct_size: struct_size::<tpa_handle_info>(), ..Default::default() };
    // SAFETY: sides has so many numbers; the library writes the structure.
    check(unsafe { tpa_handle_describe(count(sides.len())?, sides.as_ptr(), &mut raw) })?;
    Ok(Info { generators: raw.generators, handles: raw.handles, faces: raw.faces, complete: raw.complete != 0 })
}

/// The faces of handle `index`, below [`Info::handles`]. Vertices are numbered through all polygons in their order; the
/// handle contains the directed edges of each polygon.
pub fn get(sides: &[u32], index: u64) -> Result<Vec<[u32; 3]>> {
    let mut faces = empty_faces(sides)?;
    let capacity = count(3 * faces.len())?;
    let faces_out = faces.as_mut_ptr().cast();
    // SAFETY: faces has room for `capacity` numbers.
    check(unsafe { tpa_handle_get(count(sides.len())?, sides.as_ptr(), index, faces_out, capacity) })?;
    Ok(faces)
}

/// The faces of generator `index`, below [`Info::generators`], and the number of distinct handles that it makes.
pub fn generator(sides: &[u32], index: u32) -> Result<(Vec<[u32; 3]>, u64)> {
    let mut faces = empty_faces(sides)?;
    let capacity = count(3 * faces.len())?;
    let faces_out = faces.as_mut_ptr().cast();
    let polygons = count(sides.len())?;
    let mut orbit = 0;
    // SAFETY: faces has room for `capacity` numbers; the library writes the orbit.
    check(unsafe { tpa_handle_generator(polygons, sides.as_ptr(), index, faces_out, capacity, &mut orbit) })?;
    Ok((faces, orbit))
}

fn empty_faces(sides: &[u32]) -> Result<Vec<[u32; 3]>> {
    Ok(vec![[0; 3]; describe(sides)?.faces as usize])
}
