#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""coverage.py BUILD [--missing] [--least LINES BRANCHES]: lines and branches of src/ that the tests of a build with
TOPOADAPT_COVERAGE have reached, a row of a Markdown table for each street. The tables of handles are left out, and the
headers of `handles`, functions that compilers run to make the tables. --missing names what no test reaches, file by file.
--least fails below these percentages of all. A line or branch counts as reached if any instance of a template or of a
header reaches it. LLVM's tools of the compiler's version are needed."""
import argparse
import glob
import json
import os
import re
import subprocess
import sys
from collections import defaultdict

SOURCE = os.path.realpath(os.path.join(os.path.dirname(__file__), ".."))
TABLES = re.compile(r"/handles/[a-z_]+\.h$|/handle_table_|/tables\.cpp$")


def street_of(path):
    """Of the absolute path of a source file; None outside of src/, and for tables."""
    if TABLES.search(path) or not path.startswith(SOURCE + "/src/"):
        return None
    return path[len(SOURCE) + 5:].split("/")[0]


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def programs(build):
    found = glob.glob(os.path.join(build, "tests", "*_test")) + [os.path.join(build, "topoadapt")]
    return [path for path in sorted(found) if os.path.isfile(path) and os.access(path, os.X_OK)]


def lines_of(segments):
    """Counts by line of a file's segments: [line, column, count, counts, begins, is a gap]."""
    counts, at, current = {}, 1, None
    starts = defaultdict(list)
    for line, _, count, counted, begins, gap in segments:
        starts[line].append((count if counted else None, begins and not gap))
    for line in range(1, max(starts, default=0) + 1):
        # A line has the count of the region that goes on through it, or the greatest of those that begin in it.
        here = [count for count, begins in starts[line] if begins and count is not None]
        if current is not None:
            here.append(current)
        if here:
            counts[line] = max(here)
        if starts[line]:
            current = starts[line][-1][0]
    return counts


def gather(build):
    profiles = glob.glob(os.path.join(build, "profiles", "*.profraw"))
    if not profiles:
        sys.exit("no counts: run the tests of the build first")
    merged = os.path.join(build, "profiles", "all.profdata")
    run("llvm-profdata", "merge", "-sparse", "-o", merged, *profiles)
    first, *others = programs(build)
    objects = [word for path in others for word in ("-object", path)]
    report = json.loads(run("llvm-cov", "export", "-skip-functions", "-skip-expansions", "-instr-profile", merged, first,
                            *objects, os.path.join(SOURCE, "src")))
    lines, branches = {}, defaultdict(int)
    for file in report["data"][0]["files"]:
        path = os.path.realpath(file["filename"])
        if street_of(path) is None:
            continue
        for line, count in lines_of(file["segments"]).items():
            lines[path, line] = count
        for line, column, _, _, of_true, of_false, *_ in file.get("branches", []):
            branches[path, line, column, True] += of_true
            branches[path, line, column, False] += of_false
    return lines, branches


def share(reached, all_of):
    return 100 * reached / all_of if all_of else 100


def table(lines, branches):
    """Prints it, and returns the percentages of all."""
    rows = defaultdict(lambda: [0, 0, 0, 0])
    for counts, first in ((lines, 0), (branches, 2)):
        for key, count in counts.items():
            for name in (street_of(key[0]), "all"):
                rows[name][first] += 1
                rows[name][first + 1] += count > 0
    print("| street | lines | reached % | branches | reached % |\n|---|--:|--:|--:|--:|")
    for name in sorted(rows, key=lambda n: (n == "all", n)):
        n, r, b, t = rows[name]
        print(f"| {name} | {n} | {share(r, n):.1f} | {b} | {share(t, b):.1f} |")
    n, r, b, t = rows["all"]
    return share(r, n), share(t, b)


def missing(lines, branches):
    unreached, half = defaultdict(set), defaultdict(set)
    for (path, line), count in lines.items():
        if count == 0:
            unreached[path].add(line)
    for (path, line, _, _), count in branches.items():
        if count == 0 and lines.get((path, line), 0) > 0:
            half[path].add(line)
    for path in sorted(set(unreached) | set(half)):
        print(f"{path[len(SOURCE) + 1:]}: lines {sorted(unreached[path])}, branches on lines {sorted(half[path])}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build")
    parser.add_argument("--missing", action="store_true")
    parser.add_argument("--least", nargs=2, type=float, metavar=("LINES", "BRANCHES"), default=(0, 0))
    options = parser.parse_args()
    counts = gather(os.path.realpath(options.build))
    of_lines, of_branches = table(*counts)
    if options.missing:
        missing(*counts)
    if of_lines < options.least[0] or of_branches < options.least[1]:
        sys.exit("less is reached than {} % of lines and {} % of branches".format(*options.least))


if __name__ == "__main__":
    main()
