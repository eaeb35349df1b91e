// SPDX-License-Identifier: MIT
//! The C interface of topoadapt, as bindgen reads `topoadapt.h`. The header documents every name; the crate `topoadapt`
//! is the safe interface.
//!
//! After a change of the header, `TOPOADAPT_WRITE_BINDINGS=1 cargo test -p topoadapt-sys` writes `bindings.rs` anew.
#![allow(non_camel_case_types)]
#![no_std]

mod bindings;
pub mod ctypes;
pub use bindings::*;
