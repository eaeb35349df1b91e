# SPDX-License-Identifier: MIT
"""Runs the methods of packaging/conan/conanfile.py with stand-ins for Conan's classes: version, options, the exported
files (from which CMake configures), and what the package keeps.

conan_recipe.py SOURCE VERSION FOLDER
"""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import types

source, version, folder = sys.argv[1:]


def check(holds, message):
    if not holds:
        sys.exit("conan_recipe: " + message)


# ---------------------------------------------------------------- stand-ins

def copy(_, pattern, src, dst):
    for path in pathlib.Path(src).glob(pattern):
        for file in path.rglob("*") if path.is_dir() else [path]:
            if file.is_file():
                to = pathlib.Path(dst) / file.relative_to(src)
                to.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, to)


class Toolchain:
    made = []

    def __init__(self, _):
        self.cache_variables = {}
        Toolchain.made.append(self)

    def generate(self):
        pass


class Build:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        options = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in Toolchain.made[-1].cache_variables.items()]
        subprocess.run(["cmake", "-S", self.recipe.source_folder, "-B", os.path.join(folder, "build"), *options],
                       check=True, stdout=subprocess.DEVNULL)


def module(name, **members):
    made = types.ModuleType(name)
    vars(made).update(members)
    sys.modules[name] = made


module("conan", ConanFile=object)
module("conan.tools")
module("conan.tools.build", check_min_cppstd=lambda recipe, standard: check(standard == 20, "not C++20"))
module("conan.tools.cmake", CMake=Build, CMakeToolchain=Toolchain, cmake_layout=lambda recipe: None)
module("conan.tools.files", copy=copy, rmdir=lambda recipe, path: shutil.rmtree(path, ignore_errors=True))

# ---------------------------------------------------------------- the recipe

path = os.path.join(source, "packaging/conan/conanfile.py")
spec = importlib.util.spec_from_file_location("conanfile", path)
conanfile = importlib.util.module_from_spec(spec)
spec.loader.exec_module(conanfile)
recipe = conanfile.Topoadapt()
check(recipe.version == version, "version is " + recipe.version)
recipe.recipe_folder = os.path.dirname(path)
recipe.export_sources_folder = recipe.source_folder = os.path.join(folder, "sources")
recipe.export_sources()
recipe.generate()
with open(os.path.join(source, "CMakeLists.txt"), encoding="utf-8") as file:
    options = file.read()
for name in Toolchain.made[-1].cache_variables:
    check(f"option({name} " in options, name + " is no option")
Build(recipe).configure()
listing = os.path.join(folder, "sources")
for needed in ("CMakeLists.txt", "LICENSE", "include/topoadapt.hpp", "src/api/api.cpp", "cmake/commit.cmake"):
    check(os.path.exists(os.path.join(listing, needed)), "exports no " + needed)
