#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the corpus of a target anew: from the present one and so many seconds of fuzzing in the cheap mode, as few inputs
# as reach the same, without those that take more than a second to replay.
#   fuzz/renew.sh SECONDS TARGET
# The programs are those of the presets `fuzz` and `test`.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 2 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
seconds=$1 target=$2
build=${TOPOADAPT_FUZZ_BUILD:-build/fuzz}
corpus=fuzz/corpus/$target
most_seconds=1
length=512
[ "$target" != readers ] || length=4096

fuzz/run.sh --cheap "$seconds" "$target"
merged=$(mktemp -d)
trap 'rm -rf "$merged"' EXIT
ASAN_OPTIONS=max_allocation_size_mb=512 "$build/fuzz/${target}_fuzzer" -merge=1 -max_len=$length -timeout=120 \
  -malloc_limit_mb=1000000 "$merged" "$corpus" "$build/new/$target" >"$build/$target-merge.log" 2>&1
slow=0
for input in "$merged"/*; do
  if ! timeout "$most_seconds" "build/test/fuzz/${target}_replay" "$input" >/dev/null 2>&1; then
    rm "$input"
    slow=$((slow + 1))
  fi
done
# Findings with names of their own stay.
find "$corpus" -type f -regextype posix-extended -regex '.*/[0-9a-f]{40}' -delete
cp "$merged"/* "$corpus"
echo "$target: $(ls "$corpus" | wc -l) inputs, $(du -sb "$corpus" | cut -f1) bytes; $slow took more than $most_seconds s"
