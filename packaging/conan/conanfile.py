# SPDX-License-Identifier: MIT
"""topoadapt for Conan 2, from the tree around."""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir


class Topoadapt(ConanFile):
    name = "topoadapt"
    version = "0.3.0"
    license = "MIT"
    description = "Topology changes of moving triangle meshes, in fixed memory"
    topics = ("mesh", "topology", "geometry", "self-intersection")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate(self):
        if self.settings.get_safe("compiler.cppstd"):
            check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for name, value in {"ONE_KIND": True, "TOOL": False, "TESTS": False, "INSTALL": True}.items():
            toolchain.cache_variables["TOPOADAPT_" + name] = value
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan makes these from package_info.
        for folder in ("share", os.path.join("lib", "cmake"), os.path.join("lib", "pkgconfig")):
            rmdir(self, os.path.join(self.package_folder, folder))

    def package_info(self):
        self.cpp_info.libs = ["topoadapt"]
        self.cpp_info.set_property("cmake_target_name", "topoadapt::topoadapt")
        self.cpp_info.set_property("pkg_config_name", "topoadapt")
        if self.options.shared:
            self.cpp_info.defines = ["TPA_SHARED"]
