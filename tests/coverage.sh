#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plays the quick tests in the build of the sanitizers, which counts what is reached (Clang), and prints lines and branches
# of src/ reached, by street.
#   tests/coverage.sh [--missing] [--least LINES BRANCHES]      as for tests/coverage.py
# See docs/coverage.md.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/sanitize

TOPOADAPT_TABLES=${TOPOADAPT_TABLES:-$(tests/portability/run.sh --tables)}
export TOPOADAPT_TABLES
rm -rf "$build/profiles"
cmake --workflow --preset sanitize
python3 -B tests/coverage.py "$build" "$@"
