# SPDX-License-Identifier: MIT
"""The Python package: setuptools, with an extension that CMake builds from the library's own sources."""
import os
import pathlib
import re
import subprocess
import sys

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]


def version():
    text = (ROOT / "include/boxstream/version.hpp").read_text(encoding="utf-8")
    return ".".join(re.search(rf"_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


class CMakeBuild(build_ext):
    """Builds the extension alone: no adapter, tool, test or benchmark."""

    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        parts = ("TESTS", "BENCH", "DEMOS", "BULLET", "C", "CCD", "FCL", "MPI", "TBB", "INSTALL")
        settings = {f"BOXSTREAM_{part}": "OFF" for part in parts}
        settings.update(
            BOXSTREAM_PYTHON_PACKAGE="ON",
            CMAKE_LIBRARY_OUTPUT_DIRECTORY=str(pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent),
            CMAKE_BUILD_TYPE="Debug" if self.debug else "Release",
            Python_EXECUTABLE=sys.executable,
            pybind11_DIR=pybind11.get_cmake_dir(),
        )
        arguments = [f"-D{name}={value}" for name, value in settings.items()]
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *arguments], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "boxstream_python", "-j", jobs], check=True)


# Beside the other builds, not among the sources.
BUILD = ROOT / "build/python"
BUILD.mkdir(parents=True, exist_ok=True)

setup(
    options={"build": {"build_base": str(BUILD)}, "egg_info": {"egg_base": str(BUILD)}},
    name="boxstream",
    version=version(),
    description="All touching pairs of axis-aligned boxes, as NumPy arrays",
    license="MIT",
    classifiers=["License :: OSI Approved :: MIT License", "Programming Language :: Python :: 3", "Typing :: Typed"],
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["boxstream"],
    package_data={"boxstream": ["__init__.pyi", "py.typed"]},
    ext_modules=[Extension("boxstream._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)
