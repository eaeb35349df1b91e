#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One case: case.sh CASES NAME OUT. Writes OUT/NAME.ply, .json and .log; a case whose .json exists is done. Names come last,
# so a case that was interrupted leaves none. Exit code 0 also where the answer is no (summary.py counts these), else the
# tool's. TOPOADAPT is the tool, if not on the path.
set -euo pipefail
cases=$1
name=$2
out=$3
[ ! -e "$out/$name.json" ] || exit 0
mkdir -p "$out"
arguments=$(awk -F '\t' -v name="$name" '$1 == name {print $2}' "$cases")
[ -n "$arguments" ] || { echo "no case $name in $cases" >&2; exit 2; }
part=$out/.$name.part
code=0
# Split into words: arguments have no spaces.
# shellcheck disable=SC2086
"${TOPOADAPT:-topoadapt}" segment $arguments --quiet --out "$part.ply" --json "$part.json" >"$out/$name.log" 2>&1 || code=$?
if [ "$code" -gt 1 ] || [ ! -e "$part.json" ]; then
  rm -f "$part".*
  cat "$out/$name.log" >&2
  exit "$code"
fi
[ ! -e "$part.ply" ] || mv "$part.ply" "$out/$name.ply"
mv "$part.json" "$out/$name.json"
