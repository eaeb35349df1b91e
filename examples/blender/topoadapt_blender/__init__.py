# SPDX-License-Identifier: MIT
"""Add-on for Blender: resolve self-intersections, and inflate with changes of topology, by topoadapt."""

import importlib
import os
import sys

bl_info = {
    "name": "topoadapt",
    "author": "The topoadapt authors",
    "version": (0, 3, 0),
    "blender": (3, 4, 0),
    "location": "Object > topoadapt",
    "description": "Resolve self-intersections; inflate a mesh that merges, splits and opens handles",
    "category": "Mesh",
}

# The package of the wheel lies beside this file, unless Blender's Python has one.
try:
    importlib.import_module("topoadapt")
except ImportError:
    sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "wheel"))

from . import operators  # noqa: E402


def register():
    operators.register()


def unregister():
    operators.unregister()
