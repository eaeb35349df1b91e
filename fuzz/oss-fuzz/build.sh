#!/bin/bash -eu
# SPDX-License-Identifier: MIT
# Builds the fuzzing targets for OSS-Fuzz, from the environment that OSS-Fuzz sets: CC, CXX, CFLAGS, CXXFLAGS,
# LIB_FUZZING_ENGINE, OUT, and in SRC/topoadapt the source. Without packages: no zlib, libbz2, niftilib and GDCM, so
# compressed volumes, NIfTI and DICOM are refused; GoogleTest is fetched by CMake at its fixed version. By hand:
#   CC=clang CXX=clang++ CFLAGS=-fsanitize=fuzzer-no-link,address CXXFLAGS=$CFLAGS LIB_FUZZING_ENGINE=-fsanitize=fuzzer \
#     OUT=/tmp/out SRC=$(dirname "$PWD") fuzz/oss-fuzz/build.sh
source=${SOURCE:-$SRC/topoadapt}
work=${WORK:-$source/build}/oss-fuzz

cmake -S "$source" -B "$work" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DTOPOADAPT_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_BZip2=ON -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DNIFTI2_LIBRARY= -DGDCM_MSFF_LIBRARY=
cmake --build "$work" -j "$(nproc)" --target fuzzers

for target in calls detect handles mesh readers scene; do
  cp "$work/fuzz/${target}_fuzzer" "$OUT/"
  corpus=$source/fuzz/corpus/$target
  [ ! -d "$corpus" ] || python3 -m zipfile -c "$OUT/${target}_fuzzer_seed_corpus.zip" "$corpus"/*
  dictionary=$source/fuzz/dictionaries/$target.dict
  [ ! -e "$dictionary" ] || cp "$dictionary" "$OUT/${target}_fuzzer.dict"
done
