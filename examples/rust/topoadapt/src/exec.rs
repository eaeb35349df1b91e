// SPDX-License-Identifier: MIT
use crate::raw::struct_size;
use std::os::raw::c_void;
use std::sync::atomic::{AtomicI32, AtomicU64};
use std::thread;
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
            if exec.threads > 1 {
                raw.user = &exec.threads as *const usize as *mut c_void;
                raw.parallel_for = Some(parallel_for);
            }
        }
        raw
    }
}

type Task = unsafe extern "C" fn(data: *mut c_void, index: u32);

struct Job {
    task: Task,
    data: *mut c_void,
    count: u32,
    parts: u32,
}

// SAFETY: the library shares `data` between its tasks, of any threads.
unsafe impl Sync for Job {}

impl Job {
    /// Runs a run of neighbouring indices, the same in every call.
    fn run(&self, part: u32) {
        let bound = |part: u32| (u64::from(self.count) * u64::from(part) / u64::from(self.parts)) as u32;
        for index in bound(part)..bound(part + 1) {
            // SAFETY: the library asks for one call for each index below count.
            unsafe { (self.task)(self.data, index) }
        }
    }
}

/// tpa_exec.parallel_for. `user` points to the number of threads.
unsafe extern "C" fn parallel_for(user: *mut c_void, count: u32, task: Option<Task>, data: *mut c_void) {
    // SAFETY: Exec::raw has put it there, and the call has not ended.
    let threads = unsafe { *(user as *const usize) };
    let parts = u32::try_from(threads).unwrap_or(u32::MAX).min(count);
    let job = match task {
        Some(task) if count > 0 => Job { task, data, count, parts },
        _ => return,
    };
    let job = &job;
    thread::scope(|scope| {
        for part in 1..parts {
            // No panic may leave a function that C calls: without another thread this one does the work.
            if thread::Builder::new().spawn_scoped(scope, move || job.run(part)).is_err() {
                job.run(part);
            }
        }
        job.run(0);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;
    use std::sync::Mutex;
    use std::thread::ThreadId;

    type Calls = Mutex<Vec<(u32, ThreadId)>>;

    unsafe extern "C" fn note(calls: *mut c_void, index: u32) {
        // SAFETY: the test hands over its list.
        let calls = unsafe { &*(calls as *const Calls) };
        calls.lock().unwrap().push((index, thread::current().id()));
    }

    #[test]
    fn each_index_runs_once_on_its_thread() {
        for threads in 2..9 {
            for count in 0..20 {
                let calls = Calls::default();
                let exec = Exec::new().threads(threads);
                let raw = Exec::raw(Some(&exec));
                let data = &calls as *const Calls as *mut c_void;
                // SAFETY: `note` takes the list, which lives on.
                unsafe { raw.parallel_for.unwrap()(raw.user, count, Some(note), data) };
                let mut calls = calls.into_inner().unwrap();
                calls.sort_by_key(|call| call.0);
                assert!(calls.iter().map(|call| call.0).eq(0..count), "{threads} threads, {count} tasks");
                let ids: HashSet<ThreadId> = calls.iter().map(|call| call.1).collect();
                assert_eq!(ids.len(), threads.min(count as usize));
            }
        }
        assert!(Exec::raw(Some(&Exec::new().threads(1))).parallel_for.is_none());
    }
}
