# SPDX-License-Identifier: MIT
# Writes the whole library as one source and its header, OUT/topoadapt.cpp and OUT/topoadapt.h.
# amalgamate.py SOURCE OUT [TABLES [COMMIT]]: COMMIT is for tpa_build_info. TABLES holds the large handle tables as tests/portability/tables.cpp prints them, in
# place of their source, which takes compilers minutes.
import os
import re
import sys

HEAD = """/* SPDX-License-Identifier: MIT */
/* topoadapt {version} in one source, made by cmake/amalgamate.py. Compile and link with
 *     c++ -std=c++20 -O2 -c topoadapt.cpp
 *     cc -I. program.c topoadapt.o
 * On x86 and AArch64 the object needs nothing but memcpy, memmove, memset and memcmp; on other processors GCC also
 * wants -fno-math-errno, or -lm. For a shared library add -DTPA_SHARED; otherwise a shared object that contains the library
 * exports none of its names.{steps}
 *
{licence} */
#if !defined(__cplusplus) || __cplusplus < 202002L
#error "topoadapt.cpp is C++20: compile with -std=c++20"
#else
#ifndef TPA_BUILD
#define TPA_BUILD
#endif
{commit}{system}
/* As the flags -ffp-contract=off and -fno-exceptions, which GCC and Clang heed unless a flag says otherwise. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#pragma clang attribute push(__attribute__((nothrow)), apply_to = hasType(functionType))
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#pragma GCC optimize("no-exceptions")
#pragma GCC diagnostic push
/* Arrays that are filled up to a count look uninitialized to GCC 12, or overflowed. */
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wstringop-overflow"
#endif
#include "topoadapt.h"
/* As the flags -fvisibility=hidden and -fvisibility-inlines-hidden, but for functions of topoadapt.h. */
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(hidden)
#endif
"""
TAIL = """
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif
#if defined(__clang__)
#pragma clang attribute pop
#elif defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif
"""
STEPS = """
 * Compilers need minutes for the handle tables, and Clang needs -fconstexpr-steps=16777216."""
# Headers of the C library, ahead of pragmas that are for this library's functions only.
SYSTEM = "\n".join(f"#include <{name}.h>" for name in ("float", "stddef", "stdint", "string"))


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


class Amalgam:
    def __init__(self, source):
        self.folder = os.path.join(source, "src")
        self.done = {"topoadapt.h"}
        self.parts = []

    # A file after the files that it includes, each once.
    def add(self, path):
        if path in self.done:
            return
        self.done.add(path)
        self.add_text(path, read(self.folder, path))

    def add_text(self, name, text):
        for path in re.findall(r'^#include "(.+)"$', text, re.M):
            self.add(path)
        text = re.sub(r'^(#include ".+"|#pragma once|// SPDX-.+)\n', "", text, flags=re.M)
        self.parts.append(f"/* ---------------------------------------------------------------- {name} */\n\n{text}\n")


def sources(folder):
    for street in sorted(os.listdir(folder)):
        for name in sorted(os.listdir(os.path.join(folder, street))):
            if name.endswith(".cpp"):
                yield f"{street}/{name}"


def main():
    source, out = sys.argv[1:3]
    tables = sys.argv[3] if len(sys.argv) > 3 else None
    commit = f"#ifndef TPA_COMMIT\n#define TPA_COMMIT {sys.argv[4]}\n#endif\n" if len(sys.argv) > 4 else ""
    amalgam = Amalgam(source)
    for path in sources(amalgam.folder):
        if not tables or not path.startswith("handles/handle_table_"):
            amalgam.add(path)
    if tables:
        amalgam.add_text("large handle tables", read(tables))

    header = read(source, "include", "topoadapt.h")
    version = ".".join(re.search(f"TPA_VERSION_{part} (\\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))
    licence = "".join(f" * {line}".rstrip() + "\n" for line in read(source, "LICENSE").splitlines())
    head = HEAD.format(version=version, licence=licence, steps="" if tables else STEPS, system=SYSTEM, commit=commit)
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "topoadapt.h"), "w", encoding="utf-8") as file:
        file.write(header)
    with open(os.path.join(out, "topoadapt.cpp"), "w", encoding="utf-8") as file:
        file.write(head + "\n" + "".join(amalgam.parts) + TAIL)


main()
