#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Packages both crates, offline: OUT/topoadapt-sys-VERSION.crate with the library as one source, and
# OUT/topoadapt-VERSION.crate, which is built against the first as a registry would hand it out.
#   examples/rust/package.sh OUT AMALGAMATION [--no-verify]
# AMALGAMATION: the folder of topoadapt.cpp and topoadapt.h, as the CMake target `amalgamation` makes them. The build
# needs the crate `cc` in TOPOADAPT_CARGO_REGISTRY, by default /usr/share/cargo/registry (Debian's librust-cc-dev).
# OUT/registry is left as a directory source of all crates, for `--config OUT/registry.toml`.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '3,9s/^# //p' "$0"; exit 2; }
mkdir -p "$1"
out=$(realpath "$1")
amalgamation=$(realpath "$2")
verify=("${@:3}")
cd "$(dirname "$0")"
others=${TOPOADAPT_CARGO_REGISTRY:-/usr/share/cargo/registry}
compgen -G "$others/cc-1*" >/dev/null || { echo "no crate cc in $others: install librust-cc-dev" >&2; exit 77; }

# A copy without a repository around: cargo takes files by their names alone.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r Cargo.toml Cargo.lock topoadapt topoadapt-sys "$work"
for crate in topoadapt topoadapt-sys; do cp ../../LICENSE "$work/$crate"; done
mkdir "$work/topoadapt-sys/source"
cp "$amalgamation"/topoadapt.{cpp,h} "$work/topoadapt-sys/source"

rm -rf "$out/registry"
mkdir "$out/registry"
cp -r "$others"/cc-1* "$out/registry"
cat >"$out/registry.toml" <<EOF
[source.crates-io]
replace-with = "packaged"
[source.packaged]
directory = "$out/registry"
EOF

# pack CRATE OPTION...: CRATE's package into OUT, and unpacked into the registry.
pack() {
  local crate=$1
  shift
  cargo package --quiet --offline --config "$out/registry.toml" --manifest-path "$work/$crate/Cargo.toml" --target-dir "$work/target" "$@"
  local package
  package=$(echo "$work"/target/package/"$crate"-[0-9]*.crate)
  tar -xzf "$package" -C "$out/registry"
  printf '{"files":{},"package":"%s"}' "$(sha256sum "$package" | cut -d' ' -f1)" \
    >"$out/registry/$(basename "$package" .crate)/.cargo-checksum.json"
  cp "$package" "$out"
}
unset TOPOADAPT_LIB_DIR
# The second package compiles the first.
pack topoadapt-sys --no-verify
pack topoadapt "${verify[@]}"
