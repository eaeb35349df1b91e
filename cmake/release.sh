#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the files of a release in the folder OUT, the same bytes on each run of a commit with the same compiler: archives of
# source and binaries, Debian package, amalgamation, crates, wheel, add-on for Blender, WebAssembly package, bill of
# materials, and SHA256SUMS.
#   cmake/release.sh OUT          builds the committed state in OUT.build
#   cmake/release.sh OUT BUILD    takes a build that is there, to try the script; without the WebAssembly package, which
#                                 takes minutes, but for OUT BUILD all
# Without the tools for a file the script names it and goes on; a release with CI=true fails. TOPOADAPT_TABLES: see
# CMakeLists.txt.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '3,10s/^# //p' "$0"; exit 2; }
mkdir -p "$1"
out=$(realpath "$1")
build=${2:+$(realpath "$2")}
cd "$(dirname "$0")/.."
[ -z "$(ls "$out")" ] || { echo "$out is not empty" >&2; exit 2; }

macro() { sed -n "s/^#define TPA_VERSION_$1 //p" include/topoadapt.h; }
version=$(macro MAJOR).$(macro MINOR).$(macro PATCH)
name=topoadapt-$version
# The time of the commit in all archives.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH LC_ALL=C TZ=UTC
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# leave_out WHAT WHY
missing=()
leave_out() {
  echo "$1 is left out: $2"
  missing+=("$1")
}

# archive NAME FOLDER: OUT/NAME.tar.gz with the folder as NAME.
archive() {
  tar --create --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u+rw,go=rX \
    --transform "s,^\.,$1," --directory "$2" . | gzip -n9 >"$out/$1.tar.gz"
}

prepare_build() {
  [ -z "$(git status --porcelain)" ] || { echo "uncommitted changes" >&2; exit 1; }
  grep -q "^## \[$version\] - [0-9-]*$" CHANGELOG.md || { echo "CHANGELOG.md has no dated section $version" >&2; exit 1; }
  build=$out.build
  cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DTOPOADAPT_TESTS=OFF -DTOPOADAPT_TABLES="${TOPOADAPT_TABLES:-}"
  cmake --build "$build" -j "$(nproc)"
}

pack_sources() {
  git archive --format=tar --prefix="$name/" HEAD | gzip -n9 >"$out/$name.tar.gz"
  mkdir "$scratch/one"
  cp "$build"/amalgamation/topoadapt.{cpp,h} include/topoadapt.hpp examples/minimal.c LICENSE "$scratch/one"
  archive "$name-amalgamation" "$scratch/one"
  cp "$build/topoadapt.spdx.json" "$out/$name.spdx.json"
}

pack_binaries() {
  local kinds=TGZ
  if command -v dpkg-deb >/dev/null; then kinds="TGZ;DEB"; else leave_out "the Debian package" "no dpkg-deb"; fi
  # All is built: the name of another generator keeps CPack from asking make once more for each package.
  cpack --config "$build/CPackConfig.cmake" -D CPACK_CMAKE_GENERATOR=Ninja -G "$kinds" -B "$scratch/packages"
  cp "$scratch"/packages/*.tar.gz "$out"
  [ "$kinds" = TGZ ] || cp "$scratch"/packages/*.deb "$out"
}

pack_crates() {
  if ! command -v cargo >/dev/null; then
    leave_out "the crates" "no cargo"
  elif [ -x examples/rust/package.sh ] && examples/rust/package.sh "$scratch/crates" "$build/amalgamation" --no-verify; then
    cp "$scratch"/crates/*.crate "$out"
  else
    leave_out "the crates" "cargo package does not work here"
  fi
}

# The first Python that can build wheels without a network makes the wheel, and the add-on that has it inside.
pack_wheel() {
  local python library=$build/libtopoadapt.so
  [ -e "$library" ] || library=$build/libtopoadapt.dylib
  for python in /usr/bin/python3 python3; do
    "$python" -c 'import setuptools, wheel, pip' 2>/dev/null || continue
    if [ -e examples/python/wheel.py ] && "$python" -B examples/python/wheel.py "$scratch/wheel" "$library"; then
      cp "$scratch"/wheel/*.whl "$out"
      "$python" -B examples/blender/package.py "$out/topoadapt_blender-$version.zip" "$scratch"/wheel/*.whl
      return
    fi
  done
  leave_out "the wheel, and the add-on for Blender" "no Python with pip, setuptools and wheel"
}

pack_wasm() {
  local package=$scratch/wasm modules=$build/wasm
  cp -r examples/web/topoadapt-wasm "$package"
  mkdir -p "$modules"
  if command -v npm >/dev/null &&
    TOPOADAPT_TABLES=$build/topoadapt_tables.cpp examples/web/build-wasm.sh "$modules/topoadapt.wasm"; then
    cp "$modules"/*.wasm "$package"
    (cd "$package" && npm pack --silent --pack-destination "$out")
  else
    leave_out "the package for the web" "no npm, or no clang and lld for WebAssembly"
  fi
}

[ -n "$build" ] || prepare_build
cmake --build "$build" --target amalgamation
pack_sources
pack_binaries
pack_crates
pack_wheel
[ $# -eq 2 ] || pack_wasm

cd "$out"
sha256sum -- * >"$scratch/SHA256SUMS"
mv "$scratch/SHA256SUMS" .
cat SHA256SUMS
[ $# -gt 1 ] || [ "${CI:-}" != true ] || [ ${#missing[@]} -eq 0 ] || { echo "left out: ${missing[*]}" >&2; exit 1; }
