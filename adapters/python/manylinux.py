# SPDX-License-Identifier: MIT
"""What a wheel needs of a system: the rules of manylinux (PEP 600), which the name of a wheel promises to keep.

A library that systems need not have is put into the wheel, beside the extension. What remains are libraries that all of
them have, and versions of their symbols, of which the newest says how old a system may be.
"""
import pathlib
import platform
import re
import shutil
import subprocess

# Those that the policy names and that an extension of this kind could need.
EVERYWHERE = {"libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libgcc_s.so.1",
              "libstdc++.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# With which minor version of glibc 2 the systems of a policy came, and the newest symbols of their other libraries.
POLICIES = [(17, {"GLIBCXX": (3, 4, 19), "CXXABI": (1, 3, 7), "GCC": (4, 8, 0)}),
            (24, {"GLIBCXX": (3, 4, 22), "CXXABI": (1, 3, 10), "GCC": (6, 0, 0)}),
            (28, {"GLIBCXX": (3, 4, 24), "CXXABI": (1, 3, 11), "GCC": (8, 0, 0)}),
            (31, {"GLIBCXX": (3, 4, 28), "CXXABI": (1, 3, 12), "GCC": (9, 0, 0)}),
            (34, {"GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (11, 0, 0)}),
            (35, {"GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0)}),
            (39, {"GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0, 0)})]
FOLDER = "_libs"


def needs(file):
    """The libraries that an ELF file needs, and the newest version of each kind of symbol, such as GLIBC: (2, 32)."""
    text = subprocess.run(["objdump", "-p", str(file)], capture_output=True, text=True, check=True).stdout
    newest = {}
    for kind, number in re.findall(r"\b(GLIBC|GLIBCXX|CXXABI|GCC)_(\d[\d.]*)$", text, re.M):
        version = tuple(map(int, number.split(".")))
        newest[kind] = max(newest.get(kind, (0,)), version)
    return set(re.findall(r"^ *NEEDED +(\S+)$", text, re.M)), newest


def put_in_libraries(extension):
    """Copies of the libraries that systems need not have, to the folder where the extension looks for them."""
    extension = pathlib.Path(extension)
    waiting, seen = [extension], set()
    while waiting:
        file = waiting.pop()
        found = dict(re.findall(r"^\s*(\S+) => (\S+) ", subprocess.run(
            ["ldd", str(file)], capture_output=True, text=True, check=True).stdout, re.M))
        for name in needs(file)[0] - EVERYWHERE - seen:
            seen.add(name)
            copy = extension.parent / FOLDER / name
            copy.parent.mkdir(exist_ok=True)
            if not copy.exists():
                shutil.copy(found[name], copy)
            waiting.append(copy)


def policy_of(files):
    """The name of the oldest policy that all these ELF files keep; ValueError says which needs what none allows."""
    least = 17
    own = {pathlib.Path(file).name for file in files}
    for file in files:
        libraries, newest = needs(file)
        if libraries - EVERYWHERE - own:
            raise ValueError(f"{file} needs {', '.join(sorted(libraries - EVERYWHERE - own))}")
        glibc = newest.pop("GLIBC", (2, 17))
        fitting = [minor for minor, most in POLICIES
                   if all(version <= most[kind] for kind, version in newest.items())]
        if glibc[0] != 2 or not fitting:
            raise ValueError(f"{file} needs symbols that no policy has: {newest}")
        least = max(least, glibc[1], fitting[0])
    return f"manylinux_2_{least}_{platform.machine()}"
