#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Promise: the same bits whatever the compiler. Runs scenes and a segmentation with several builds of the tool at once and
# compares what they write, byte for byte.   tests/same_bits.sh TOOL OTHER_TOOL...
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 TOOL OTHER_TOOL..." >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# play TOOL FOLDER: a mesh of each run. Status 1 says that the answer is no, which is an answer.
play() {
  local scene
  for scene in merging-pair ramming-pair meeting-5 balls-3 dumbbell tube shell ring; do
    "$1" evolve "$scene" --seed 1 --out "$2/evolve-$scene.ply" >/dev/null || [ $? -eq 1 ]
  done
  "$1" segment --phantom genus-3 --quiet --out "$2/segment-genus-3.ply" >/dev/null || [ $? -eq 1 ]
}

running=()
for tool in "$@"; do
  mkdir "$folder/${#running[@]}"
  play "$tool" "$folder/${#running[@]}" &
  running+=($!)
done
for process in "${running[@]}"; do wait "$process"; done

different=0
for path in "$folder"/0/*.ply; do
  name=$(basename "$path" .ply)
  for ((i = 1; i < $#; ++i)); do
    if cmp "$path" "$folder/$i/$name.ply"; then
      echo "same bits: $name"
    else
      echo "DIFFERENT: $name"
      different=1
    fi
  done
done
exit $different
