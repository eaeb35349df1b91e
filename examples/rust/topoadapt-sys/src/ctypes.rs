// SPDX-License-Identifier: MIT
//! Types of C without the standard library, which core has since Rust 1.64.
pub use core::ffi::c_void;

/// `int`.
pub type c_int = i32;
/// `unsigned`.
pub type c_uint = u32;

/// `char`, which has a sign or none by the platform.
#[cfg(all(
    any(
        target_arch = "aarch64",
        target_arch = "arm",
        target_arch = "powerpc",
        target_arch = "powerpc64",
        target_arch = "riscv32",
        target_arch = "riscv64",
        target_arch = "s390x"
    ),
    not(any(target_vendor = "apple", windows))
))]
pub type c_char = u8;
/// `char`, which has a sign or none by the platform.
#[cfg(not(all(
    any(
        target_arch = "aarch64",
        target_arch = "arm",
        target_arch = "powerpc",
        target_arch = "powerpc64",
        target_arch = "riscv32",
        target_arch = "riscv64",
        target_arch = "s390x"
    ),
    not(any(target_vendor = "apple", windows))
)))]
pub type c_char = i8;

// The standard library agrees.
#[cfg(test)]
mod tests {
    extern crate std;

    #[test]
    fn are_those_of_the_standard_library() {
        let _: [super::c_char; 0] = [0 as std::os::raw::c_char; 0];
        let _: [super::c_int; 0] = [0 as std::os::raw::c_int; 0];
        let _: [super::c_uint; 0] = [0 as std::os::raw::c_uint; 0];
    }
}
