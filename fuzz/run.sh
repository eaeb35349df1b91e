#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes each target for so many seconds, from its corpus and with a fixed seed, two targets at a time.
#   fuzz/run.sh [--cheap] SECONDS [TARGET...]     all targets without a second argument
# --cheap: for volume; judges look at one call in eight. The programs are those of the preset `fuzz`. Fails on any
# finding, and names the files in build/fuzz/found; new inputs that reach further stay in build/fuzz/new/TARGET. See
# docs/fuzzing.md.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${TOPOADAPT_FUZZ_BUILD:-build/fuzz}

if [ "${1:-}" = --one ]; then
  seconds=$2 target=$3 corpus=fuzz/corpus/$3 log=$build/$3.log
  mkdir -p "$build/new/$target" "$build/found"
  length=1024
  [ "$target" != readers ] || length=4096
  [ -d "$corpus" ] || corpus=
  words=()
  [ ! -e "fuzz/dictionaries/$target.dict" ] || words=(-dict="fuzz/dictionaries/$target.dict")
  status=0
  # The sanitizer bounds single requests of memory in processes of the target, too, where libFuzzer would write files.
  ASAN_OPTIONS=max_allocation_size_mb=512:${ASAN_OPTIONS:-} \
    "$build/fuzz/${target}_fuzzer" -seed=1 -max_total_time="$seconds" -max_len=$length -timeout=120 \
    -report_slow_units=120 -rss_limit_mb=1500 -malloc_limit_mb=1000000 -artifact_prefix="$build/found/$target-" \
    -print_final_stats=1 "${words[@]}" \
    "$build/new/$target" $corpus >"$log" 2>&1 || status=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log")
  if [ $status -eq 0 ]; then
    echo "fuzzed $target: ${runs:-0} runs"
  else
    tail -n 40 "$log"
    echo "FOUND by $target, exit $status; log: $log"
    exit 1
  fi
else
  if [ "${1:-}" = --cheap ]; then
    export TOPOADAPT_FUZZ_CHEAP=1
    shift
  fi
  [ $# -gt 0 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 2; }
  seconds=$1
  shift
  [ $# -gt 0 ] || set -- calls scene mesh detect handles readers
  status=0
  printf '%s\n' "$@" | xargs -P 2 -I {} bash fuzz/run.sh --one "$seconds" {} || status=1
  # Whoever wrote them, and whenever.
  for file in "$build"/found/*; do
    [ -e "$file" ] || continue
    echo "found: $file"
    status=1
  done
  exit $status
fi
