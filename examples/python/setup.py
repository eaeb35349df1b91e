# SPDX-License-Identifier: MIT
"""pyproject.toml has the metadata. TOPOADAPT_WHEEL_PLATFORM names the platform of a wheel with the library inside, which
wheel.py makes; without the variable the wheel is pure Python, and finds an installed library."""

import os

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel

PLATFORM = os.environ.get("TOPOADAPT_WHEEL_PLATFORM")


class Package(Distribution):
    def has_ext_modules(self):
        return bool(PLATFORM)


class Wheel(bdist_wheel):
    """A wheel for a platform, and any Python there: ctypes needs no ABI of Python."""

    def get_tag(self):
        return ("py3", "none", PLATFORM) if PLATFORM else super().get_tag()


setup(distclass=Package, cmdclass={"bdist_wheel": Wheel})
