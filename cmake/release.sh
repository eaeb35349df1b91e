#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the files of a release in the folder OUT, the same bytes on each run of a commit with the same compiler: archives of
# source and binaries, Debian package, amalgamation, WebAssembly package, bill of materials, and SHA256SUMS.
#   cmake/release.sh OUT          builds the committed state in OUT.build
#   cmake/release.sh OUT BUILD    takes a build that is there, to try the script
# What a machine has no tools for is named and left out (dpkg-deb, npm).
set -euo pipefail
[ $# -ge 1 ] || { sed -n '3,7s/^# //p' "$0"; exit 2; }
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

# archive NAME FOLDER: OUT/NAME.tar.gz with the folder as NAME.
archive() {
  tar --create --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u+rw,go=rX \
    --transform "s,^\.,$1," --directory "$2" . | gzip -n9 >"$out/$1.tar.gz"
}

if [ -z "$build" ]; then
  [ -z "$(git status --porcelain)" ] || { echo "uncommitted changes" >&2; exit 1; }
  grep -q "^## \[$version\] - [0-9-]*$" CHANGELOG.md || { echo "CHANGELOG.md has no dated section $version" >&2; exit 1; }
  build=$out.build
  cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DTOPOADAPT_TESTS=OFF -DTOPOADAPT_TABLES="${TOPOADAPT_TABLES:-}"
  cmake --build "$build" -j "$(nproc)"
fi
cmake --build "$build" --target amalgamation

git archive --format=tar --prefix="$name/" HEAD | gzip -n9 >"$out/$name.tar.gz"

one=$(mktemp -d)
trap 'rm -rf "$one"' EXIT
cp "$build"/amalgamation/topoadapt.{cpp,h} LICENSE "$one"
archive "$name-amalgamation" "$one"

kinds=TGZ
command -v dpkg-deb >/dev/null && kinds="TGZ;DEB" || echo "no dpkg-deb: no Debian package"
cpack --config "$build/CPackConfig.cmake" -G "$kinds" -B "$one/packages"
cp "$one"/packages/*.tar.gz "$out"
[ "$kinds" = TGZ ] || cp "$one"/packages/*.deb "$out"

# Made in the source tree, so not on trial.
package=examples/web/topoadapt-wasm
if [ $# -eq 1 ]; then
  if command -v npm >/dev/null && TOPOADAPT_TABLES=$build/topoadapt_tables.cpp examples/web/build-wasm.sh; then
    (cd "$package" && npm pack --silent --pack-destination "$out")
  else
    echo "no npm, or no clang and lld for WebAssembly: no package for the web"
  fi
fi

cp "$build/topoadapt.spdx.json" "$out/$name.spdx.json"
cd "$out"
sha256sum -- * >"$one/SHA256SUMS"
mv "$one/SHA256SUMS" .
cat SHA256SUMS
