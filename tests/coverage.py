#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""coverage.py BUILD [--missing]: lines and branches of src/ that runs of a build with TOPOADAPT_COVERAGE have reached, a row
of a Markdown table for each street; the tables of handles are left out. --missing names what no test reaches, file by
file. A line or branch counts as reached if any instance of a template or of a header reaches it."""
import concurrent.futures
import json
import os
import re
import subprocess
import sys
from collections import defaultdict

SOURCE = os.path.realpath(os.path.join(os.path.dirname(__file__), ".."))
TABLES = re.compile(r"/handle_table_|/tables\.cpp$")


def street_of(path):
    """Of the absolute path of a source file; None outside of src/, and for tables."""
    if TABLES.search(path) or not path.startswith(SOURCE + "/src/"):
        return None
    return path[len(SOURCE) + 5:].split("/")[0]


def read(note):
    """What gcov tells of one object, as JSON."""
    run = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", note], capture_output=True,
                         cwd=os.path.dirname(note), check=True)
    return [json.loads(line) for line in run.stdout.splitlines() if line.strip()]


def gather(build):
    notes = [os.path.join(folder, name) for folder, _, names in os.walk(os.path.join(build, "CMakeFiles"))
             for name in names if name.endswith(".gcno") and not TABLES.search(os.path.join(folder, name))]
    lines, branches = defaultdict(int), defaultdict(int)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for reports in pool.map(read, sorted(notes)):
            for report in reports:
                add(report, lines, branches)
    return lines, branches


def add(report, lines, branches):
    for file in report["files"]:
        path = os.path.realpath(os.path.join(report["current_working_directory"], file["file"]))
        if street_of(path) is None:
            continue
        numbers = defaultdict(int)  # of branches on a line, for each instance
        for line in file["lines"]:
            at = path, line["line_number"]
            lines[at] += line["count"]
            for branch in line["branches"]:
                if branch.get("throw"):
                    continue
                instance = line["line_number"], line.get("function_name", "")
                branches[(*at, numbers[instance])] += branch["count"]
                numbers[instance] += 1


def share(reached, all_of):
    return f"{100 * reached / all_of:.1f}" if all_of else "-"


def table(lines, branches):
    rows = defaultdict(lambda: [0, 0, 0, 0])
    for counts, first in ((lines, 0), (branches, 2)):
        for key, count in counts.items():
            for name in (street_of(key[0]), "all"):
                rows[name][first] += 1
                rows[name][first + 1] += count > 0
    print("| street | lines | reached % | branches | reached % |\n|---|--:|--:|--:|--:|")
    for name in sorted(rows, key=lambda n: (n == "all", n)):
        n, r, b, t = rows[name]
        print(f"| {name} | {n} | {share(r, n)} | {b} | {share(t, b)} |")


def missing(lines, branches):
    unreached = defaultdict(set)
    for (path, line), count in lines.items():
        if count == 0:
            unreached[path].add(line)
    half = defaultdict(set)
    for (path, line, _), count in branches.items():
        if count == 0 and lines[path, line] > 0:
            half[path].add(line)
    for path in sorted(set(unreached) | set(half)):
        print(f"{path[len(SOURCE) + 1:]}: lines {sorted(unreached[path])}, branches on lines {sorted(half[path])}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    counts = gather(os.path.realpath(sys.argv[1]))
    if not counts[0]:
        sys.exit("no counts: run the tests of the build first")
    table(*counts)
    if "--missing" in sys.argv:
        missing(*counts)


if __name__ == "__main__":
    main()
