#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""mutate.py [--seed S] [--count N] [--streets A,B] [--list] [--jobs J] [--calls A,B] [--longest S]: do the quick tests
notice faults?

Picks N places of src/ by a seed: a comparison is flipped, a statement dropped, or a constant changed. One library has all
mutants, and the environment variable TOPOADAPT_MUTANT chooses one ("mutant schemata", Untch, Offutt and Harrold 1993), so
that a mutant costs no build. A place where the compiler wants a constant is built by itself. The quick tests of the
mutant's street, and those of whole calls, run until one fails: first those that have killed another mutant, then by
their time. Prints a line for each mutant, survivors last, and the
share killed. Survivors that compile to the object of the unchanged source are no mutants. Standard library only; CMake, a
compiler and git are needed."""
import argparse
import collections
import concurrent.futures
import glob
import hashlib
import io
import os
import random
import re
import subprocess
import sys
import tarfile
import tempfile
import time

SOURCE = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
COPY = os.path.join(SOURCE, "build", "mutation")
BUILD = os.path.join(COPY, "build", "test")
STREETS = ["step", "islands", "surgery", "arrangement", "cut", "mesh", "edit"]
# Of whole calls and steps. Bits of scenes are compared by `scenes`.
OF_CALLS = ["scenes", "api", "step", "families", "threads"]
LEAST_TIMEOUT = 30  # seconds; else ten times what the unchanged library takes

Place = collections.namedtuple("Place", "path line kind begin end text original")


def run(command, timeout=None, **environment):
    """Output and success."""
    try:
        done = subprocess.run(command, cwd=COPY, env=dict(os.environ, **environment), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout)
    except subprocess.TimeoutExpired as late:
        return (late.stdout or b"").decode(errors="replace"), False
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
    """(kind, begin, end, text in place of these columns) for each possible mutant."""
    code = line.split("//")[0].rstrip()
    if NO_CODE.search(line) or not code:
        return
    for m in COMPARISON.finditer(code):
        if "template" in code or "operator" in code:
            break
        for table in (NEGATED, SHIFTED):
            if m[1] in table:
                yield "comparison", m.start(1), m.end(1), table[m[1]]
    if STATEMENT.match(code) and code.count("(") == code.count(")") and code.count("{") == code.count("}"):
        if not re.match(r"^ +(const |u32|f64|u64|u8|i32|bool|Vec3|Span|Stack)", code):
            yield "statement", len(code) - len(code.lstrip()), len(code), ";"
    for m in CONSTANT.finditer(code):
        yield "constant", m.start(1), m.end(1), str(float(m[1]) * 1.5) if "." in m[1] else str(int(m[1]) + 1)


def places(streets):
    found = {"comparison": [], "statement": [], "constant": []}
    for street in streets:
        for path in sorted(glob.glob(os.path.join(COPY, "src", street, "*.cpp"))):
            for number, line in enumerate(open(path).read().split("\n")):
                for kind, begin, end, text in changes_of_line(line):
                    found[kind].append(Place(path, number, kind, begin, end, text, line))
    return found


def draw(found, count, chance):
    """Kinds come equally often. No two of the same columns."""
    drawn = []
    while len(drawn) < count and any(found.values()):
        kind = chance.choice(sorted(k for k in found if found[k]))
        place = found[kind].pop(chance.randrange(len(found[kind])))
        if not any((p.path, p.line, p.begin) == (place.path, place.line, place.begin) for p in drawn):
            drawn.append(place)
    return drawn


def street_of(place):
    return os.path.basename(os.path.dirname(place.path))


def name_of(place):
    changed = place.original[:place.begin] + place.text + place.original[place.end:]
    return f"{os.path.relpath(place.path, COPY)}:{place.line + 1} {place.kind}: {place.original.strip()}  ->  {changed.strip()}"


# ---------------------------------------------------------------- sources

# A comparison `a < b` becomes `a < tpa_mutants::Compare<7, 3>{} < b`, of the same precedence. A mutant is felt where its
# value differs.
HEADER = """#pragma once
extern "C" int tpa_mutant;
extern "C" char tpa_felt[65536];
namespace tpa_mutants {
enum { OF_LESS, OF_LESS_EQUAL, OF_GREATER, OF_GREATER_EQUAL, OF_EQUAL, OF_NOT_EQUAL };
template <int other, class A, class B> bool compare(const A& a, const B& b) {
  if constexpr (other == OF_LESS) return a < b;
  else if constexpr (other == OF_LESS_EQUAL) return a <= b;
  else if constexpr (other == OF_GREATER) return a > b;
  else if constexpr (other == OF_GREATER_EQUAL) return a >= b;
  else if constexpr (other == OF_EQUAL) return a == b;
  else return a != b;
}
inline bool is_on(int number) { tpa_felt[number] = 1; return tpa_mutant == number; }
template <int number, int other> struct Compare {};
template <class A, int number, int other> struct Left { const A& a; };
#define TPA_MUTANTS(op) \\
  template <class A, int number, int other> Left<A, number, other> operator op(const A& a, Compare<number, other>) { return {a}; } \\
  template <class A, class B, int number, int other> bool operator op(Left<A, number, other> left, const B& b) { \\
    const bool value = left.a op b; \\
    return compare<other>(left.a, b) != value && is_on(number) ? !value : value; \\
  }
TPA_MUTANTS(<) TPA_MUTANTS(<=) TPA_MUTANTS(>) TPA_MUTANTS(>=) TPA_MUTANTS(==) TPA_MUTANTS(!=)
#undef TPA_MUTANTS
template <int number, class A> A constant(A value, A other) { return is_on(number) ? other : value; }
}
"""
# The environment chooses a mutant, or a file for the numbers of those that are felt.
CHOICE = """#include <stdio.h>
#include <stdlib.h>
extern "C" { int tpa_mutant = 0; char tpa_felt[65536]; }
__attribute__((constructor)) static void choose() { if (const char* text = getenv("TOPOADAPT_MUTANT")) tpa_mutant = atoi(text); }
__attribute__((destructor)) static void tell() {
  const char* path = getenv("TOPOADAPT_FELT");
  FILE* file = path ? fopen(path, "a") : nullptr;
  if (!file) return;
  for (int i = 0; i < 65536; ++i) if (tpa_felt[i]) fprintf(file, "%d\\n", i);
  fclose(file);
}
"""
OPERATORS = {"<": 0, "<=": 1, ">": 2, ">=": 3, "==": 4, "!=": 5}


def chosen_at_run_time(place, number):
    """Text in place of the columns, with the mutant and the original."""
    original = place.original[place.begin:place.end]
    if place.kind == "comparison":
        return f"{original} tpa_mutants::Compare<{number}, {OPERATORS[place.text]}>{{}} {original}"
    if place.kind == "constant":
        return f"tpa_mutants::constant<{number}>({original}, {place.text})"
    return None


def with_all(numbered):
    """Lines of a file with the given mutants of it, as {line: text}."""
    lines = {}
    for number, place in sorted(numbered, key=lambda n: (n[1].line, -n[1].begin)):
        text = lines.get(place.line, place.original)
        if place.kind == "statement":
            code = text.split("//")[0].rstrip()
            lines[place.line] = f"{{ if (!tpa_mutants::is_on({number})) {code.strip()} }}"
        else:
            lines[place.line] = text[:place.begin] + chosen_at_run_time(place, number) + text[place.end:]
    return lines


def write_if_new(path, text):
    if not os.path.exists(path) or open(path).read() != text:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        open(path, "w").write(text)


def write_sources(originals, mutants):
    """All sources, with these mutants {number: place}."""
    for path, text in originals.items():
        lines = text.split("\n")
        changes = with_all([(n, p) for n, p in mutants.items() if p.path == path])
        for line, changed in changes.items():
            lines[line] = changed
        write_if_new(path, ('#include "base/mutants.h"\n#line 1\n' if changes else "") + "\n".join(lines))


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
    write_if_new(os.path.join(COPY, "src", "base", "mutants.h"), HEADER)
    write_if_new(os.path.join(COPY, "src", "base", "mutants.cpp"), CHOICE)


# ---------------------------------------------------------------- building and testing

def tests_of(street):
    return [street] + OF_CALLS


def target_of(test):
    return test if test == "scenes" else test + "_test"


def build(targets, jobs, *options):
    return run(["cmake", "--build", BUILD, "-j", str(jobs), "--target", *targets, "--", *options])


class Test:
    """A test by itself: seconds without a mutant, and the mutants that it feels then."""

    def __init__(self, program, name):
        self.program, self.name = program, name
        self.seconds, self.felt = 0, set()

    def passes(self, timeout=None, **environment):
        program = os.path.join(BUILD, "tests", target_of(self.program))
        if self.name:
            return run([program, "--gtest_filter=" + self.name, "--gtest_brief=1"], timeout, **environment)[1]
        lines, ended = run([program], timeout, **environment)
        return ended and lines == open(os.path.join(COPY, "tests", "portability", "expected.txt")).read()

    def measure(self):
        with tempfile.NamedTemporaryFile("r") as felt:
            start = time.time()
            if not self.passes(TOPOADAPT_FELT=felt.name):
                sys.exit(f"{self.program} {self.name} fails without a mutant")
            self.seconds, self.felt = time.time() - start, set(map(int, felt.read().split()))

    def notices(self, number):
        return not self.passes(max(LEAST_TIMEOUT, 10 * self.seconds), TOPOADAPT_MUTANT=str(number))


def tests_in(program):
    if program == "scenes":
        return [Test(program, "")]
    found, suite = [], ""
    for line in run([os.path.join(BUILD, "tests", target_of(program)), "--gtest_list_tests"])[0].split("\n"):
        word = line.split("#")[0].strip()
        suite = suite if line.startswith("  ") else word
        if line.startswith("  ") and "Long" not in suite + word and "DISABLED" not in suite + word:
            found.append(Test(program, suite + word))
    return found


def kill(tests, street, killers, number):
    """The test that notices the mutant; None for a survivor. Those that have killed others are asked first."""
    asked = [t for t in tests if t.program in tests_of(street) and (number in t.felt or number == 0)]
    for test in sorted(asked, key=lambda t: (t not in killers, t.seconds)):
        if test.notices(number):
            killers.add(test)
            return test
    return None


def object_of(path):
    [name] = glob.glob(os.path.join(BUILD, "CMakeFiles", "topoadapt_objects.dir", os.path.relpath(path, COPY) + ".o"))
    return hashlib.sha256(open(name, "rb").read()).hexdigest()


def configure(tables, data):
    options = [f"-DTOPOADAPT_TABLES={tables}"] if tables else []
    options += [f"-DTOPOADAPT_SHARED_DATA={data}"] if data else []
    text, done = run(["cmake", "--preset", "test", "-DTOPOADAPT_WERROR=OFF", "-DCMAKE_CXX_FLAGS=-w", *options])
    if not done:
        sys.exit(text)


def build_library(originals, mutants, jobs):
    """Builds the library with all mutants but those that are no code to be chosen at run time, which it gives back."""
    apart = {}
    while True:
        write_sources(originals, {n: p for n, p in mutants.items() if n not in apart})
        text, done = build(["topoadapt_static"], jobs, "-k")
        if done:
            return apart
        wrong = {(m[1], int(m[2]) - 1) for m in re.finditer(r"(\S+?\.cpp):(\d+):\d+: ", text)}
        more = {n: p for n, p in mutants.items() if n not in apart and (p.path, p.line) in wrong}
        if not more:
            sys.exit(text[-3000:])
        apart.update(more)


def build_alone(place, original, jobs, before):
    """Builds a mutant by itself; false if there is no mutant: not built, or the same object."""
    lines = original.split("\n")
    lines[place.line] = place.original[:place.begin] + place.text + place.original[place.end:]
    write_if_new(place.path, "\n".join(lines))
    return build(["topoadapt_static"], jobs)[1] and object_of(place.path) != before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--streets", default=",".join(STREETS))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--tables", default=os.environ.get("TOPOADAPT_TABLES", ""))
    parser.add_argument("--data", default="", help="TOPOADAPT_SHARED_DATA of the copy")
    parser.add_argument("--calls", default=",".join(OF_CALLS), help="programs of whole calls")
    parser.add_argument("--longest", type=float, default=float("inf"), help="leaves out tests of more seconds")
    parser.add_argument("--list", action="store_true", help="names the mutants, and builds nothing")
    options = parser.parse_args()
    streets = options.streets.split(",")
    global COPY
    OF_CALLS[:] = options.calls.split(",")
    if options.list:
        COPY = SOURCE
    else:
        copy_commit()
    mutants = dict(enumerate(draw(places(streets), options.count, random.Random(options.seed)), 1))
    if options.list:
        print("\n".join(map(name_of, mutants.values())))
        return

    originals = {p.path: open(p.path).read() for p in mutants.values()}
    programs = list(dict.fromkeys(t for street in streets for t in tests_of(street)))
    configure(options.tables, options.data)
    apart = build_library(originals, mutants, options.jobs)
    text, done = build(list(map(target_of, programs)), options.jobs)
    if not done:
        sys.exit(text[-3000:])
    verdicts, killers = {}, set()

    def print_verdict(number, test):
        verdicts[number] = test is not None
        print(f"{f'{test.program} {test.name}' if test else 'survived'}: {name_of(mutants[number])}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        tests = [test for program in programs for test in tests_in(program)]
        list(pool.map(Test.measure, tests))
        tests = [test for test in tests if test.seconds <= options.longest]
        print(f"{len(tests)} tests of {sum(t.seconds for t in tests):.0f} s", flush=True)
        chosen = {pool.submit(kill, tests, street_of(p), killers, n): n for n, p in mutants.items() if n not in apart}
        for future in concurrent.futures.as_completed(chosen):
            print_verdict(chosen[future], future.result())

    # By themselves: places that are no choice at run time, and whether survivors are mutants at all.
    write_sources(originals, {})
    build(["topoadapt_static"], options.jobs)
    objects = {path: object_of(path) for path in originals}
    for n, place in mutants.items():
        if n not in apart and verdicts[n]:
            continue
        if not build_alone(place, originals[place.path], options.jobs, objects[place.path]):
            print(f"no mutant: {name_of(place)}", flush=True)
            verdicts[n] = None
        elif n in apart and build(list(map(target_of, tests_of(street_of(place)))), options.jobs)[1]:
            print_verdict(n, kill(tests, street_of(place), killers, 0))
        write_sources(originals, {})

    survivors = [name_of(mutants[n]) for n, verdict in verdicts.items() if verdict is False]
    killed = sum(bool(verdict) for verdict in verdicts.values())
    print(f"\n{killed} of {killed + len(survivors)} killed; survivors:")
    for name in survivors:
        print("  " + name)


if __name__ == "__main__":
    main()
