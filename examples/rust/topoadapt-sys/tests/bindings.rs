// SPDX-License-Identifier: MIT
//! The checked-in bindings are those that bindgen makes of the header today, with every constant, and with the layouts
//! of a C compiler.
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const CHECKED_IN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/bindings.rs");
const HEADER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../include/topoadapt.h");
const OPTIONS: [&str; 13] = [
    "--allowlist-function=tpa_.*",
    "--allowlist-type=tpa_.*",
    "--allowlist-var=TPA_.*",
    "--no-recursive-allowlist",
    "--no-prepend-enum-name",
    "--with-derive-default",
    "--with-derive-partialeq",
    "--no-partialeq=tpa_exec",
    "--raw-line=// SPDX-License-Identifier: MIT",
    "--raw-line=// Made by bindgen from topoadapt.h: see lib.rs.",
    "--raw-line=type size_t = usize;",
    "--no-doc-comments",
    "--",
];

/// Output of a program; None, with a message, if it is missing or fails for want of libclang.
fn run(program: &str, arguments: &[&str]) -> Option<String> {
    match Command::new(program).args(arguments).output() {
        Ok(output) if output.status.success() => Some(String::from_utf8(output.stdout).unwrap()),
        Ok(output) => {
            println!("skipped: {program}: {}", String::from_utf8_lossy(&output.stderr));
            None
        }
        Err(error) => {
            println!("skipped: {program}: {error}");
            None
        }
    }
}

fn bindgen(more: &[&str]) -> Option<String> {
    if !Path::new(HEADER).exists() {
        println!("skipped: no {HEADER}");
        return None;
    }
    let arguments: Vec<&str> = [HEADER].iter().chain(more).chain(&OPTIONS).copied().collect();
    run("bindgen", &arguments)
}

/// Without the version of bindgen, white space and commas, on which versions and formatters differ.
fn essence(bindings: &str) -> String {
    let lines = bindings.lines().filter(|line| !line.starts_with("/* automatically generated"));
    lines.flat_map(str::chars).filter(|c| !c.is_whitespace() && *c != ',').collect()
}

/// Names of macros and enumerators with a numeric value.
fn constants(header: &str) -> Vec<&str> {
    let is_name = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_';
    let mut found = Vec::new();
    for (at, _) in header.match_indices("TPA_") {
        let name = &header[at..at + header[at..].find(|c| !is_name(c)).unwrap()];
        let value = header[at + name.len()..].trim_start_matches([' ', '=']);
        let is_defined = header[at + name.len()..].starts_with(' ');
        if is_defined && value.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            found.push(name);
        }
    }
    found
}

#[test]
fn are_those_of_today_with_every_constant() {
    if let Some(today) = bindgen(&["--no-layout-tests", "--use-core", "--ctypes-prefix=crate::ctypes"]) {
        compare(&today);
    }
    match fs::read_to_string(HEADER) {
        Ok(header) => find_constants(&header),
        Err(error) => println!("skipped: {HEADER}: {error}"),
    }
}

fn compare(today: &str) {
    if env::var_os("TOPOADAPT_WRITE_BINDINGS").is_some() {
        fs::write(CHECKED_IN, today).unwrap();
    }
    let checked_in = fs::read_to_string(CHECKED_IN).unwrap();
    assert!(
        essence(&checked_in) == essence(today),
        "topoadapt.h has changed: TOPOADAPT_WRITE_BINDINGS=1 cargo test -p topoadapt-sys"
    );
}

fn find_constants(header: &str) {
    let bindings = fs::read_to_string(CHECKED_IN).unwrap();
    let names = constants(header);
    assert!(names.len() >= 55, "only {names:?} read");
    for name in names {
        assert!(bindings.contains(&format!("pub const {name}: ")), "{name} is missing");
    }
    assert!(bindings.contains("pub const TPA_NONE: u32 = 4294967295;"));
}

/// Bindgen's own tests compare with the compiler that reads the header; since 0.70 they are assertions of constants.
#[test]
fn have_the_layouts_of_c() {
    let today = match bindgen(&[]) {
        Some(text) => text,
        None => return,
    };
    assert!(today.contains("bindgen_test_layout_tpa_report") || today.contains("const _: () ="));
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let (source, program) = (folder.join("layouts.rs"), folder.join("layouts"));
    fs::write(&source, today).unwrap();
    let rustc = env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let status = Command::new(rustc)
        .args(["--edition=2021", "--test", "-Awarnings", "-o"])
        .args([&program, &source])
        .status()
        .unwrap();
    assert!(status.success());
    assert!(Command::new(program).status().unwrap().success());
}
