# SPDX-License-Identifier: MIT
"""The hints, as mypy sees them: of the package, and in programs of users."""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Lines with a mistake say so.
PROGRAM = """
import numpy as np
import numpy.typing as npt
import topoadapt

vertices, faces = topoadapt.ball()
mesh = topoadapt.Mesh(vertices, faces, max_vertices=1000)
mesh.move(mesh.vertices * 0.5)
report = mesh.step(topoadapt.Control(budget=10, threads=2))
count: int = report.contacts
count = report.approach  # mistake
merged = [event.before for event in mesh.events() if event.type == topoadapt.EventType.MERGE]
first: int = merged[0]  # mistake
array: npt.NDArray[np.float64] = mesh.vertices
array = mesh.faces  # mistake
mesh.step(3)  # mistake
mesh.remesh(0.1, sweeps=3)  # mistake
mesh.vertices = vertices  # mistake
with mesh.view() as view:
    array = view.vertices
twin: topoadapt.Mesh = mesh.copy()
surface = topoadapt.resolve(vertices, faces)
number: str = surface.report.vertices  # mistake
topoadapt.segment(np.zeros((4, 4, 4)), (1, 1, 1), "high")  # mistake
"""


def mypy():
    """The command: of this interpreter, or a program of the system."""
    for python in (sys.executable, "/usr/bin/python3"):
        done = subprocess.run([python, "-m", "mypy", "--version"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if done.returncode == 0:
            return [python, "-m", "mypy", "--no-error-summary", "--python-version", "3.9"]
    return None


MYPY = mypy()


@unittest.skipUnless(MYPY, "no mypy")
class Types(unittest.TestCase):
    def run_mypy(self, *arguments):
        with tempfile.TemporaryDirectory() as cache:
            environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
            environment["MYPYPATH"] = ROOT
            command = [*MYPY, "--cache-dir", cache, *arguments]
            done = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            return done.returncode, done.stdout.decode()

    def test_the_package_and_a_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "program.py")
            with open(path, "w", encoding="utf-8") as file:
                file.write(PROGRAM)
            _, output = self.run_mypy("--config-file", "pyproject.toml", path, "topoadapt")
        found = [int(line) for line in re.findall(r"program\.py:(\d+): error", output)]
        wanted = [n for n, line in enumerate(PROGRAM.split("\n"), 1) if "# mistake" in line]
        self.assertEqual(sorted(set(found)), wanted, output)
        self.assertNotRegex(output, r"(?m)^topoadapt/.*: error")


class Marker(unittest.TestCase):
    def test_the_package_says_that_it_has_hints(self):
        package = os.path.dirname(importlib.util.find_spec("topoadapt").origin)
        self.assertTrue(os.path.exists(os.path.join(package, "py.typed")))


if __name__ == "__main__":
    unittest.main()
