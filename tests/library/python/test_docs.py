# SPDX-License-Identifier: MIT
"""The examples of docs/python.md print what it says."""
import pathlib
import re
import subprocess
import sys

import pytest

TEXT = (pathlib.Path(__file__).resolve().parents[3] / "docs/python.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", TEXT, re.S)


def test_each_example_has_its_output():
    assert len(EXAMPLES) == TEXT.count("```python") > 0


@pytest.mark.parametrize("code, output", EXAMPLES)
def test_example(code, output):
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == output
