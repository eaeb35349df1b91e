// SPDX-License-Identifier: MIT
use std::mem::size_of;
use std::slice;

/// Content of the field struct_size of an interface structure.
pub(crate) fn struct_size<T>() -> u32 {
    size_of::<T>() as u32
}

/// A slice of what the library points to; empty for a null pointer.
///
/// # Safety
/// `first` is null, or points to `count` elements that live and do not change within 'a.
pub(crate) unsafe fn slice_of<'a, T>(first: *const T, count: u32) -> &'a [T] {
    if first.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: as the caller promises.
    unsafe { slice::from_raw_parts(first, count as usize) }
}
