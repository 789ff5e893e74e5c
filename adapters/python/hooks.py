# SPDX-License-Identifier: MIT
"""What pip calls at the repository's root: setuptools, in the folder of this file."""
import io
import os
import pathlib
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.chdir(pathlib.Path(__file__).resolve().parent)

from setuptools.build_meta import *  # noqa: E402,F401,F403

# What the extension is built from, and what describes it.
SOURCES = ["CHANGELOG.md", "CMakeLists.txt", "LICENSE", "README.md", "adapters/CMakeLists.txt", "adapters/python",
           "adapters/preload", "adapters/thread_pool", "cmake", "docs/python.md", "include", "pyproject.toml", "src"]


def build_sdist(sdist_directory, config_settings=None):
    """The sources of the package alone: setuptools would leave out those above its folder."""
    import setup_data

    name = f"boxstream-{setup_data.version()}"
    path = pathlib.Path(sdist_directory) / f"{name}.tar.gz"

    def clean(info):
        if "__pycache__" in info.name or info.name.endswith(".egg-info"):
            return None
        info.uid = info.gid = 0
        info.uname = info.gname = ""
        return info

    with tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for source in SOURCES:
            archive.add(ROOT / source, f"{name}/{source}", filter=clean)
        about = setup_data.metadata().encode()
        entry = tarfile.TarInfo(f"{name}/PKG-INFO")
        entry.size = len(about)
        archive.addfile(entry, io.BytesIO(about))
    return path.name
