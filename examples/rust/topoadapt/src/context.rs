// SPDX-License-Identifier: MIT
use crate::error::{call, check, count};
use crate::raw::{slice_of, struct_size};
use crate::Validation;
use crate::{Arena, ArenaSize, Config, Contacts, Coordinate, Error, Exec, Export, Index, Mesh, Remesh, Report, Result};
use alloc::alloc::{handle_alloc_error, Layout};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ptr::{self, NonNull};
use topoadapt_sys::*;

/// A mesh that moves and changes its topology, in memory of its own or of the caller.
///
/// Methods with `&self` read, and methods with `&mut self` write; so views of the mesh, of maps and of events borrow
/// the context, and the compiler refuses views that have gone stale ([`Mesh`] shows how). A context may go to another
/// thread (`Send`), and any number of threads may read it at once (`Sync`): the library has no state outside of the
/// block, and its reading functions write nothing there.
///
/// A clone is a snapshot: a byte copy of the block. `a.clone_from(&b)` rewinds `a` without an allocation if both have
/// the same config.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
/// # fn main() -> topoadapt::Result<()> {
/// use topoadapt::{Config, Context};
/// let (positions, triangles) = balls(&[[-1.5, 0., 0.], [1.5, 0., 0.]], 2.);
/// let mut context = Context::new(&Config::new().max_vertices(4000))?;
/// context.load(&positions, &triangles)?; // the balls overlap
/// let report = context.adapt(None)?;
/// assert_eq!(report.unresolved, 0);
/// assert_eq!(context.components()?.len(), 1);
/// # Ok(()) }
/// ```
pub struct Context<'m> {
    raw: NonNull<tpa_context>,
    size: ArenaSize,
    arena: Option<Arena>,
    lender: PhantomData<&'m mut [u8]>,
}

// SAFETY: all state is in the block, which belongs to the context alone, and depends on no thread.
unsafe impl Send for Context<'_> {}
// SAFETY: `&self` gives only calls with a `const tpa_context*`, of which any number may run at once.
unsafe impl Sync for Context<'_> {}

impl Context<'static> {
    /// A context in memory of its own.
    pub fn new(config: &Config) -> Result<Context<'static>> {
        Context::owned(config, None)
    }

    fn owned(config: &Config, from: Option<&Context<'_>>) -> Result<Context<'static>> {
        let size = config.arena_size()?;
        let mut arena = Arena::of_size(size)?;
        let raw = place(&mut arena, config, from)?;
        Ok(Context { raw, size, arena: Some(arena), lender: PhantomData })
    }
}

/// Makes an empty context in the memory, or one in the state of `from`.
fn place(memory: &mut [u8], config: &Config, from: Option<&Context<'_>>) -> Result<NonNull<tpa_context>> {
    let (start, size) = (memory.as_mut_ptr().cast(), memory.len());
    let mut raw = ptr::null_mut();
    // SAFETY: the memory is borrowed, so it lies apart from the block of `from`.
    call(|issue| unsafe {
        match from {
            None => tpa_init(start, size, &config.raw, &mut raw, issue),
            Some(from) => tpa_grow(from.raw(), start, size, &config.raw, &mut raw, issue),
        }
    })?;
    Ok(NonNull::new(raw).expect("the context is at the start of the memory"))
}

impl<'m> Context<'m> {
    /// A context in memory of the caller: at least [`Config::arena_size`] bytes, at any address; an
    /// [`Arena`] for instance.
    ///
    /// ```
    /// # fn main() -> topoadapt::Result<()> {
    /// use topoadapt::{Arena, Config, Context};
    /// let config = Config::new().max_vertices(100);
    /// let mut arena = Arena::new(&config)?;
    /// let context = Context::new_in(&mut arena, &config)?;
    /// println!("{}", context.digest());
    /// drop(context);
    /// drop(arena);
    /// # Ok(()) }
    /// ```
    ///
    /// The memory stays lent as long as the context is in use:
    ///
    /// ```compile_fail,E0505
    /// # fn main() -> topoadapt::Result<()> {
    /// # use topoadapt::{Arena, Config, Context};
    /// # let config = Config::new().max_vertices(100);
    /// let mut arena = Arena::new(&config)?;
    /// let context = Context::new_in(&mut arena, &config)?;
    /// println!("{}", context.digest());
    /// drop(arena);
    /// drop(context);
    /// # Ok(()) }
    /// ```
    pub fn new_in(memory: &'m mut [u8], config: &Config) -> Result<Context<'m>> {
        Context::lent(memory, config, None)
    }

    fn lent(memory: &'m mut [u8], config: &Config, from: Option<&Context<'_>>) -> Result<Context<'m>> {
        let size = config.arena_size()?;
        Ok(Context { raw: place(memory, config, from)?, size, arena: None, lender: PhantomData })
    }

    /// Bytes from the last multiple of the alignment to the block.
    fn skipped(&self) -> usize {
        self.raw.as_ptr() as usize % self.size.alignment
    }

    /// The context for functions that read.
    pub(crate) fn raw(&self) -> *const tpa_context {
        self.raw.as_ptr()
    }

    /// The context for functions that write.
    pub(crate) fn raw_mut(&mut self) -> *mut tpa_context {
        self.raw.as_ptr()
    }

    /// A context with another config in memory of its own, in the state of this one. See
    /// [`with_room`](Context::with_room).
    pub fn grow(&self, config: &Config) -> Result<Context<'static>> {
        Context::owned(config, Some(self))
    }

    /// The same in memory of the caller.
    pub fn grow_in<'n>(&self, memory: &'n mut [u8], config: &Config) -> Result<Context<'n>> {
        Context::lent(memory, config, Some(self))
    }

    /// Makes a call, and makes it again in a larger context as often as it reaches a limit. The larger context owns its
    /// memory. The bits of the result are those of a context with room from the start.
    ///
    /// ```
    /// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
    /// # fn main() -> topoadapt::Result<()> {
    /// # let mut context = octahedron()?;
    /// let report = context.with_room(|context| context.step(None))?;
    /// # Ok(()) }
    /// ```
    pub fn with_room<T>(&mut self, mut work: impl FnMut(&mut Context<'m>) -> Result<T>) -> Result<T> {
        loop {
            let error = match work(self) {
                Ok(value) => return Ok(value),
                Err(error) => error,
            };
            let config = self.config()?.raised(&error).ok_or(error)?;
            *self = self.grow(&config)?;
        }
    }

    /// The config of the context.
    pub fn config(&self) -> Result<Config> {
        let mut raw = tpa_config { struct_size: struct_size::<tpa_config>(), ..Default::default() };
        // SAFETY: the library writes the config.
        check(unsafe { tpa_config_of(self.raw(), &mut raw) })?;
        Ok(Config { raw })
    }

    /// Replaces the mesh by a copy of the given mesh: closed, consistently oriented, 2-manifold, tangled or not.
    pub fn load<P: Coordinate, I: Index>(&mut self, positions: &[[P; 3]], triangles: &[[I; 3]]) -> Result<()> {
        let mesh = tpa_mesh_input {
            struct_size: struct_size::<tpa_mesh_input>(),
            vertex_count: count(positions.len())?,
            triangle_count: count(triangles.len())?,
            position_type: P::TYPE,
            index_type: I::TYPE,
            positions: positions.as_ptr().cast(),
            triangles: triangles.as_ptr().cast(),
            ..Default::default()
        };
        // SAFETY: types and counts are those of the slices, which the library reads during the call.
        call(|issue| unsafe { tpa_load(self.raw_mut(), &mesh, issue) })
    }

    /// Forgets the mesh, targets, maps and events.
    pub fn reset(&mut self) {
        // SAFETY: a context.
        check(unsafe { tpa_reset(self.raw_mut()) }).expect("a context can always be emptied");
    }

    /// The present mesh, without a copy.
    pub fn mesh(&self) -> Result<Mesh<'_>> {
        let mut view = tpa_mesh_view { struct_size: struct_size::<tpa_mesh_view>(), ..Default::default() };
        // SAFETY: the library writes the view.
        check(unsafe { tpa_view(self.raw(), &mut view) })?;
        // SAFETY: the arrays have three numbers for each vertex and triangle, and stay while self is borrowed.
        unsafe {
            Ok(Mesh {
                positions: slice_of(view.positions.cast(), view.vertex_count),
                triangles: slice_of(view.triangles.cast(), view.triangle_count),
                opposites: slice_of(view.opposites.cast(), view.triangle_count),
                epoch: view.epoch,
            })
        }
    }

    /// Copies the mesh out, in other types of numbers: `context.export::<f32, u16>()`.
    pub fn export<P: Coordinate, I: Index>(&self) -> Result<Export<P, I>> {
        let mesh = self.mesh()?;
        let mut positions = vec![[P::default(); 3]; mesh.positions.len()];
        let mut triangles = vec![[I::default(); 3]; mesh.triangles.len()];
        let mut output = tpa_mesh_output {
            struct_size: struct_size::<tpa_mesh_output>(),
            vertex_capacity: count(positions.len())?,
            triangle_capacity: count(triangles.len())?,
            position_type: P::TYPE,
            index_type: I::TYPE,
            positions: positions.as_mut_ptr().cast(),
            triangles: triangles.as_mut_ptr().cast(),
            ..Default::default()
        };
        // SAFETY: types and capacities are those of the vectors.
        call(|issue| unsafe { tpa_export(self.raw(), &mut output, issue) })?;
        Ok((positions, triangles))
    }

    /// Sets targets of all vertices for the next step or advance, as many as the mesh has vertices.
    pub fn move_all<P: Coordinate>(&mut self, targets: &[[P; 3]]) -> Result<()> {
        // Targets of a mesh before the last commit would go to other vertices.
        if targets.len() != self.mesh()?.positions.len() {
            return Err(Error::of_argument("a target is needed for each vertex of the mesh"));
        }
        self.set_targets(ptr::null(), targets)
    }

    /// Sets targets of the named vertices for the next step or advance; the last of equal ids wins. All others stay.
    pub fn move_vertices<P: Coordinate>(&mut self, vertices: &[u32], targets: &[[P; 3]]) -> Result<()> {
        if vertices.len() != targets.len() {
            return Err(Error::of_argument("a target is needed for each vertex"));
        }
        self.set_targets(vertices.as_ptr(), targets)
    }

    /// `vertices` is null, or has an id for each target.
    fn set_targets<P: Coordinate>(&mut self, vertices: *const u32, targets: &[[P; 3]]) -> Result<()> {
        let input = tpa_move_input {
            struct_size: struct_size::<tpa_move_input>(),
            count: count(targets.len())?,
            position_type: P::TYPE,
            positions: targets.as_ptr().cast(),
            vertices,
            ..Default::default()
        };
        // SAFETY: type and count are those of the slices, which the library reads during the call.
        call(|issue| unsafe { tpa_move(self.raw_mut(), &input, issue) })
    }

    /// The targets set since the last commit, by ascending vertices.
    pub fn targets(&self) -> Vec<(u32, [f64; 3])> {
        const READS: &str = "targets can always be read";
        let mut total = 0;
        // SAFETY: with capacity 0 the library writes only the number.
        check(unsafe { tpa_targets(self.raw(), ptr::null_mut(), ptr::null_mut(), 0, &mut total) }).expect(READS);
        let (mut ids, mut positions) = (vec![0; total as usize], vec![[0.; 3]; total as usize]);
        let positions_out = positions.as_mut_ptr().cast();
        // SAFETY: both vectors have room for `total` targets.
        check(unsafe { tpa_targets(self.raw(), ids.as_mut_ptr(), positions_out, total, &mut total) }).expect(READS);
        ids.into_iter().zip(positions).collect()
    }

    /// Drops all targets.
    pub fn drop_targets(&mut self) {
        // SAFETY: a context.
        check(unsafe { tpa_drop_targets(self.raw_mut()) }).expect("targets can always be dropped");
    }

    /// Moves vertices to their targets, detects contacts, adapts the topology, checks and commits. Needs and leaves a
    /// mesh free of self-intersections.
    pub fn step(&mut self, exec: Option<&Exec<'_>>) -> Result<Report> {
        // SAFETY: report_of gives valid structures.
        report_of(exec, |exec, report, issue| unsafe { tpa_step(self.raw_mut(), exec, report, issue) })
    }

    /// A step in sub-steps, so that no two points of the surface approach each other by `thickness` or more within a
    /// sub-step: only parts that are thinner can pass each other unseen. All sub-steps are one commit.
    ///
    /// ```
    /// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
    /// # fn main() -> topoadapt::Result<()> {
    /// # let mut context = octahedron()?;
    /// context.move_vertices(&[4], &[[0., 0., 5.]])?; // 2 upwards
    /// let report = context.with_room(|context| context.advance(0.3, None))?;
    /// assert!(report.substeps > 6 && report.approach < 0.3);
    /// # Ok(()) }
    /// ```
    pub fn advance(&mut self, thickness: f64, exec: Option<&Exec<'_>>) -> Result<Report> {
        // SAFETY: report_of gives valid structures.
        report_of(exec, |exec, report, issue| unsafe { tpa_advance(self.raw_mut(), thickness, exec, report, issue) })
    }

    /// Resolves a tangled mesh into the boundary of the region of winding number 1 or more.
    pub fn adapt(&mut self, exec: Option<&Exec<'_>>) -> Result<Report> {
        // SAFETY: report_of gives valid structures.
        report_of(exec, |exec, report, issue| unsafe { tpa_adapt(self.raw_mut(), exec, report, issue) })
    }

    /// Splits long edges, collapses short edges, flips edges and relaxes vertices. Topology never changes.
    /// Targets are dropped, also where a limit, the budget or the flag ends the call.
    pub fn remesh(&mut self, options: &Remesh<'_>, exec: Option<&Exec<'_>>) -> Result<Report> {
        let options = &options.raw(self.mesh()?.positions.len())?;
        // SAFETY: report_of gives valid structures, and the options are read only.
        report_of(exec, |exec, report, issue| unsafe { tpa_remesh(self.raw_mut(), options, exec, report, issue) })
    }

    /// Taubin smoothing of the named vertices, or of all, with the factors of the config.
    pub fn smooth(&mut self, iterations: u32, vertices: Option<&[u32]>, exec: Option<&Exec<'_>>) -> Result<Report> {
        let options = tpa_smooth_options {
            struct_size: struct_size::<tpa_smooth_options>(),
            iterations,
            count: count(vertices.map_or(0, <[u32]>::len))?,
            vertices: vertices.map_or(ptr::null(), <[u32]>::as_ptr),
            ..Default::default()
        };
        // SAFETY: report_of gives valid structures, and the options are read only.
        report_of(exec, |exec, report, issue| unsafe { tpa_smooth(self.raw_mut(), &options, exec, report, issue) })
    }

    /// Renumbers vertices and triangles along a curve through space, so that near ones lie near in memory: a commit of
    /// new numbers alone. Drops targets.
    pub fn reorder(&mut self) -> Result<()> {
        // SAFETY: a context.
        call(|issue| unsafe { tpa_reorder(self.raw_mut(), issue) })
    }

    /// All pairs of triangles that meet anywhere but in a common vertex or edge. Leaves the mesh alone.
    pub fn detect(&mut self, exec: Option<&Exec<'_>>) -> Result<Contacts<'_>> {
        let exec = Exec::raw(exec);
        let mut contacts = tpa_contacts { struct_size: struct_size::<tpa_contacts>(), ..Default::default() };
        // SAFETY: the library writes the structure.
        call(|issue| unsafe { tpa_detect(self.raw_mut(), &exec, &mut contacts, issue) })?;
        // SAFETY: pairs are two numbers each, and stay until the next call that writes: self is borrowed.
        let pairs = unsafe { slice_of(contacts.pairs.cast(), contacts.count) };
        Ok(Contacts { mesh: self.mesh()?, pairs })
    }

    /// Checks the whole mesh from its triangles alone, and measures it. Leaves the mesh alone.
    pub fn validate(&mut self, exec: Option<&Exec<'_>>) -> Result<Validation> {
        let exec = Exec::raw(exec);
        let mut raw = tpa_validation { struct_size: struct_size::<tpa_validation>(), ..Default::default() };
        // SAFETY: the library writes the structure.
        call(|issue| unsafe { tpa_validate(self.raw_mut(), &exec, &mut raw, issue) })?;
        Ok(Validation {
            components: raw.components,
            self_intersections: raw.self_intersections,
            euler: raw.euler,
            genus: raw.genus,
            volume: raw.volume,
            area: raw.area,
        })
    }
}

/// Makes a call that reports.
fn report_of(
    exec: Option<&Exec<'_>>,
    work: impl FnOnce(&tpa_exec, &mut tpa_report, &mut tpa_issue) -> tpa_status,
) -> Result<Report> {
    let exec = Exec::raw(exec);
    let mut report = tpa_report { struct_size: struct_size::<tpa_report>(), ..Default::default() };
    call(|issue| work(&exec, &mut report, issue))?;
    Ok(Report::of(&report))
}

impl Clone for Context<'_> {
    fn clone(&self) -> Self {
        let layout = Layout::from_size_align(self.size.bytes, self.size.alignment).expect("the block has a layout");
        let skipped = self.skipped();
        let size = ArenaSize { bytes: self.size.bytes + skipped, ..self.size };
        let arena = Arena::of_size(size).unwrap_or_else(|_| handle_alloc_error(layout));
        // SAFETY: the arena has so many bytes.
        let raw = unsafe { NonNull::new_unchecked(arena.start().as_ptr().add(skipped)) };
        // SAFETY: both blocks have size.bytes bytes and addresses equal modulo the alignment, so the copy is a context.
        unsafe { ptr::copy_nonoverlapping(self.raw.as_ptr().cast(), raw.as_ptr(), self.size.bytes) };
        Context { raw: raw.cast(), size: self.size, arena: Some(arena), lender: PhantomData }
    }

    fn clone_from(&mut self, source: &Self) {
        if self.size != source.size || self.skipped() != source.skipped() {
            *self = source.clone();
            return;
        }
        // SAFETY: as in clone; two borrows are two blocks.
        unsafe { ptr::copy_nonoverlapping(source.raw.as_ptr().cast::<u8>(), self.raw.as_ptr().cast(), self.size.bytes) }
    }
}

impl fmt::Debug for Context<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vertices, triangles) = self.mesh().map_or((0, 0), |mesh| (mesh.positions.len(), mesh.triangles.len()));
        f.debug_struct("Context")
            .field("vertices", &vertices)
            .field("triangles", &triangles)
            .field("arena", &self.arena)
            .finish()
    }
}
