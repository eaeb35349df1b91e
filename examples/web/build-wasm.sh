#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds topoadapt-wasm/topoadapt.wasm from src/: freestanding WebAssembly with 128-bit vectors, which imports nothing
# and exports the functions of topoadapt.h; and topoadapt-threads.wasm beside it, which imports a shared memory.
# Needs clang (14 or later) and wasm-ld of Debian's clang and lld.
#   examples/web/build-wasm.sh [MODULE]
# TOPOADAPT_TABLES=FILE: handle tables as tests/portability/run.sh --tables prints them. Without the variable the tables
# come from a library that is built, else from a compiler of this machine, which takes two minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
module=${1:-examples/web/topoadapt-wasm/topoadapt.wasm}
threaded=${module%.wasm}-threads.wasm
if [ -e "$module" ] && [ -e "$threaded" ] &&
  [ -z "$(find src include examples/web/build-wasm.sh examples/web/native -newer "$module" -type f)" ]; then
  exit 0
fi

CLANG=${CLANG:-clang}
WASM_LD=${WASM_LD:-wasm-ld}
for tool in "$CLANG" "$WASM_LD"; do
  command -v "$tool" >/dev/null || { echo "no $tool: install clang and lld" >&2; exit 77; }
done

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
bare=tests/portability/freestanding
common=(--target=wasm32 -msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext -O3 -ffp-contract=off -fno-math-errno
  -fvisibility=hidden -ffunction-sections -fdata-sections -DTPA_BUILD -Iinclude -Isrc
  -nostdinc -isystem "$bare" -isystem "$("$CLANG" -print-resource-dir)/include")
library=(-x c++ -std=c++20 -fno-exceptions -fno-rtti -fno-threadsafe-statics -fvisibility-inlines-hidden
  -fconstexpr-steps=16777216)

# print_tables: the path of the large handle tables as plain arrays, which compile in a second.
print_tables() {
  local archive printed=${TOPOADAPT_PORTABILITY:-build/portability}/tables
  if [ -e "$printed/done" ] && [ -n "$(find src/handles tests/portability/tables.cpp -newer "$printed/done")" ]; then
    rm "$printed/done"
  fi
  if [ -z "${TOPOADAPT_ARCHIVE:-}" ]; then
    for archive in build/*/libtopoadapt.a; do
      [ -e "$archive" ] && [ -z "$(find src/handles -newer "$archive")" ] && export TOPOADAPT_ARCHIVE=$archive
    done
  fi
  tests/portability/run.sh --tables
}

# A unit for each folder of src/, and one for the large tables.
for folder in src/*/; do
  name=$(basename "$folder")
  (cd src && printf '#include "%s"\n' $(ls "$name"/*.cpp | grep -v handle_table_)) >"$out/$name.cpp"
done
cp "${TOPOADAPT_TABLES:-$(print_tables)}" "$out/tables.cpp"

# build MODULE FLAG...: compiles and links with the flags. A missing function is an error, so none of a run-time library
# is left over.
build() {
  local module=$1 objects
  shift
  objects=$(mktemp -d -p "$out")
  ls "$out"/*.cpp | xargs -P "$(nproc)" -I {} sh -c '"$@" -c {} -o "'"$objects"'/$(basename {}).o"' - \
    "$CLANG" "${common[@]}" "${library[@]}" "$@"
  "$CLANG" "${common[@]}" "$@" -fno-builtin -c "$bare/memory.c" -o "$objects/memory.o"
  [ $# -eq 0 ] || "$CLANG" "${common[@]}" "$@" -c examples/web/native/threads.c -o "$objects/threads.o"
  local shared=()
  [ $# -eq 0 ] || shared=(--shared-memory --import-memory --max-memory=$((1 << 30)) --export=__stack_pointer)
  "$WASM_LD" --no-entry --export-dynamic --export=__heap_base --gc-sections --strip-all -z stack-size=65536 \
    "${shared[@]}" "$objects"/*.o -o "$out/module"
  mv "$out/module" "$module"
  echo "$module: $(stat -c %s "$module") bytes"
}
# The single-threaded one last: its time tells that all are there.
build "$threaded" -matomics -mmutable-globals
build "$module"
