#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds topoadapt-wasm/topoadapt.wasm from src/: freestanding WebAssembly with 128-bit vectors, which imports nothing
# and exports the functions of topoadapt.h. Needs clang (14 or later) and wasm-ld of Debian's clang and lld.
#   examples/web/build-wasm.sh [MODULE]
# TOPOADAPT_TABLES=FILE: handle tables as tests/portability/run.sh --tables prints them, which saves the compiler minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
module=${1:-examples/web/topoadapt-wasm/topoadapt.wasm}
if [ -e "$module" ] && [ -z "$(find src include examples/web/build-wasm.sh -newer "$module" -type f)" ]; then
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

# A unit for each folder of src/, and one for each of the large tables.
for folder in src/*/; do
  name=$(basename "$folder")
  (cd src && printf '#include "%s"\n' $(ls "$name"/*.cpp | grep -v handle_table_)) >"$out/$name.cpp"
done
if [ -n "${TOPOADAPT_TABLES:-}" ]; then
  cp "$TOPOADAPT_TABLES" "$out/tables.cpp"
else
  echo "compiling the handle tables takes some minutes" >&2
  cp src/handles/handle_table_*.cpp "$out"
fi
ls "$out"/*.cpp | xargs -P "$(nproc)" -I {} "$CLANG" "${common[@]}" "${library[@]}" -c {} -o {}.o
"$CLANG" "${common[@]}" -fno-builtin -c "$bare/memory.c" -o "$out/memory.o"
# A missing function is an error, so none of a run-time library is left over.
"$WASM_LD" --no-entry --export-dynamic --export=__heap_base --gc-sections --strip-all -z stack-size=65536 "$out"/*.o \
  -o "$out/module"
mv "$out/module" "$module"
echo "$module: $(stat -c %s "$module") bytes"
