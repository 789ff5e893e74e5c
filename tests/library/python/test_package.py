# SPDX-License-Identifier: MIT
"""What the package has, its stubs, its texts and what its extension shows to others."""
import ast
import inspect
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import boxstream
from boxstream import _core

FOLDER = pathlib.Path(boxstream.__file__).parent
ROOT = pathlib.Path(__file__).resolve().parents[3]


def stubs():
    tree = ast.parse((FOLDER / "__init__.pyi").read_text(encoding="utf-8"))
    return {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def public(owner):
    """Names of its own, not those that a NamedTuple has from tuple."""
    bases = (each for each in (tuple, UserWarning) if inspect.isclass(owner) and issubclass(owner, each))
    inherited = {name for each in bases for name in dir(each)}
    return {name for name in dir(owner) if not name.startswith("_") and name not in inherited}


def test_version():
    header = (ROOT / "include/boxstream/version.hpp").read_text(encoding="utf-8")
    assert boxstream.__version__ == ".".join(re.findall(r"#define \w+ (\d+)", header))


def test_simd_target():
    assert re.fullmatch(r"[A-Z]+[A-Z0-9_]*", boxstream.simd_target())


def test_stubs_have_each_name_and_no_other():
    nodes = stubs()
    assert set(nodes) == set(boxstream.__all__)
    for name, node in nodes.items():
        if isinstance(node, ast.ClassDef):
            members = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
            members |= {each.target.id for each in node.body if isinstance(each, ast.AnnAssign)}
            assert {each for each in members if not each.startswith("_")} == public(getattr(boxstream, name)), name
    assert (FOLDER / "py.typed").is_file()


def arguments(node):
    return [each.arg for each in node.args.args + node.args.kwonlyargs if each.arg != "self"]


def test_signatures_are_those_of_the_stub():
    for name, node in stubs().items():
        if isinstance(node, ast.FunctionDef):
            assert list(inspect.signature(getattr(boxstream, name)).parameters) == arguments(node), name


def test_texts_of_methods_begin_with_the_signature_of_the_stub():
    for name, node in stubs().items():
        for stub in node.body if isinstance(node, ast.ClassDef) else ():
            if not isinstance(stub, ast.FunctionDef) or stub.name.startswith("_") or stub.decorator_list:
                continue
            text = getattr(getattr(boxstream, name), stub.name).__doc__
            called, inside = re.fullmatch(r"(\w+)\((.*)\)", text.splitlines()[0]).groups()
            assert called == stub.name
            assert [each.split("=")[0] for each in inside.split(", ") if each not in ("*", "")] == arguments(stub)


def test_functions_have_the_parameters_of_methods():
    nodes = stubs()
    for method in nodes["Detector"].body:
        if method.name in nodes:
            assert [*arguments(method), "executor"] == arguments(nodes[method.name])


def test_everything_has_a_text():
    for name in boxstream.__all__:
        owner = getattr(boxstream, name)
        assert inspect.getdoc(owner) and owner.__module__ == "boxstream"
        for member in public(owner) if inspect.isclass(owner) else ():
            assert inspect.getdoc(getattr(owner, member)), f"{name}.{member}"


@pytest.mark.skipif(shutil.which("nm") is None, reason="needs nm")
def test_the_extension_shows_nothing_but_its_entry():
    listing = subprocess.run(["nm", "-D", "--defined-only", _core.__file__], capture_output=True, text=True, check=True)
    assert [line.split()[-1] for line in listing.stdout.splitlines()] == ["PyInit__core"]


LOADING = """
import array, mmap
import numpy as np
import boxstream
saved = boxstream.World().save()
boxstream.World.load(bytearray(saved))
boxstream.World.load(memoryview(saved))
boxstream.World.load(mmap.mmap(-1, 9))
boxstream.BoxIndex.load(array.array("B", saved))
boxstream.BoxIndex.load(np.frombuffer(saved, np.uint8))
"""


def test_stubs_are_sound(tmp_path):
    program = tmp_path / "loading.py"
    program.write_text(LOADING, encoding="utf-8")
    mypy = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path)]
    subprocess.run([*mypy, str(FOLDER / "__init__.pyi"), str(program)], check=True)


def test_stats_are_shown_with_each_count():
    detector = boxstream.Detector()
    detector.find_pairs([[0, 0, 0, 2, 2, 2], [1, 1, 1, 3, 3, 3]])
    shown = re.findall(r"(\w+)=(\d+)", repr(detector.stats))
    assert {name: int(value) for name, value in shown} == {name: getattr(detector.stats, name)
                                                           for name in public(boxstream.Stats)}
