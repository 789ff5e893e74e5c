# SPDX-License-Identifier: MIT
"""What the package says of itself."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = "All touching pairs of axis-aligned boxes, as NumPy arrays"
REQUIRES_PYTHON = ">=3.9"
REQUIRES = ["numpy"]


def version():
    text = (ROOT / "include/boxstream/version.hpp").read_text(encoding="utf-8")
    return ".".join(re.search(rf"_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def metadata():
    """PKG-INFO of an archive of sources."""
    lines = ["Metadata-Version: 2.1", "Name: boxstream", f"Version: {version()}", f"Summary: {SUMMARY}", "License: MIT",
             f"Requires-Python: {REQUIRES_PYTHON}", *(f"Requires-Dist: {name}" for name in REQUIRES)]
    return "\n".join(lines) + "\n"
