// SPDX-License-Identifier: MIT
//! Finds the installed library: in the folder TOPOADAPT_LIB_DIR, else by pkg-config. The static library goes first.
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

fn folder_of_pkg_config() -> PathBuf {
    let program = env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".into());
    match Command::new(&program).args(["--variable=libdir", "topoadapt"]).output() {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).trim().into(),
        _ => panic!("{program} does not find topoadapt: set PKG_CONFIG_PATH, or TOPOADAPT_LIB_DIR"),
    }
}

fn archive_in(folder: &Path) -> Option<PathBuf> {
    let names = ["libtopoadapt.a", "topoadapt.lib"];
    names.iter().map(|name| folder.join(name)).find(|path| path.exists())
}

fn main() {
    for name in ["TOPOADAPT_LIB_DIR", "PKG_CONFIG", "PKG_CONFIG_PATH"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    let folder = env::var_os("TOPOADAPT_LIB_DIR").map_or_else(folder_of_pkg_config, PathBuf::from);
    println!("cargo:rustc-link-search=native={}", folder.display());
    match archive_in(&folder) {
        Some(archive) => {
            println!("cargo:rerun-if-changed={}", archive.display());
            println!("cargo:rustc-link-lib=static=topoadapt");
        }
        None => println!("cargo:rustc-link-lib=dylib=topoadapt"),
    }
}
