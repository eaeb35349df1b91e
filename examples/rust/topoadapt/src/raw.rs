// SPDX-License-Identifier: MIT
use core::mem::size_of;
use core::slice;
use topoadapt_sys::ctypes::c_char;

/// Content of the field struct_size of an interface structure.
pub(crate) fn struct_size<T>() -> u32 {
    size_of::<T>() as u32
}

/// A line of text of the library.
///
/// # Safety
/// `line` points to a terminated string in static storage.
pub(crate) unsafe fn text_of(line: *const c_char) -> &'static str {
    let first = line.cast::<u8>();
    // SAFETY: all bytes up to the terminator can be read.
    let length = (0..).take_while(|&i| unsafe { *first.add(i) } != 0).count();
    // SAFETY: as many bytes as have been read.
    core::str::from_utf8(unsafe { slice::from_raw_parts(first, length) }).unwrap_or_default()
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
