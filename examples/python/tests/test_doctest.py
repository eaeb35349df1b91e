# SPDX-License-Identifier: MIT
"""The examples in the docstrings and in README.md."""

import contextlib
import doctest
import importlib
import io
import os
import pkgutil
import re
import unittest

import topoadapt


def load_tests(loader, tests, pattern):
    names = [module.name for module in pkgutil.iter_modules(topoadapt.__path__, "topoadapt.")]
    for name in ["topoadapt"] + names:
        module = importlib.import_module(name)
        tests.addTests(doctest.DocTestSuite(module, extraglobs={"ball": topoadapt.ball}, optionflags=doctest.ELLIPSIS))
    return tests


class Examples(unittest.TestCase):
    def test_readme_runs(self):
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "README.md")
        with open(path, encoding="utf-8") as file:
            code = re.search(r"```python\n(.*?)```", file.read(), re.S).group(1)
        values, output = {}, io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(code, path, "exec"), values)
        self.assertEqual(output.getvalue().splitlines()[-2], "0")
        self.assertGreater(values["found"].filled, 0.9)

    def test_there_are_examples(self):
        finder = doctest.DocTestFinder()
        self.assertTrue(any(test.examples for test in finder.find(topoadapt.Mesh)))
