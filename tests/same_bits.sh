#!/usr/bin/env bash
# Promise: the same bits whatever the compiler. Runs scenes and a segmentation with two builds of the tool and compares
# what they write, byte for byte.   tests/same_bits.sh TOOL OTHER_TOOL
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: $0 TOOL OTHER_TOOL" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

different=0
# compare NAME ARGUMENTS...: both tools with these arguments and --out.
compare() {
  local name=$1 tool i=0
  shift
  for tool in "$first" "$second"; do
    "$tool" "$@" --out "$folder/$i.ply" >/dev/null || [ $? -eq 1 ]
    i=$((i + 1))
  done
  if cmp "$folder/0.ply" "$folder/1.ply"; then
    echo "same bits: $name"
  else
    echo "DIFFERENT: $name"
    different=1
  fi
  rm -f "$folder"/?.ply
}

first=$1
second=$2
for scene in merging-pair ramming-pair meeting-5 balls-3 dumbbell tube shell ring; do
  compare "evolve $scene" evolve "$scene" --seed 1
done
compare "segment genus-3" segment --phantom genus-3 --quiet
exit $different
