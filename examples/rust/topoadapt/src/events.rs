// SPDX-License-Identifier: MIT
use core::iter::FusedIterator;
use core::slice;
use topoadapt_sys::*;

/// An event of the last commit. A component is named by its smallest vertex id, `before` or `after` the commit.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A handle joined polygons.
    Handle {
        /// Number of the polygons.
        polygons: u32,
        /// Mean of the polygons' vertices.
        position: [f64; 3],
    },
    /// Caps closed the polygons of a piece.
    Cap {
        /// Number of the polygons.
        polygons: u32,
        /// Mean of the polygons' vertices.
        position: [f64; 3],
    },
    /// Swallowed or inverted patches or components were removed at once.
    Removal {
        /// Number of vertices removed.
        vertices: u32,
    },
    /// Vertices kept their old positions.
    Rollback {
        /// Number of these vertices; [`Context::rolled_back`](crate::Context::rolled_back) lists them.
        vertices: u32,
        /// The first place without a solution.
        position: [f64; 3],
    },
    /// Components became a single one.
    Merge {
        /// Number of components before.
        components: u32,
        /// The smallest of them.
        before: u32,
        /// The component that they became.
        after: u32,
    },
    /// A component came apart: an event for each piece.
    Split {
        /// Number of pieces.
        pieces: u32,
        /// The component before.
        before: u32,
        /// A piece.
        after: u32,
    },
    /// Genus grew.
    GenusUp {
        /// By so much, in all related components together.
        amount: u32,
        /// The smallest related component before.
        before: u32,
        /// The smallest related component after.
        after: u32,
    },
    /// Genus fell.
    GenusDown {
        /// By so much, in all related components together.
        amount: u32,
        /// The smallest related component before.
        before: u32,
        /// The smallest related component after.
        after: u32,
    },
    /// A component is gone.
    Death {
        /// The component before.
        before: u32,
    },
    /// An event of a newer library.
    Other {
        /// Its number.
        kind: i32,
    },
}

impl Event {
    fn of(raw: &tpa_event) -> Event {
        let tpa_event { type_: kind, amount, before, after, position } = *raw;
        match kind as tpa_event_type {
            TPA_EVENT_HANDLE => Event::Handle { polygons: amount, position },
            TPA_EVENT_CAP => Event::Cap { polygons: amount, position },
            TPA_EVENT_REMOVAL => Event::Removal { vertices: amount },
            TPA_EVENT_ROLLBACK => Event::Rollback { vertices: amount, position },
            TPA_EVENT_MERGE => Event::Merge { components: amount, before, after },
            TPA_EVENT_SPLIT => Event::Split { pieces: amount, before, after },
            TPA_EVENT_GENUS_UP => Event::GenusUp { amount, before, after },
            TPA_EVENT_GENUS_DOWN => Event::GenusDown { amount, before, after },
            TPA_EVENT_DEATH => Event::Death { before },
            _ => Event::Other { kind },
        }
    }
}

/// Iterator over the events of the last commit, from [`Context::events`](crate::Context::events).
#[derive(Clone, Debug)]
pub struct Events<'a>(pub(crate) slice::Iter<'a, tpa_event>);

impl Iterator for Events<'_> {
    type Item = Event;
    fn next(&mut self) -> Option<Event> {
        self.0.next().map(Event::of)
    }
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.size_hint()
    }
}

impl DoubleEndedIterator for Events<'_> {
    fn next_back(&mut self) -> Option<Event> {
        self.0.next_back().map(Event::of)
    }
}

impl ExactSizeIterator for Events<'_> {}
impl FusedIterator for Events<'_> {}
