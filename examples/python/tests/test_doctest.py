# SPDX-License-Identifier: MIT
"""The examples in the docstrings."""

import doctest
import importlib
import pkgutil
import unittest

import topoadapt


def load_tests(loader, tests, pattern):
    names = [module.name for module in pkgutil.iter_modules(topoadapt.__path__, "topoadapt.")]
    for name in ["topoadapt"] + names:
        module = importlib.import_module(name)
        tests.addTests(doctest.DocTestSuite(module, extraglobs={"ball": topoadapt.ball}, optionflags=doctest.ELLIPSIS))
    return tests


class Examples(unittest.TestCase):
    def test_there_are_examples(self):
        finder = doctest.DocTestFinder()
        self.assertTrue(any(test.examples for test in finder.find(topoadapt.Mesh)))
