#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the library with counters (GCC), plays the quick tests, and prints lines and branches of src/ reached, by street.
#   tests/coverage.sh [--missing]      --missing names what no test reaches
# Tests that build something of their own are left out: their names have no dot. See docs/coverage.md.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/coverage

cmake --preset coverage >/dev/null
cmake --build "$build" -j 2 >"$build/build.log" 2>&1 || { tail -n 20 "$build/build.log"; exit 1; }
find "$build" -name '*.gcda' -delete
# Counters slow the library down, so a failure is named and does not end the run.
ctest --test-dir "$build" -j 2 -R '[.]' -E 'Long[./]' >"$build/tests.log" 2>&1 || grep -A 20 'tests FAILED' "$build/tests.log" || true
grep -E '^[0-9]+% tests passed' "$build/tests.log"
python3 -B tests/coverage.py "$build" "$@"
