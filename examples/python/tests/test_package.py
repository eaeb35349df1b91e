# SPDX-License-Identifier: MIT
"""The package as pip installs it, and how it finds the library."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import topoadapt

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SHOW = "import topoadapt; print(topoadapt.__version__, topoadapt.__file__, topoadapt.library_version())"


def run(*command, **variables):
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "TOPOADAPT_LIBRARY")}
    environment.update(variables)
    with tempfile.TemporaryDirectory() as elsewhere:
        return subprocess.run(command, env=environment, cwd=elsewhere, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


@unittest.skipUnless(
    importlib.util.find_spec("pip") and importlib.util.find_spec("setuptools"), "no pip, or no setuptools"
)
class Package(unittest.TestCase):
    def test_pip_installs_it(self):
        with tempfile.TemporaryDirectory() as folder:
            source, target = os.path.join(folder, "source"), os.path.join(folder, "target")
            shutil.copytree(ROOT, source, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
            options = ["--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check", "--quiet"]
            done = run(sys.executable, "-m", "pip", "install", *options, "--target", target, source)
            self.assertEqual(done.returncode, 0, done.stdout)
            library = os.environ.get("TOPOADAPT_LIBRARY")
            variables = {"TOPOADAPT_LIBRARY": library} if library else {}
            done = run(sys.executable, "-c", SHOW, PYTHONPATH=target, **variables)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn(target, done.stdout.decode())
            self.assertTrue(done.stdout.decode().startswith(topoadapt.__version__))


class Library(unittest.TestCase):
    def test_a_library_that_is_none(self):
        for name in ("/nowhere/libtopoadapt.so", __file__):
            done = run(sys.executable, "-B", "-c", SHOW, PYTHONPATH=ROOT, TOPOADAPT_LIBRARY=name)
            self.assertIn("ImportError: The shared library topoadapt is not found", done.stdout.decode())
            self.assertIn("TOPOADAPT_LIBRARY", done.stdout.decode())

    @unittest.skipUnless(sys.platform.startswith("linux"), "another way to name a shared library")
    def test_a_library_without_the_functions(self):
        done = run(sys.executable, "-B", "-c", SHOW, PYTHONPATH=ROOT, TOPOADAPT_LIBRARY="libc.so.6")
        self.assertIn("is older than this package", done.stdout.decode())

    @unittest.skipUnless(sys.platform.startswith("linux"), "another way to name a shared library")
    def test_an_installed_library_is_found_by_name(self):
        library = os.environ.get("TOPOADAPT_LIBRARY")
        if not library or not os.path.isfile(library):
            self.skipTest("TOPOADAPT_LIBRARY names no file")
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(os.path.abspath(library), os.path.join(folder, "libtopoadapt.so"))
            done = run(sys.executable, "-B", "-c", SHOW, PYTHONPATH=ROOT, LD_LIBRARY_PATH=folder)
            self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
