# SPDX-License-Identifier: MIT
"""A recipe for Conan 2 that lies in the sources it builds: conan create cmake/packaging"""
import pathlib

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

# Options of the recipe, and what each needs; BOXSTREAM_NAME is CMake's option.
ADAPTERS = {"bullet": ["bullet3/3.25"], "c": [], "ccd": ["libccd/2.1", "eigen/3.4.0"], "fcl": ["fcl/0.7.0", "eigen/3.4.0"],
            "tbb": ["onetbb/2021.12.0"]}
LEFT_OUT = ("TESTS", "BENCH", "DEMOS", "PYTHON_PACKAGE", "HARDENED", "MPI")


class Boxstream(ConanFile):
    name = "boxstream"
    description = "All touching pairs of axis-aligned boxes, as a broad-phase for physics engines"
    license = "MIT"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], **{adapter: [True, False] for adapter in ADAPTERS}}
    default_options = {"shared": False, **{adapter: False for adapter in ADAPTERS}}

    def set_version(self):
        lines = load(self, pathlib.Path(self.recipe_folder, "../../CMakeLists.txt"))
        self.version = lines.split("project(boxstream VERSION ")[1].split()[0]

    def export_sources(self):
        sources = pathlib.Path(self.recipe_folder, "../..").resolve()
        for pattern in ("CMakeLists.txt", "LICENSE", "include/*", "src/*", "adapters/*", "cmake/*"):
            copy(self, pattern, sources, self.export_sources_folder)

    def requirements(self):
        self.requires("highway/1.0.3")
        chosen = [adapter for adapter in ADAPTERS if self.options.get_safe(adapter)]
        for needed in sorted({package for adapter in chosen for package in ADAPTERS[adapter]}):
            self.requires(needed, transitive_headers=True)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BUILD_SHARED_LIBS"] = bool(self.options.shared)
        for part in LEFT_OUT:
            toolchain.cache_variables[f"BOXSTREAM_{part}"] = "OFF"
        for adapter in ADAPTERS:
            toolchain.cache_variables[f"BOXSTREAM_{adapter.upper()}"] = "ON" if self.options.get_safe(adapter) else "OFF"
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The installed package has a CMake package of its own.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append("lib/cmake/boxstream")
