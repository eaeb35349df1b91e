# SPDX-License-Identifier: MIT
"""The wheel of wheel.py: built, installed into an empty folder, and used there without any installed library."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LIBRARY = os.environ.get("TOPOADAPT_LIBRARY", "")
USE = """
import topoadapt, topoadapt._library as library
print(library.lib._name)
vertices, faces = topoadapt.ball()
mesh = topoadapt.Mesh(vertices, faces)
mesh.move(vertices * 1.5)
mesh.step(topoadapt.Control(threads=2))
print(mesh.validate().genus)
"""


def run(*command, folder, **variables):
    unwanted = ("PYTHONPATH", "TOPOADAPT_LIBRARY", "LD_LIBRARY_PATH")
    environment = {k: v for k, v in os.environ.items() if k not in unwanted}
    environment.update(variables)
    done = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        raise AssertionError(done.stdout.decode())
    return done.stdout.decode()


@unittest.skipUnless(os.path.isfile(LIBRARY), "TOPOADAPT_LIBRARY names no file")
@unittest.skipUnless(sys.platform.startswith("linux") and shutil.which("objdump"), "no Linux, or no objdump")
@unittest.skipUnless(all(importlib.util.find_spec(name) for name in ("pip", "setuptools", "wheel")), "no pip or wheel")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.target = folder.name, os.path.join(folder.name, "target")
        script = os.path.join(ROOT, "wheel.py")
        run(sys.executable, "-B", script, folder.name, LIBRARY, folder=folder.name)
        (name,) = [name for name in os.listdir(folder.name) if name.endswith(".whl")]
        cls.path = os.path.join(folder.name, name)
        options = ["--no-deps", "--no-index", "--disable-pip-version-check", "--quiet"]
        run(sys.executable, "-m", "pip", "install", *options, "--target", cls.target, cls.path, folder=folder.name)

    def test_it_works_alone(self):
        lines = run(sys.executable, "-c", USE, folder=self.folder, PYTHONPATH=self.target).splitlines()
        self.assertEqual(lines, [os.path.join(self.target, "topoadapt", "library", "libtopoadapt.so"), "0"])

    def test_the_readme_and_the_docstrings_run(self):
        shutil.copytree(os.path.join(ROOT, "tests"), os.path.join(self.folder, "tests"))
        shutil.copy(os.path.join(ROOT, "README.md"), self.folder)
        command = [sys.executable, "-m", "unittest", "tests/test_doctest.py"]
        self.assertIn("OK", run(*command, folder=self.folder, PYTHONPATH=self.target))

    def test_it_has_what_a_wheel_has(self):
        with zipfile.ZipFile(self.path) as wheel:
            names = wheel.namelist()
            (license_name,) = [name for name in names if name.endswith(".dist-info/LICENSE")]
            with open(os.path.join(ROOT, "..", "..", "LICENSE"), encoding="utf-8") as file:
                self.assertEqual(wheel.read(license_name).decode(), file.read())
            (about,) = [wheel.read(name).decode() for name in names if name.endswith(".dist-info/WHEEL")]
            self.assertIn("Root-Is-Purelib: false", about)
        for name in ("topoadapt/py.typed", "topoadapt/library/libtopoadapt.so", "topoadapt/mesh.py"):
            self.assertIn(name, names)
        self.assertFalse([name for name in names if "test" in name or "setup" in name])

    def test_the_platform_has_every_symbol(self):
        """By the table of symbols, where wheel.py reads the list of versions."""
        table = run(
            "objdump", "-T", os.path.join(self.target, "topoadapt", "library", "libtopoadapt.so"), folder=self.folder
        )
        undefined = [line for line in table.splitlines() if "*UND*" in line]
        versions = [tuple(map(int, v.split("."))) for v in re.findall(r"GLIBC_([\d.]+)", "\n".join(undefined))]
        self.assertTrue(versions)
        promised = re.search(r"manylinux_(\d+)_(\d+)_", os.path.basename(self.path))
        self.assertIsNotNone(promised, self.path)
        self.assertLessEqual(max(versions)[:2], (int(promised[1]), int(promised[2])))


if __name__ == "__main__":
    unittest.main()
