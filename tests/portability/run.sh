#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The same bits on every platform: builds library and scenes for each target, plays the scenes, and compares their lines
# with expected.txt. For GCC's cross compilers also the stack of every function (tests/build/stack_usage.cpp).
#   tests/portability/run.sh [TARGET...]   all targets without an argument; --list prints their names
#   tests/portability/run.sh --tables      prints the path of a file with the large handle tables as plain arrays
# A target without its tools is skipped, and fails in CI. Logs and lines: build/portability/TARGET. After a change of
# results, the lines of a target are the new expected.txt (scenes_test says so too).
set -euo pipefail
cd "$(dirname "$0")/../.."
here=tests/portability
out=${TOPOADAPT_PORTABILITY:-build/portability}
# An archive with the handle tables, for tables.cpp; without one the tables are compiled here, for two minutes.
archive=${TOPOADAPT_ARCHIVE:-build/test/libtopoadapt.a}
most_stack=16384

# ---------------------------------------------------------------- building

library_flags=(-std=c++20 -ffp-contract=off -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno
  -fno-asynchronous-unwind-tables -fvisibility=hidden -fvisibility-inlines-hidden -DTPA_BUILD -Iinclude -Isrc
  -ffunction-sections -fdata-sections)
scene_flags=(-std=c99 -ffp-contract=off -Iinclude)

needs() {
  local tool
  for tool in "$@"; do
    command -v "$tool" >/dev/null || { echo "no $tool"; exit 77; }
  done
}

# compile_library COMPILER FLAG...: objects in $folder/library, one for each folder of src/, which takes half the time of
# one for each file; without the large tables, which tables.cpp has printed.
compile_library() {
  mkdir -p "$folder/library"
  local source
  for source in "$out"/tables/units/*.cpp "$out/tables/tables.cpp"; do
    "$@" "${library_flags[@]}" -c "$source" -o "$folder/library/$(basename "$source" .cpp).o"
  done
}
# compile_scenes COMPILER FLAG...: objects in $folder.
compile_scenes() {
  local name
  for name in scenes calls meshes; do
    "$@" "${scene_flags[@]}" -DSCENES_MAIN -c "$here/$name.c" -o "$folder/$name.o"
  done
}
objects() { echo "$folder"/*.o "$folder"/library/*.o; }

# play COMMAND...: compares what the command prints, but for the lines of the scene $others.
others=
play() {
  "$@" </dev/null | tr -d '\r' >"$folder/lines.txt"
  diff <(grep -vE "^(${others:-none}):" "$here/expected.txt") <(grep -vE "^(${others:-none}):" "$folder/lines.txt")
}

# check_stack OBJDUMP: by the call graphs beside the objects (flag -fcallgraph-info=su).
check_stack() {
  "$1" -r "$folder"/library/*.o >"$folder/relocations.txt"
  "$out/tables/stack_usage" "$most_stack" "$folder/relocations.txt" "$folder"/library/*.ci
}

# native C_COMPILER C++_COMPILER FLAG...
native() {
  local c=$1 cxx=$2
  shift 2
  needs "$c" "$cxx"
  compile_library "$cxx" "$@"
  compile_scenes "$c" "$@"
  "$c" "$@" $(objects) -o "$folder/scenes" -lm
  play "$folder/scenes"
}

# cross TRIPLE EMULATOR FLAG...: GCC's cross compiler, under QEMU's emulation of a process.
cross() {
  local triple=$1 emulator=$2
  shift 2
  needs "$triple-gcc-12" "$triple-g++-12" "$triple-objdump" "$emulator"
  compile_library "$triple-g++-12" -O2 -fcallgraph-info=su "$@"
  compile_scenes "$triple-gcc-12" -O2 "$@"
  "$triple-gcc-12" -static "$@" $(objects) -o "$folder/scenes" -lm
  check_stack "$triple-objdump"
  play "$emulator" "$folder/scenes"
}

# cortex_m BOARD PSRAM FLAG...: bare metal under QEMU's emulation of a board, with newlib and semihosting.
cortex_m() {
  local board=$1 psram=$2
  shift 2
  needs arm-none-eabi-gcc arm-none-eabi-g++ qemu-system-arm
  compile_library arm-none-eabi-g++ -Os -fcallgraph-info=su -mthumb "$@"
  compile_scenes arm-none-eabi-gcc -Os -mthumb "$@"
  arm-none-eabi-gcc -Os -mthumb "$@" -c "$here/cortex_m.c" -o "$folder/cortex_m.o"
  arm-none-eabi-gcc -mthumb "$@" --specs=rdimon.specs -Wl,--defsym=psram="$psram",-T,"$here/cortex_m.ld" $(objects) -o "$folder/scenes" -lm
  check_stack arm-none-eabi-objdump
  play qemu-system-arm -M "$board" -nographic -monitor none -serial none -semihosting-config enable=on,target=native \
    -kernel "$folder/scenes"
}

# has_no_calls_but NM PATTERN FILE: are all undefined symbols of a file as the pattern says?
has_no_calls_but() {
  if "$1" -u "$3" | awk '{print $NF}' | grep -vxE "$2"; then
    echo "undefined symbols above"
    return 1
  fi
}

# ---------------------------------------------------------------- targets

gcc_o0() { native gcc g++ -O0; }
gcc_o2() { native gcc g++ -O2; }
# Stored handles of four polygons are left out: only the scene that lists stored handles tells.
gcc_triples() { others=handles; native gcc g++ -O2 -DTPA_WITHOUT_QUADRUPLES; }
gcc_o3_native() { native gcc g++ -O3 -march=native; }
gcc_lto() { native gcc g++ -O2 -flto; }
clang_o0() { native clang-14 clang++-14 -O0; }
clang_o2() { native clang-14 clang++-14 -O2; }
clang_o3_native() { native clang-14 clang++-14 -O3 -march=native; }
clang_lto() { needs ld.lld-14; native clang-14 clang++-14 -O2 -flto -fuse-ld=lld-14 -Wno-unused-command-line-argument; }
new_clang_o0() { native clang-22 clang++-22 -O0; }
new_clang_o2() { native clang-22 clang++-22 -O2; }
new_clang_o3_native() { native clang-22 clang++-22 -O3 -march=native; }
new_clang_lto() { needs ld.lld-22; native clang-22 clang++-22 -O2 -flto -fuse-ld=lld -Wno-unused-command-line-argument; }

i386() { cross i686-linux-gnu qemu-i386 -msse2 -mfpmath=sse; }
aarch64() { cross aarch64-linux-gnu qemu-aarch64; }
armv7() { cross arm-linux-gnueabihf qemu-arm; }
riscv64() { cross riscv64-linux-gnu qemu-riscv64; }
s390x() { cross s390x-linux-gnu qemu-s390x; }
cortex_m4() { cortex_m mps2-an386 0x21000000 -mcpu=cortex-m4 -mfloat-abi=soft; }
cortex_m7() { cortex_m mps2-an500 0x60000000 -mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16; }

mingw() {
  local tools=x86_64-w64-mingw32
  needs $tools-gcc $tools-g++ $tools-objdump wine
  compile_library $tools-g++ -O2 -DTPA_SHARED
  compile_scenes $tools-gcc -O2 -DTPA_SHARED
  $tools-gcc -shared "$folder"/library/*.o -o "$folder/topoadapt.dll"
  $tools-gcc "$folder"/*.o "$folder/topoadapt.dll" -o "$folder/scenes.exe"
  $tools-objdump -p "$folder/topoadapt.dll" | sed -n '/\[Ordinal\/Name Pointer\] Table/,/^$/p' | awk '/\[ *[0-9]+\]/ {print $NF}' \
    >"$folder/exports.txt"
  grep -q '^tpa_step$' "$folder/exports.txt"
  ! grep -v '^tpa_' "$folder/exports.txt"
  WINEPREFIX=$(realpath "$folder")/wine WINEDEBUG=-all play wine "$folder/scenes.exe"
}

# Without any library: only these headers, and what memory.c has.
bare=(-nostdinc -isystem "$here/freestanding")
wasm() {
  needs clang-22 clang++-22 wasm-ld-22 node
  local include
  include=$(clang-22 -print-resource-dir)/include
  compile_library clang++-22 --target=wasm32 -O2 "${bare[@]}" -isystem "$include"
  local name
  for name in scenes calls meshes; do
    clang-22 --target=wasm32 -O2 -fno-math-errno "${scene_flags[@]}" "${bare[@]}" -isystem "$include" \
      -c "$here/$name.c" -o "$folder/$name.o"
  done
  clang-22 --target=wasm32 -O2 -fno-builtin "${bare[@]}" -isystem "$include" -c "$here/freestanding/memory.c" \
    -o "$folder/memory.o"
  # No function is missing, so none of a run-time library either, as __multi3.
  wasm-ld-22 --no-entry --export=scene_count --export=scene_line $(objects) -o "$folder/scenes.wasm"
  play node "$here/scenes.mjs" "$folder/scenes.wasm"
}

musl() {
  needs musl-gcc g++
  compile_library musl-gcc -x c++ -O2
  compile_scenes musl-gcc -O2
  musl-gcc -static $(objects) -o "$folder/scenes" -lm
  play "$folder/scenes"
}

# Nothing to play: compiled without a library, the objects want four functions. (GCC's header of x86 registers includes
# stdlib.h.)
freestanding() {
  needs g++ ld nm
  compile_library g++ -O2 -ffreestanding -nostdlib
  ld -r "$folder"/library/*.o -o "$folder/all.o"
  has_no_calls_but nm 'mem(cpy|set|move|cmp)' "$folder/all.o"
}

# ---------------------------------------------------------------- all

targets=(cortex_m4 gcc_o2 cortex_m7 s390x riscv64 armv7 aarch64 mingw wasm i386 musl freestanding gcc_triples gcc_o3_native gcc_lto gcc_o0
  clang_o2 clang_o3_native clang_lto clang_o0 new_clang_o2 new_clang_o3_native new_clang_lto new_clang_o0)

make_tables() {
  local folder=$out/tables
  [ ! -e "$folder/done" ] || return 0
  mkdir -p "$folder/library"
  if [ ! -e "$archive" ]; then
    echo "compiling the handle tables" >&2
    ls src/handles/*.cpp | xargs -P 2 -I {} sh -c 'g++ "$@" -c {} -o "'"$folder"'/library/$(basename {}).o"' - "${library_flags[@]}"
    archive=$folder/tables.a
    ar rcs "$archive" "$folder"/library/*.o
  fi
  g++ -std=c++20 -Isrc "$here/tables.cpp" "$archive" -o "$folder/tables"
  "$folder/tables" >"$folder/tables.cpp"
  g++ -std=c++17 -O1 tests/build/stack_usage.cpp -o "$folder/stack_usage"
  touch "$folder/done"
}

# One for each folder of src/, anew in each run: files come and go.
make_units() {
  local folder=$out/tables/units name
  mkdir -p "$folder"
  for name in src/*/; do
    name=$(basename "$name")
    (cd src && printf '#include "%s"\n' $(ls "$name"/*.cpp | grep -v handle_table_)) >"$folder/$name.cpp"
  done
}

# run_target NAME: a line about it.
run_target() {
  folder=$out/$1
  rm -rf "$folder"
  mkdir -p "$folder"
  local status=0 before=$SECONDS
  set +e  # the first failing command ends the subshell, but not in a condition
  (set -e; "$1") >"$folder/log.txt" 2>&1
  status=$?
  set -e
  if [ $status -eq 77 ] && [ "${CI:-}" != true ]; then
    echo "skipped $1: $(tail -n 1 "$folder/log.txt")"
  elif [ $status -ne 0 ]; then
    tail -n 20 "$folder/log.txt"
    echo "FAILED $1"
    return 1
  else
    echo "agrees $1 ($((SECONDS - before)) s)"
  fi
}

if [ "${1:-}" = --list ]; then
  printf '%s\n' "${targets[@]}"
elif [ "${1:-}" = --tables ]; then
  make_tables
  realpath "$out/tables/tables.cpp"
elif [ "${1:-}" = --one ]; then
  run_target "$2"
else
  [ $# -gt 0 ] || set -- "${targets[@]}"
  for target in "$@"; do
    [[ " ${targets[*]} " == *" $target "* ]] || { echo "no target $target" >&2; exit 2; }
  done
  make_tables
  make_units
  printf '%s\n' "$@" | xargs -P 2 -I {} bash "$here/run.sh" --one {}
fi
