// SPDX-License-Identifier: MIT
//! Results of the last commit, and the state of a context.
use crate::error::{call, check, count};
use crate::maps::ranges;
use crate::raw::{slice_of, struct_size, text_of};
use crate::{Changes, Component, Components, Context, Error, Events, Result, TriangleMap, VertexMap};
use alloc::vec;
use alloc::vec::Vec;
use core::ptr;
use topoadapt_sys::*;

type Carry<T> = unsafe extern "C" fn(*const tpa_context, *const T, u32, *mut T) -> tpa_status;

/// A table of the block of a context.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryTable {
    /// Name of the table.
    pub name: &'static str,
    /// Size within the block.
    pub bytes: u64,
    /// Elements in use now.
    pub used: u64,
    /// Most elements ever in use or wanted: as a limit, enough for the same calls.
    pub peak: u64,
    /// Room, in elements.
    pub limit: u64,
}

impl Context<'_> {
    /// The events of the last commit.
    ///
    /// ```
    /// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
    /// # fn main() -> topoadapt::Result<()> {
    /// # let context = octahedron()?;
    /// use topoadapt::Event;
    /// for event in context.events() {
    ///     if let Event::Merge { components, after, .. } = event {
    ///         println!("{components} components became {after}");
    ///     }
    /// }
    /// # Ok(()) }
    /// ```
    pub fn events(&self) -> Events<'_> {
        let (mut first, mut total) = (ptr::null(), 0);
        // SAFETY: the library writes pointer and number.
        check(unsafe { tpa_events(self.raw(), &mut first, &mut total) }).expect("events can always be read");
        // SAFETY: the events stay while self is borrowed.
        Events(unsafe { slice_of(first, total) }.iter())
    }

    /// The vertices left at their old positions by the last step or advance, ascending.
    pub fn rolled_back(&self) -> &[u32] {
        let (mut first, mut total) = (ptr::null(), 0);
        // SAFETY: the library writes pointer and number.
        check(unsafe { tpa_rolled_back(self.raw(), &mut first, &mut total) }).expect("the list can always be read");
        // SAFETY: the list stays while self is borrowed.
        unsafe { slice_of(first, total) }
    }

    /// The connected components of the present mesh.
    pub fn components(&self) -> Result<Components> {
        let vertices = self.mesh()?.positions.len();
        let mut total = 0;
        let none = ptr::null_mut();
        // SAFETY: without arrays the library writes only the number.
        call(|issue| unsafe { tpa_components(self.raw(), ptr::null_mut(), 0, none, &mut total, issue) })?;
        let mut list = vec![tpa_component::default(); total as usize];
        let mut labels = vec![0; vertices];
        let (list_out, labels_out) = (list.as_mut_ptr(), labels.as_mut_ptr());
        // SAFETY: list has room for `total` components, labels for each vertex.
        call(|issue| unsafe { tpa_components(self.raw(), list_out, total, labels_out, &mut total, issue) })?;
        Ok(Components { list: list.iter().map(Component::of).collect(), labels })
    }

    /// How the last commit renumbered, removed and made vertices.
    pub fn vertex_map(&self) -> Result<VertexMap<'_>> {
        let mut map = tpa_vertex_map_view { struct_size: struct_size::<tpa_vertex_map_view>(), ..Default::default() };
        // SAFETY: the library writes the structure.
        check(unsafe { tpa_vertex_map(self.raw(), &mut map) })?;
        // SAFETY: the arrays have so many elements, and stay while self is borrowed.
        unsafe {
            let old_to_new = slice_of(map.old_to_new, map.old_count);
            Ok(VertexMap { old_to_new, origins: slice_of(map.origins, map.new_count) })
        }
    }

    /// How the last commit made triangles.
    pub fn triangle_map(&self) -> Result<TriangleMap<'_>> {
        let struct_size = struct_size::<tpa_triangle_map_view>();
        let mut map = tpa_triangle_map_view { struct_size, ..Default::default() };
        // SAFETY: the library writes the structure.
        check(unsafe { tpa_triangle_map(self.raw(), &mut map) })?;
        // SAFETY: the array has so many elements, and stays while self is borrowed.
        Ok(TriangleMap { old_count: map.old_count, origins: unsafe { slice_of(map.origins, map.new_count) } })
    }

    /// The parts of the mesh that the last commit changed. Ranges with at most `gap` unchanged elements between them
    /// become one; where more than `most` ranges were left, the gap doubles until they fit.
    pub fn changes(&self, gap: u32, most: u32) -> Result<Changes> {
        let mut raw = tpa_change_list { struct_size: struct_size::<tpa_change_list>(), gap, ..Default::default() };
        // SAFETY: without capacity the library writes only the numbers.
        call(|issue| unsafe { tpa_changes(self.raw(), &mut raw, issue) })?;
        raw.vertex_capacity = raw.changed_vertices.min(most);
        raw.triangle_capacity = raw.changed_triangles.min(most);
        let mut vertices = vec![tpa_range::default(); raw.vertex_capacity as usize];
        let mut triangles = vec![tpa_range::default(); raw.triangle_capacity as usize];
        raw.vertices = vertices.as_mut_ptr();
        raw.triangles = triangles.as_mut_ptr();
        // SAFETY: the vectors have room for the capacities.
        call(|issue| unsafe { tpa_changes(self.raw(), &mut raw, issue) })?;
        Ok(Changes {
            vertices: ranges(&vertices, raw.vertex_ranges),
            triangles: ranges(&triangles, raw.triangle_ranges),
            changed_vertices: raw.changed_vertices,
            changed_triangles: raw.changed_triangles,
            old_vertex_count: raw.old_vertex_count,
            old_triangle_count: raw.old_triangle_count,
            vertex_count: raw.vertex_count,
            triangle_count: raw.triangle_count,
        })
    }

    /// Carries attributes of vertices through the last commit: N numbers for each vertex before the commit become N
    /// numbers for each vertex after.
    ///
    /// ```
    /// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
    /// # fn main() -> topoadapt::Result<()> {
    /// # let mut context = octahedron()?;
    /// let mut colours = vec![[1.0, 0.5, 0.0]; context.mesh()?.positions.len()];
    /// context.step(None)?;
    /// colours = context.carry_vertices(&colours)?;
    /// # Ok(()) }
    /// ```
    pub fn carry_vertices<const N: usize>(&self, before: &[[f32; N]]) -> Result<Vec<[f32; N]>> {
        let map = self.vertex_map()?;
        self.carry(before, map.old_count(), map.new_count(), tpa_carry_vertices)
    }

    /// The same in double precision.
    pub fn carry_vertices_f64<const N: usize>(&self, before: &[[f64; N]]) -> Result<Vec<[f64; N]>> {
        let map = self.vertex_map()?;
        self.carry(before, map.old_count(), map.new_count(), tpa_carry_vertices_f64)
    }

    /// The same for triangles, in single precision.
    pub fn carry_triangles<const N: usize>(&self, before: &[[f32; N]]) -> Result<Vec<[f32; N]>> {
        let map = self.triangle_map()?;
        self.carry(before, map.old_count(), map.new_count(), tpa_carry_triangles)
    }

    fn carry<T: Copy + Default, const N: usize>(
        &self,
        before: &[[T; N]],
        old: usize,
        new: usize,
        carry: Carry<T>,
    ) -> Result<Vec<[T; N]>> {
        if before.len() != old {
            return Err(Error::of_argument("attributes are needed for each element before the last commit"));
        }
        let mut after = vec![[T::default(); N]; new];
        let width = count(N)?;
        // SAFETY: both arrays have N numbers for each element, as the library expects.
        check(unsafe { carry(self.raw(), before.as_ptr().cast(), width, after.as_mut_ptr().cast()) })?;
        Ok(after)
    }

    /// The state as bytes: the same on every platform, and equal for equal states.
    ///
    /// ```
    /// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
    /// # fn main() -> topoadapt::Result<()> {
    /// # use topoadapt::Context;
    /// # let context = octahedron()?;
    /// let bytes = context.save()?;
    /// let mut other = Context::new(&context.config()?)?;
    /// other.restore(&bytes)?;
    /// assert_eq!(other.digest(), context.digest());
    /// # Ok(()) }
    /// ```
    pub fn save(&self) -> Result<Vec<u8>> {
        let mut size = 0;
        // SAFETY: with capacity 0 the library writes only the size.
        call(|issue| unsafe { tpa_save(self.raw(), ptr::null_mut(), 0, &mut size, issue) })?;
        let mut bytes = vec![0; size];
        let data = bytes.as_mut_ptr().cast();
        // SAFETY: bytes has room for `size` bytes.
        call(|issue| unsafe { tpa_save(self.raw(), data, bytes.len(), &mut size, issue) })?;
        Ok(bytes)
    }

    /// Replaces the state by a saved state, of any platform. Data of any content leave a sound context.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: the library reads the bytes during the call.
        call(|issue| unsafe { tpa_restore(self.raw_mut(), bytes.as_ptr().cast(), bytes.len(), issue) })
    }

    /// A hash of the state, the same on every platform.
    pub fn digest(&self) -> u64 {
        let mut digest = 0;
        // SAFETY: the library writes the digest.
        check(unsafe { tpa_digest(self.raw(), &mut digest) }).expect("every state has a digest");
        digest
    }

    /// The tables of the block, in address order.
    pub fn memory(&self) -> Vec<MemoryTable> {
        const READS: &str = "tables can always be read";
        let mut total = 0;
        // SAFETY: with capacity 0 the library writes only the number.
        check(unsafe { tpa_memory_stats(self.raw(), ptr::null_mut(), 0, &mut total) }).expect(READS);
        let mut tables = vec![tpa_memory_table::default(); total as usize];
        // SAFETY: tables has room for `total` tables.
        check(unsafe { tpa_memory_stats(self.raw(), tables.as_mut_ptr(), total, &mut total) }).expect(READS);
        let read = |table: &tpa_memory_table| MemoryTable {
            // SAFETY: a terminated string in static storage.
            name: unsafe { text_of(table.name) },
            bytes: table.bytes,
            used: table.used,
            peak: table.peak,
            limit: table.limit,
        };
        tables.iter().map(read).collect()
    }
}
