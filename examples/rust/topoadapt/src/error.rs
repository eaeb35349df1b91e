// SPDX-License-Identifier: MIT
use alloc::string::String;
use core::fmt;
use topoadapt_sys::*;

/// Outcome of a call that can fail.
pub type Result<T> = core::result::Result<T, Error>;

/// Kinds of failure.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// A value out of range, or slices of lengths that do not fit together.
    Argument,
    /// A [`Config`](crate::Config) with a value out of range, or unlike the config of a saved state.
    Config,
    /// A size beyond the address space.
    Overflow,
    /// Memory too small: [`Error::needed`] is the number of bytes.
    Arena,
    /// The allocator has no memory of [`Error::needed`] bytes.
    OutOfMemory,
    /// No mesh is loaded.
    NoMesh,
    /// [`Error::limit`] is reached; [`Config::raised`](crate::Config::raised) makes room.
    Limit,
    /// No closed oriented 2-manifold, or an unusable coordinate or id: see [`Error::defect`].
    Mesh,
    /// The call needs a mesh free of self-intersections: call [`Context::adapt`](crate::Context::adapt) once.
    Tangled,
    /// The floating-point environment is not as needed, and the platform has no way to set it.
    Environment,
    /// The budget of [`Exec`](crate::Exec) is spent.
    Budget,
    /// The flag of [`Exec`](crate::Exec) has cancelled the call.
    Cancelled,
    /// No saved state, of a newer version, or damaged: [`Error::element`] is the offset of the first bad byte.
    Data,
    /// A status of a newer library.
    Other(i32),
}

/// The limits of a [`Config`](crate::Config).
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Limit {
    /// [`Config::max_vertices`](crate::Config::max_vertices)
    Vertices,
    /// [`Config::max_triangles`](crate::Config::max_triangles)
    Triangles,
    /// [`Config::max_contacts`](crate::Config::max_contacts)
    Contacts,
    /// [`Config::max_cut_edges`](crate::Config::max_cut_edges)
    CutEdges,
    /// [`Config::max_events`](crate::Config::max_events)
    Events,
    /// [`Config::max_components`](crate::Config::max_components)
    Components,
    /// [`Config::max_pieces`](crate::Config::max_pieces)
    Pieces,
    /// [`Config::max_substeps`](crate::Config::max_substeps)
    Substeps,
}

/// Defects of a mesh, in the order in which they are looked for.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Defect {
    /// Vertex `element` has a NaN or infinite coordinate; in a move its target, at place `other` of the list.
    NotFinite,
    /// Likewise with a coordinate that is not zero, and of magnitude outside 2^-100 to 2^100.
    Magnitude,
    /// Triangle `element`, or place `element` of a list of ids, names an unknown vertex `other`.
    IndexRange,
    /// Triangle `element` uses vertex `other` twice.
    RepeatedVertex,
    /// Two triangles run in the same direction through the edge of vertices `element` and `other`.
    Orientation,
    /// The edge of vertices `element` and `other` has more than two triangles.
    NonManifoldEdge,
    /// The edge of vertices `element` and `other` has a single triangle.
    BoundaryEdge,
    /// The triangles at vertex `element` form more than one fan.
    NonManifoldVertex,
    /// Vertex `element` belongs to no triangle.
    IsolatedVertex,
}

/// A failed call: its status, the element at fault, and a line of English ([`Display`](fmt::Display)). The failure has
/// left mesh, maps and events bit for bit as before.
#[derive(Clone, Copy)]
pub struct Error {
    issue: tpa_issue,
    /// Text of errors that this crate finds by itself; empty for those of the library.
    note: &'static str,
}

impl Error {
    pub(crate) fn of_argument(note: &'static str) -> Error {
        Error { issue: tpa_issue { status: TPA_E_ARGUMENT, ..Default::default() }, note }
    }

    pub(crate) fn out_of_memory(bytes: usize) -> Error {
        let issue = tpa_issue { status: TPA_E_ARENA, needed: bytes as u64, ..Default::default() };
        Error { issue, note: OUT_OF_MEMORY }
    }

    /// The kind of failure.
    pub fn status(&self) -> Status {
        match self.issue.status {
            TPA_E_ARENA if self.note == OUT_OF_MEMORY => Status::OutOfMemory,
            TPA_E_ARGUMENT => Status::Argument,
            TPA_E_CONFIG => Status::Config,
            TPA_E_OVERFLOW => Status::Overflow,
            TPA_E_ARENA => Status::Arena,
            TPA_E_STATE => Status::NoMesh,
            TPA_E_LIMIT => Status::Limit,
            TPA_E_MESH => Status::Mesh,
            TPA_E_TANGLED => Status::Tangled,
            TPA_E_ENVIRONMENT => Status::Environment,
            TPA_E_BUDGET => Status::Budget,
            TPA_E_CANCELLED => Status::Cancelled,
            TPA_E_DATA => Status::Data,
            other => Status::Other(other),
        }
    }

    /// The limit to raise, with [`Status::Limit`].
    pub fn limit(&self) -> Option<Limit> {
        Some(match self.issue.limit as tpa_limit {
            TPA_LIMIT_VERTICES => Limit::Vertices,
            TPA_LIMIT_TRIANGLES => Limit::Triangles,
            TPA_LIMIT_CONTACTS => Limit::Contacts,
            TPA_LIMIT_CUT => Limit::CutEdges,
            TPA_LIMIT_EVENTS => Limit::Events,
            TPA_LIMIT_COMPONENTS => Limit::Components,
            TPA_LIMIT_PIECES => Limit::Pieces,
            TPA_LIMIT_SUBSTEPS => Limit::Substeps,
            _ => return None,
        })
    }

    /// The defect, with [`Status::Mesh`].
    pub fn defect(&self) -> Option<Defect> {
        if self.status() != Status::Mesh {
            return None;
        }
        Some(match self.issue.defect as tpa_defect {
            TPA_DEFECT_NOT_FINITE => Defect::NotFinite,
            TPA_DEFECT_MAGNITUDE => Defect::Magnitude,
            TPA_DEFECT_INDEX_RANGE => Defect::IndexRange,
            TPA_DEFECT_REPEATED_VERTEX => Defect::RepeatedVertex,
            TPA_DEFECT_ORIENTATION => Defect::Orientation,
            TPA_DEFECT_NON_MANIFOLD_EDGE => Defect::NonManifoldEdge,
            TPA_DEFECT_BOUNDARY_EDGE => Defect::BoundaryEdge,
            TPA_DEFECT_NON_MANIFOLD_VERTEX => Defect::NonManifoldVertex,
            TPA_DEFECT_ISOLATED_VERTEX => Defect::IsolatedVertex,
            _ => return None,
        })
    }

    /// Id of the element at fault, or 0.
    pub fn element(&self) -> u64 {
        self.issue.element
    }

    /// A second id, or 0.
    pub fn other(&self) -> u64 {
        self.issue.other
    }

    /// An amount that is enough (bytes, elements, units of work), or 0.
    pub fn needed(&self) -> u64 {
        self.issue.needed
    }

    /// The amount at hand, or 0.
    pub fn available(&self) -> u64 {
        self.issue.available
    }
}

const OUT_OF_MEMORY: &str = "the allocator has no such block";

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.note.is_empty() {
            return f.write_str(self.note);
        }
        let mut line = [0u8; 256];
        // SAFETY: the library reads the issue, and writes at most line.len() bytes, the last of them zero.
        let length = unsafe { tpa_issue_text(&self.issue, line.as_mut_ptr().cast(), line.len()) };
        f.write_str(&String::from_utf8_lossy(&line[..length.min(line.len() - 1)]))
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Error({:?}: {self})", self.status())
    }
}

#[cfg(feature = "std")]
impl std::error::Error for Error {}

/// Makes a result of a call that fills an issue.
pub(crate) fn call(function: impl FnOnce(&mut tpa_issue) -> tpa_status) -> Result<()> {
    let mut issue = tpa_issue::default();
    match function(&mut issue) {
        TPA_OK => Ok(()),
        status => Err(Error { issue: tpa_issue { status, ..issue }, note: "" }),
    }
}

/// Makes a result of the status of a call without an issue.
pub(crate) fn check(status: tpa_status) -> Result<()> {
    call(|_| status)
}

/// Numbers of elements are 32 bits wide.
pub(crate) fn count(length: usize) -> Result<u32> {
    u32::try_from(length).map_err(|_| Error::of_argument("a slice has more than 2^32 - 1 elements"))
}
