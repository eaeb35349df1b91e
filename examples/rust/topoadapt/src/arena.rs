// SPDX-License-Identifier: MIT
use crate::{ArenaSize, Config, Error, Result};
use alloc::alloc::{alloc_zeroed, dealloc, Layout};
use core::fmt;
use core::ops::{Deref, DerefMut};
use core::ptr::NonNull;
use core::slice;

/// Aligned memory, owned as a `Vec<u8>` owns its own; for [`Context::new_in`](crate::Context::new_in).
pub struct Arena {
    start: NonNull<u8>,
    layout: Layout,
}

// SAFETY: the arena owns its bytes alone.
unsafe impl Send for Arena {}
// SAFETY: a shared arena is only read.
unsafe impl Sync for Arena {}

impl Arena {
    /// Memory for a context with this config, all zero.
    pub fn new(config: &Config) -> Result<Arena> {
        Arena::of_size(config.arena_size()?)
    }

    pub(crate) fn of_size(size: ArenaSize) -> Result<Arena> {
        let none = || Error::out_of_memory(size.bytes);
        let layout = Layout::from_size_align(size.bytes.max(1), size.alignment).map_err(|_| none())?;
        // SAFETY: the layout has a size above zero.
        let start = NonNull::new(unsafe { alloc_zeroed(layout) }).ok_or_else(none)?;
        Ok(Arena { start, layout })
    }

    pub(crate) fn start(&self) -> NonNull<u8> {
        self.start
    }
}

impl Drop for Arena {
    fn drop(&mut self) {
        // SAFETY: of_size has allocated with this layout.
        unsafe { dealloc(self.start.as_ptr(), self.layout) }
    }
}

impl Deref for Arena {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        // SAFETY: of_size has allocated and zeroed so many bytes.
        unsafe { slice::from_raw_parts(self.start.as_ptr(), self.layout.size()) }
    }
}

impl DerefMut for Arena {
    fn deref_mut(&mut self) -> &mut [u8] {
        // SAFETY: as in deref, and the arena is borrowed mutably.
        unsafe { slice::from_raw_parts_mut(self.start.as_ptr(), self.layout.size()) }
    }
}

impl fmt::Debug for Arena {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Arena({:?})", self.layout)
    }
}
