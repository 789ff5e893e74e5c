# SPDX-License-Identifier: MIT
"""The Python package: setuptools, with an extension that CMake builds from the library's own sources."""
import os
import pathlib
import subprocess
import sys

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from wheel.bdist_wheel import bdist_wheel

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import manylinux  # noqa: E402
import setup_data  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


class CMakeBuild(build_ext):
    """Builds the extension alone: no adapter, tool, test or benchmark."""

    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        parts = ("TESTS", "BENCH", "DEMOS", "BULLET", "C", "CCD", "COAL", "FCL", "MPI", "TBB", "INSTALL")
        settings = {f"BOXSTREAM_{part}": "OFF" for part in parts}
        settings.update(
            BOXSTREAM_PYTHON_PACKAGE="ON",
            BOXSTREAM_PYTHON_WHEEL="ON",
            CMAKE_LIBRARY_OUTPUT_DIRECTORY=str(pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent),
            CMAKE_BUILD_TYPE="Debug" if self.debug else "Release",
            Python_EXECUTABLE=sys.executable,
            pybind11_DIR=pybind11.get_cmake_dir(),
        )
        arguments = [f"-D{name}={value}" for name, value in settings.items()]
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *arguments], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "boxstream_python", "-j", jobs], check=True)
        if sys.platform == "linux" and not self.inplace:
            manylinux.put_in_libraries(self.get_ext_fullpath(ext.name))


class Wheel(bdist_wheel):
    """On Linux its name says on which systems it runs."""

    def get_tag(self):
        python, abi, system = super().get_tag()
        if system.startswith("linux_"):
            try:
                system = manylinux.policy_of(sorted(pathlib.Path(self.bdist_dir).rglob("*.so*")))
            except ValueError as error:
                print(f"the wheel is for systems like this one alone: {error}", file=sys.stderr)
        return python, abi, system


# Beside the other builds, not among the sources.
BUILD = ROOT / "build/python"
BUILD.mkdir(parents=True, exist_ok=True)

setup(
    options={"build": {"build_base": str(BUILD)}, "egg_info": {"egg_base": str(BUILD)}},
    name="boxstream",
    version=setup_data.version(),
    description=setup_data.SUMMARY,
    license="MIT",
    classifiers=["License :: OSI Approved :: MIT License", "Programming Language :: Python :: 3", "Typing :: Typed"],
    python_requires=setup_data.REQUIRES_PYTHON,
    install_requires=setup_data.REQUIRES,
    packages=["boxstream"],
    package_data={"boxstream": ["__init__.pyi", "py.typed"]},
    ext_modules=[Extension("boxstream._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild, "bdist_wheel": Wheel},
    zip_safe=False,
)
