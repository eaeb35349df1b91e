#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""mutate.py [--seed S] [--count N] [--streets A,B] [--list] [--jobs J] [--calls A,B]: do the quick tests notice faults?

Picks N places of src/ by a seed: a comparison is flipped, a statement dropped, or a constant changed. Each mutant is built
in a copy of the last commit, and the quick tests of its street, then those of whole calls, run until one fails. Prints a
line for each mutant, survivors last, and the share killed. Mutants that compile to the same object are no mutants, and
others take their place. Standard library only; CMake, a compiler and git are needed."""
import argparse
import glob
import hashlib
import io
import os
import random
import re
import subprocess
import sys
import tarfile
import time

SOURCE = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
COPY = os.path.join(SOURCE, "build", "mutation")
BUILD = os.path.join(COPY, "build", "test")
STREETS = ["step", "islands", "surgery", "arrangement", "cut", "mesh", "edit"]
# Of whole calls. Bits of scenes are compared by `scenes`.
OF_CALLS = ["scenes", "api", "families", "threads"]
LEAST_TIMEOUT = 30  # seconds; else ten times what the unchanged library takes


def run(command, timeout=None, cwd=COPY):
    """Output and success."""
    try:
        done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout)
    except subprocess.TimeoutExpired:
        return "timeout", False
    return done.stdout.decode(errors="replace"), done.returncode == 0


# ---------------------------------------------------------------- places

NEGATED = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}
SHIFTED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
COMPARISON = re.compile(r" (<|<=|>|>=|==|!=) ")
CONSTANT = re.compile(r"(?<![\w.'])(\d+\.\d+|\d+)(?![\w.'])")
STATEMENT = re.compile(r"^ +(?!return\b|const\b|constexpr\b|static\b|using\b|auto\b|else\b|for\b|while\b|if\b|switch\b|case\b|do\b|"
                       r"break\b|continue\b|default\b|struct\b|enum\b|friend\b)[A-Za-z_][\w.:>\[\]+\-]*(\(| [-+|&]?= |\+\+|--).*;$")
NO_CODE = re.compile(r"^\s*(//|#|template|namespace|static_assert|using|enum|struct|friend|inline constexpr)|^[^ ]")


def changes_of_line(line):
    """(kind, changed line) for each possible mutant."""
    code = line.split("//")[0].rstrip()
    if NO_CODE.search(line) or not code:
        return
    for m in COMPARISON.finditer(code):
        if "template" in code or "operator" in code:
            break
        for table in (NEGATED, SHIFTED):
            if m[1] in table:
                yield "comparison", code[:m.start(1)] + table[m[1]] + code[m.end(1):]
    if STATEMENT.match(code) and code.count("(") == code.count(")") and code.count("{") == code.count("}"):
        if not re.match(r"^ +(const |u32|f64|u64|u8|i32|bool|Vec3|Span|Stack)", code):
            yield "statement", code[:len(code) - len(code.lstrip())] + ";"
    for m in CONSTANT.finditer(code):
        number = m[1]
        other = str(float(number) * 1.5) if "." in number else str(int(number) + 1)
        yield "constant", code[:m.start(1)] + other + code[m.end(1):]


def places(streets):
    found = {"comparison": [], "statement": [], "constant": []}
    for street in streets:
        for path in sorted(glob.glob(os.path.join(COPY, "src", street, "*.cpp"))):
            for number, line in enumerate(open(path).read().split("\n")):
                for kind, changed in changes_of_line(line):
                    found[kind].append((path, number, kind, changed))
    return found


def draw(found, chance):
    """Kinds come equally often."""
    kind = chance.choice(sorted(k for k in found if found[k]))
    return found[kind].pop(chance.randrange(len(found[kind])))


# ---------------------------------------------------------------- building and testing

def tests_of(street):
    return [street] + OF_CALLS


def target_of(test):
    return test if test == "scenes" else test + "_test"


def build(tests, jobs):
    return run(["cmake", "--build", BUILD, "-j", str(jobs), "--target", *map(target_of, tests)])


def passes(test, timeout):
    program = os.path.join(BUILD, "tests", target_of(test))
    if test != "scenes":
        return run([program, "--gtest_filter=-*Long*", "--gtest_brief=1", "--gtest_fail_fast"], timeout)[1]
    lines, ended = run([program], timeout)
    return ended and lines == open(os.path.join(COPY, "tests", "portability", "expected.txt")).read()


def object_of(path):
    return glob.glob(os.path.join(BUILD, "CMakeFiles", "topoadapt_objects.dir", os.path.relpath(path, COPY) + ".o"))


def digest(paths):
    return [hashlib.sha256(open(p, "rb").read()).hexdigest() for p in paths]


def copy_commit():
    """Files that are the same keep their times, so that little is built again; also after a run that was stopped."""
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=SOURCE, stdout=subprocess.PIPE, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as files:
        for member in files:
            if not member.isfile():
                continue
            path, data = os.path.join(COPY, member.name), files.extractfile(member).read()
            if os.path.exists(path) and open(path, "rb").read() == data:
                continue
            os.makedirs(os.path.dirname(path), exist_ok=True)
            open(path, "wb").write(data)
            os.chmod(path, member.mode)


def prepare(streets, tables, data, jobs):
    """The copy, built and passing. Seconds of each program."""
    copy_commit()
    options = [f"-DTOPOADAPT_TABLES={tables}"] if tables else []
    options += [f"-DTOPOADAPT_SHARED_DATA={data}"] if data else []
    text, done = run(["cmake", "--preset", "test", *options])
    if not done:
        sys.exit(text)
    tests = list(dict.fromkeys(t for street in streets for t in tests_of(street)))
    text, done = build(tests, jobs)
    if not done:
        sys.exit(text[-3000:])
    seconds = {}
    for test in tests:
        start = time.time()
        if not passes(test, None):
            sys.exit(f"{test} fails without a mutant")
        seconds[test] = time.time() - start
    return seconds


def judge(place, seconds, jobs):
    """Name of the program that notices, "" for a survivor, None if there is no mutant: not built, or the same object."""
    path, number, _, changed = place
    street = os.path.basename(os.path.dirname(path))
    text = open(path).read()
    lines = text.split("\n")
    lines[number] = changed
    before = digest(object_of(path))
    try:
        open(path, "w").write("\n".join(lines))
        done = run(["cmake", "--build", BUILD, "-j", str(jobs), "--target", "topoadapt_static"])[1]
        if not done or digest(object_of(path)) == before:
            return None
        for test in tests_of(street):
            if not build([test], jobs)[1]:
                return None
            if not passes(test, max(LEAST_TIMEOUT, 10 * seconds[test])):
                return test
        return ""
    finally:
        open(path, "w").write(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--streets", default=",".join(STREETS))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--tables", default=os.environ.get("TOPOADAPT_TABLES", ""))
    parser.add_argument("--data", default="", help="TOPOADAPT_SHARED_DATA of the copy")
    parser.add_argument("--calls", default=",".join(OF_CALLS), help="programs of whole calls")
    parser.add_argument("--list", action="store_true", help="names the mutants, and builds nothing")
    options = parser.parse_args()
    streets = options.streets.split(",")
    global COPY
    OF_CALLS[:] = options.calls.split(",")
    if options.list:
        COPY = SOURCE
    seconds = {} if options.list else prepare(streets, options.tables, options.data, options.jobs)
    found, chance = places(streets), random.Random(options.seed)
    killed, survivors = 0, []
    while killed + len(survivors) < options.count and any(found.values()):
        place = draw(found, chance)
        path, number, kind, changed = place
        original = open(path).read().split("\n")[number].strip()
        name = f"{os.path.relpath(path, COPY)}:{number + 1} {kind}: {original}  ->  {changed.strip()}"
        verdict = "listed" if options.list else judge(place, seconds, options.jobs)
        if verdict is None:
            continue
        killed += verdict != ""
        if verdict == "":
            survivors.append(name)
        print(f"{'survived' if verdict == '' else verdict}: {name}", flush=True)
    if options.list:
        return
    print(f"\n{killed} of {killed + len(survivors)} killed; survivors:")
    for name in survivors:
        print("  " + name)


if __name__ == "__main__":
    main()
