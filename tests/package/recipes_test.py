# SPDX-License-Identifier: MIT
"""What the recipes of other package managers say agrees with the project: the names of options. vcpkg and Conan
themselves are not asked: recipes_test.py ROOT CMAKE_CACHE"""
import json
import pathlib
import re
import sys

root, cache = (pathlib.Path(path) for path in sys.argv[1:])
packaging = root / "cmake/packaging"
options = set(re.findall(r"^(BOXSTREAM_\w+):", cache.read_text(), re.M))

port = json.loads((packaging / "vcpkg/boxstream/vcpkg.json").read_text())
portfile = (packaging / "vcpkg/boxstream/portfile.cmake").read_text()
features = dict(re.findall(r"^  (\w+) (BOXSTREAM_\w+)", portfile, re.M))
assert set(features) == set(port["features"]) and len(features) == 5
assert set(re.findall(r"BOXSTREAM_\w+", portfile)) <= options

recipe = (packaging / "conanfile.py").read_text()
compile(recipe, "conanfile.py", "exec")
adapters = re.findall(r'"(\w+)": \[', recipe.split("ADAPTERS = ")[1].split("}")[0])
parts = re.findall(r'"(\w+)"', recipe.split("LEFT_OUT = ")[1].split(")")[0])
assert set(adapters) == set(features) and {f"BOXSTREAM_{name.upper()}" for name in adapters + parts} <= options
