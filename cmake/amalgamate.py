# SPDX-License-Identifier: MIT
# Writes the whole library as one source and its header, OUT/topoadapt.cpp and OUT/topoadapt.h.
# amalgamate.py SOURCE OUT [TABLES]: TABLES holds the large handle tables as tests/portability/tables.cpp prints them, in
# place of their source, which takes compilers minutes.
import os
import re
import sys

HEAD = """/* SPDX-License-Identifier: MIT */
/* topoadapt {version} in one source, made by cmake/amalgamate.py. Compile with
 *     c++ -std=c++20 -O2 -ffp-contract=off -c topoadapt.cpp
 * For a linker of C also -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno: the object then needs nothing
 * but memcpy, memmove, memset and memcmp. For a shared library also -fvisibility=hidden.{steps}
 *
{licence} */
#ifndef TPA_BUILD
#define TPA_BUILD
#endif
/* As the flag -ffp-contract=off, where it is forgotten. Clang heeds this unless a flag says otherwise. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
/* Arrays that are filled up to a count look uninitialized to GCC 12. */
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "topoadapt.h"
"""
STEPS = """
 * Compilers need minutes for the handle tables, and Clang needs -fconstexpr-steps=16777216."""


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
    amalgam = Amalgam(source)
    for path in sources(amalgam.folder):
        if not tables or not path.startswith("handles/handle_table_"):
            amalgam.add(path)
    if tables:
        amalgam.add_text("large handle tables", read(tables))

    header = read(source, "include", "topoadapt.h")
    version = ".".join(re.search(f"TPA_VERSION_{part} (\\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))
    licence = "".join(f" * {line}".rstrip() + "\n" for line in read(source, "LICENSE").splitlines())
    head = HEAD.format(version=version, licence=licence, steps="" if tables else STEPS)
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "topoadapt.h"), "w", encoding="utf-8") as file:
        file.write(header)
    with open(os.path.join(out, "topoadapt.cpp"), "w", encoding="utf-8") as file:
        file.write(head + "\n" + "".join(amalgam.parts))


main()
