#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Opens what cmake/release.sh has made, each file in an empty folder and without the clone: builds or installs as the
# documentation says, and runs a program whose output is known. Prints size and seconds of each.
#   tests/build/doors.sh RELEASE WORK
# A file without its tools here is named; so is a file that the release lacks.
set -euo pipefail
release=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
work=$(realpath "$2")
export LC_ALL=C
printed="12 contacts, volume 71.4167, 0 vertices kept back
13 vertices, 22 triangles"
opened=()

# The only file of a pattern; nothing where there is none.
file_of() { find "$release" -maxdepth 1 -name "$1" | head -n 1; }
# prints_example COMMAND...
prints_example() { [ "$("$@")" = "$printed" ] || { echo "$*: other output than README tells" >&2; return 1; }; }

# open_door NAME FUNCTION FILE TOOL...: in an empty folder.
open_door() {
  local name=$1 function=$2 file=$3 tool before=$SECONDS
  shift 3
  [ -n "$file" ] || { echo "$name: not in this release"; return 0; }
  for tool in "$@"; do
    command -v "$tool" >/dev/null || { echo "$name: no $tool to open it"; return 0; }
  done
  mkdir "$work/$name"
  (cd "$work/$name" && "$function" "$file" >log.txt 2>&1) || { cat "$work/$name/log.txt"; echo "$name: FAILED"; exit 1; }
  opened+=("$name")
  printf '%-14s %9d bytes  %3d s  %s\n' "$name" "$(stat -c %s "$file")" $((SECONDS - before)) "$(basename "$file")"
}

sums() { (cd "$release" && sha256sum --check --strict SHA256SUMS); }

# The archive of source configures by itself, and knows its commit; other files have opened its build.
sources() {
  tar -xzf "$1" --strip-components=1
  cmake -S . -B build -DTOPOADAPT_TESTS=OFF
  grep -q '^set(commit_of_archive "[0-9a-f]\{40\}")$' cmake/commit.cmake
}

# Three commands in C, and a program in C++17.
amalgamation() {
  tar -xzf "$1" --strip-components=1
  c++ -std=c++20 -O2 -c topoadapt.cpp
  cc -I. minimal.c topoadapt.o -o minimal
  prints_example ./minimal
  cat >door.cpp <<'END'
#include <topoadapt.hpp>
int main() { return topoadapt::Mesh(topoadapt::make_config()).vertex_count() == 0 ? 0 : 1; }
END
  c++ -std=c++17 -I. door.cpp topoadapt.o -o door
  ./door
  cp minimal.c "$work"
}

# use_tree FOLDER: headers, libraries and tool of an unpacked package, by CMake and by hand.
use_tree() {
  local include library
  include=$(dirname "$(find "$1" -name topoadapt.h)")
  library=$(find "$1" -name libtopoadapt.a)
  cc -I"$include" "$work/minimal.c" "$library" -o minimal
  prints_example ./minimal
  "$(find "$1" -path '*/bin/topoadapt')" --version | grep '^topoadapt [0-9]'
  printf '%s\n' 'cmake_minimum_required(VERSION 3.22)' 'project(door C)' 'find_package(topoadapt REQUIRED)' \
    "add_executable(door $work/minimal.c)" 'target_link_libraries(door PRIVATE topoadapt::topoadapt_shared)' >CMakeLists.txt
  cmake -S . -B build -DCMAKE_PREFIX_PATH="$(dirname "$include")"
  cmake --build build
  prints_example build/door
}
binaries() {
  mkdir unpacked
  tar -xzf "$1" -C unpacked
  use_tree unpacked
}
debian() {
  dpkg-deb -x "$1" unpacked
  use_tree unpacked
}

# A program that depends on the crate; crates from a folder in place of the registry, with Debian's cc.
crates() {
  local crate
  mkdir -p registry program/src
  cp -r "${TOPOADAPT_CARGO_REGISTRY:-/usr/share/cargo/registry}"/cc-1* registry
  for crate in "$release"/topoadapt*.crate; do
    tar -xzf "$crate" -C registry
    printf '{"files":{},"package":"%s"}' "$(sha256sum "$crate" | cut -d' ' -f1)" \
      >"registry/$(basename "$crate" .crate)/.cargo-checksum.json"
  done
  printf '[source.crates-io]\nreplace-with = "here"\n[source.here]\ndirectory = "%s"\n' "$PWD/registry" >registry.toml
  printf '[package]\nname = "door"\nversion = "1.0.0"\nedition = "2021"\n[dependencies]\ntopoadapt = "0"\n' >program/Cargo.toml
  cp registry/topoadapt-[0-9]*/examples/minimal.rs program/src/main.rs
  env -u TOPOADAPT_LIB_DIR CARGO_TARGET_DIR="$PWD/target" cargo --config registry.toml build --quiet --offline --manifest-path program/Cargo.toml
  prints_example target/debug/door
}

# unite_balls FOLDER: with the Python package of a folder.
unite_balls() {
  env -u TOPOADAPT_LIBRARY PYTHONPATH="$1" /usr/bin/python3 -B - <<'END'
import numpy as np
import topoadapt

(a, faces), (b, _) = topoadapt.ball(), topoadapt.ball((1, 0, 0))
vertices, faces, report = topoadapt.resolve(np.concatenate([a, b]), np.concatenate([faces, faces + len(a)]))
assert topoadapt.Mesh(vertices, faces).validate().components == 1
END
}

wheel() {
  /usr/bin/python3 -m pip install --quiet --no-index --no-deps --target installed "$1"
  unite_balls installed
}

# The add-on for Blender without Blender: its package works.
addon() {
  /usr/bin/python3 -m zipfile -e "$1" .
  grep -q '^bl_info = ' topoadapt_blender/__init__.py
  unite_balls topoadapt_blender/wheel
}

web() {
  echo '{"private": true, "type": "module"}' >package.json
  npm install --offline --no-audit --no-fund --silent "$1"
  cat >door.js <<'END'
import { readFile } from "node:fs/promises";
import { load } from "topoadapt-wasm";

// Older packages take the module by hand.
const file = new URL("./node_modules/topoadapt-wasm/topoadapt.wasm", import.meta.url);
const topoadapt = load.length > 0 ? await load(await readFile(file)) : await load();
const mesh = topoadapt.mesh();
mesh.load(new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]), new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]));
if (mesh.components().length !== 1) throw new Error("no mesh");
END
  node door.js
}

bill() { python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["spdxVersion"] == "SPDX-2.3"' "$1"; }

[ -e "$release/SHA256SUMS" ] || { echo "a release without SHA256SUMS"; exit 1; }
open_door sums sums "$release/SHA256SUMS" sha256sum
open_door amalgamation amalgamation "$(file_of '*-amalgamation.tar.gz')" c++ cc
open_door source sources "$(file_of 'topoadapt-*[0-9].tar.gz')" cmake
open_door binaries binaries "$(file_of 'topoadapt-*-Linux.tar.gz')" cmake cc
open_door debian debian "$(file_of '*.deb')" dpkg-deb cmake cc
open_door crates crates "$(file_of 'topoadapt-[0-9]*.crate')" cargo c++
open_door wheel wheel "$(file_of '*.whl')" /usr/bin/python3
open_door addon addon "$(file_of 'topoadapt_blender-*.zip')" /usr/bin/python3
open_door web web "$(file_of '*.tgz')" npm node
open_door bill bill "$(file_of '*.spdx.json')" python3
[ ${#opened[@]} -ge 6 ] || { echo "only ${opened[*]} opened"; exit 1; }
echo "${#opened[@]} doors open"
