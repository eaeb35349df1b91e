// SPDX-License-Identifier: MIT
//! Links the library of the folder TOPOADAPT_LIB_DIR. Without the variable compiles the source in the crate; a checkout
//! has no source in the crate, and asks pkg-config. A static library goes before a shared one.
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

const SOURCE: &str = "source/topoadapt.cpp";

fn main() {
    for name in ["TOPOADAPT_LIB_DIR", "PKG_CONFIG", "PKG_CONFIG_PATH"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    println!("cargo:rerun-if-changed={SOURCE}");
    match env::var_os("TOPOADAPT_LIB_DIR") {
        Some(folder) => link(Path::new(&folder)),
        None if Path::new(SOURCE).exists() => compile(),
        None => link(&folder_of_pkg_config()),
    }
}

/// As docs/guide.md of the library has it under "Compiler flags". Always optimized: a library without optimization is
/// some ten times slower, and no debugger needs to go there. No C++ run-time library is linked.
fn compile() {
    let mut build = cc::Build::new();
    build.cpp(true).cpp_link_stdlib(None).file(SOURCE).warnings(false).opt_level(2);
    build.flag_if_supported("-std=c++20").flag_if_supported("/std:c++20");
    for flag in ["-ffp-contract=off", "-fno-exceptions", "-fno-asynchronous-unwind-tables", "-fno-rtti"] {
        build.flag_if_supported(flag);
    }
    for flag in ["-fno-threadsafe-statics", "-fno-math-errno", "-fvisibility=hidden"] {
        build.flag_if_supported(flag);
    }
    if env::var("CARGO_CFG_TARGET_ARCH").as_deref() == Ok("x86") {
        build.flag_if_supported("-msse2").flag_if_supported("-mfpmath=sse");
    }
    build.compile("topoadapt");
}

fn link(folder: &Path) {
    println!("cargo:rustc-link-search=native={}", folder.display());
    match archive_in(folder) {
        Some(archive) => {
            println!("cargo:rerun-if-changed={}", archive.display());
            println!("cargo:rustc-link-lib=static=topoadapt");
        }
        None => println!("cargo:rustc-link-lib=dylib=topoadapt"),
    }
}

fn archive_in(folder: &Path) -> Option<PathBuf> {
    let names = ["libtopoadapt.a", "topoadapt.lib"];
    names.iter().map(|name| folder.join(name)).find(|path| path.exists())
}

fn folder_of_pkg_config() -> PathBuf {
    let program = env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".into());
    match Command::new(&program).args(["--variable=libdir", "topoadapt"]).output() {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).trim().into(),
        _ => panic!("{program} does not find topoadapt: set PKG_CONFIG_PATH, or TOPOADAPT_LIB_DIR"),
    }
}
