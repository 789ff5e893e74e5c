# SPDX-License-Identifier: MIT
"""The wheel that pip makes: for which systems it says that it is, and what is in it; and the archive of sources."""
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

from boxstream import _core

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "adapters/python"))

import manylinux  # noqa: E402
import setup_data  # noqa: E402

sys.path.pop()  # it has the package without its extension

pytestmark = pytest.mark.skipif(sys.platform != "linux" or shutil.which("objdump") is None, reason="needs objdump")


def test_versions_of_symbols_are_read():
    libraries, newest = manylinux.needs(_core.__file__)
    assert "libc.so.6" in libraries
    assert (2, 14) <= newest["GLIBC"] < (3, 0) and newest["GLIBCXX"] >= (3, 4, 21)


def test_policies(monkeypatch):
    needs = {}
    monkeypatch.setattr(manylinux, "needs", lambda file: (set(needs[file][0]), dict(needs[file][1])))
    needs["a"] = ["libc.so.6", "b"], {"GLIBC": (2, 14), "GLIBCXX": (3, 4, 21)}
    needs["b"] = ["libstdc++.so.6"], {"GLIBC": (2, 32)}
    assert manylinux.policy_of(["a", "b"]).startswith("manylinux_2_32_")
    with pytest.raises(ValueError, match="a needs b"):
        manylinux.policy_of(["a"])
    needs["a"] = [], {"CXXABI": (1, 3, 13)}
    assert manylinux.policy_of(["a"]).startswith("manylinux_2_34_")
    needs["a"] = [], {"GLIBCXX": (3, 9)}
    with pytest.raises(ValueError, match="no policy"):
        manylinux.policy_of(["a"])


def pip(*arguments):
    # What is compiled is that of other builds, where it is kept.
    environment = dict(os.environ, PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_INDEX="1")
    if shutil.which("ccache"):
        environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    environment.pop("PYTHONPATH", None)
    run = subprocess.run([sys.executable, "-m", "pip", *arguments], env=environment, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout[-4000:]


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The archive of sources, by the hook that pip and others call."""
    folder = tmp_path_factory.mktemp("sources")
    code = "import sys; sys.path.insert(0, sys.argv[1]); import hooks; print(hooks.build_sdist(sys.argv[2]))"
    run = subprocess.run([sys.executable, "-c", code, str(ROOT / "adapters/python"), str(folder)], check=True,
                         capture_output=True, text=True)
    return folder / run.stdout.split()[-1]


def test_the_archive_has_what_is_built(sources):
    name = f"boxstream-{setup_data.version()}"
    assert sources.name == name + ".tar.gz"
    with tarfile.open(sources) as archive:
        names = archive.getnames()
        assert f"Version: {setup_data.version()}\n" in archive.extractfile(name + "/PKG-INFO").read().decode()
    assert f"{name}/src/batch/detector.cpp" in names and f"{name}/pyproject.toml" in names
    assert all(each.split("/")[0] == name and ".." not in each and "pycache" not in each for each in names)


@pytest.mark.skipif(not os.environ.get("BOXSTREAM_BUILD_WHEEL"), reason="takes minutes: set BOXSTREAM_BUILD_WHEEL=1")
def test_a_wheel_of_the_archive_without_a_network(sources, tmp_path):
    pip("wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", str(tmp_path), str(sources))
    (wheel,) = tmp_path.glob("*.whl")
    assert "-manylinux_2_" in wheel.name
    extracted = tmp_path / "extracted"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(extracted)
    files = sorted(extracted.rglob("*.so*"))
    assert manylinux.policy_of(files) in wheel.name
    extension = next(each for each in files if each.name.startswith("_core"))
    shown = subprocess.run(["nm", "-D", "--defined-only", str(extension)], capture_output=True, text=True, check=True)
    assert [line.split()[-1] for line in shown.stdout.splitlines()] == ["PyInit__core"]
    pip("install", "--no-deps", "--target", str(tmp_path / "there"), str(wheel))
    code = """
import boxstream, numpy
print(boxstream.find_pairs(numpy.zeros((2, 6))).tolist(), boxstream.__file__)
print([line.split()[-1] for line in open("/proc/self/maps") if "libhwy" in line][:1])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=tmp_path,
                         env=dict(os.environ, PYTHONPATH=str(tmp_path / "there")))
    assert run.stdout.startswith(f"[[0, 1]] {tmp_path}/there/boxstream")
    assert "libhwy" not in run.stdout.splitlines()[1] or str(tmp_path) in run.stdout.splitlines()[1]
