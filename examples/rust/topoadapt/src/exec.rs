// SPDX-License-Identifier: MIT
use crate::raw::struct_size;
#[cfg(feature = "std")]
use crate::threads::parallel_for;
use core::sync::atomic::{AtomicI32, AtomicU64};
use topoadapt_sys::tpa_exec;

/// How a call is carried out: threads, and bounds on the work. Nothing here changes the bits of a result.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/mod.rs"));
/// # fn main() -> topoadapt::Result<()> {
/// use std::sync::atomic::{AtomicI32, Ordering};
/// use topoadapt::{Exec, Status};
/// # let mut context = octahedron()?;
/// let stop = AtomicI32::new(0); // any thread may set it
/// let exec = Exec::new().threads(4).budget(1_000_000).cancel(&stop);
/// context.step(Some(&exec))?;
/// stop.store(1, Ordering::Relaxed);
/// assert_eq!(context.step(Some(&exec)).unwrap_err().status(), Status::Cancelled);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Exec<'a> {
    #[cfg(feature = "std")]
    threads: usize,
    budget: u64,
    cancel: Option<&'a AtomicI32>,
    progress: Option<&'a AtomicU64>,
}

impl<'a> Exec<'a> {
    /// Serial, and without a bound.
    pub fn new() -> Exec<'a> {
        Exec::default()
    }

    /// Threads that share the work, the calling thread among them. They are started and joined within the call, for
    /// each of its parallel parts: worth their while from some ten thousand vertices.
    #[cfg(feature = "std")]
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Exec<'a> {
        self.threads = threads;
        self
    }

    /// Units of work that a call may spend; more is [`Status::Budget`](crate::Status::Budget). 0: no bound.
    #[must_use]
    pub fn budget(mut self, units: u64) -> Exec<'a> {
        self.budget = units;
        self
    }

    /// A flag that ends the call with [`Status::Cancelled`](crate::Status::Cancelled) as soon as it is not zero.
    #[must_use]
    pub fn cancel(mut self, flag: &'a AtomicI32) -> Exec<'a> {
        self.cancel = Some(flag);
        self
    }

    /// Receives the units of work spent so far, now and then, and at the end.
    #[must_use]
    pub fn progress(mut self, units: &'a AtomicU64) -> Exec<'a> {
        self.progress = Some(units);
        self
    }

    /// For a call that ends before the borrow of `exec` does.
    pub(crate) fn raw(exec: Option<&Exec<'_>>) -> tpa_exec {
        let mut raw = tpa_exec { struct_size: struct_size::<tpa_exec>(), ..Default::default() };
        if let Some(exec) = exec {
            raw.budget = exec.budget;
            raw.cancel = exec.cancel.map_or(raw.cancel, |flag| flag as *const AtomicI32 as *const i32);
            raw.progress = exec.progress.map_or(raw.progress, |units| units as *const AtomicU64 as *mut u64);
            #[cfg(feature = "std")]
            if exec.threads > 1 {
                raw.user = &exec.threads as *const usize as *mut _;
                raw.parallel_for = Some(parallel_for);
            }
        }
        raw
    }
}
