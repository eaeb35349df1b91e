// SPDX-License-Identifier: MIT
//! The threads of [`Exec`](crate::Exec).
use std::os::raw::c_void;
use std::thread;

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
pub(crate) unsafe extern "C" fn parallel_for(user: *mut c_void, count: u32, task: Option<Task>, data: *mut c_void) {
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
    use crate::Exec;
    use std::collections::HashSet;
    use std::sync::Mutex;
    use std::thread::ThreadId;
    use std::vec::Vec;

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
