#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Contracts in public headers can be read: a label ("@par Threads") has a line of its own, a paragraph has few lines."""
import pathlib
import re
import sys

LABELS = ("Answers|Balance|Boxes|Builds|Bytes|Callbacks|Contacts|Coordinates|Cost|Distance|Distances|Errors|Files|Filters|"
          "Call|Floating point|Floating-point environment|Ids|Machines|Made|Memory|Method|Names|Objects|Octrees|Order|Pairs|Queries|"
          "Ranks|Reasons|Rules|Sent|Shapes|Speed|Stop|Threads|Use")
MOST_LINES = 14
MOST_LABELS_IN_TEXT = 2

root = pathlib.Path(sys.argv[1])
headers = sorted([*root.glob("include/boxstream/*.hpp"), *root.glob("adapters/*/include/boxstream/**/*.hpp")])
assert len(headers) > 20, headers
wrong = []
for header in headers:
    if "detail" in header.parts:
        continue
    name = header.relative_to(root)
    for block in re.finditer(r"(?:^[ ]*///.*\n)+", header.read_text(), flags=re.M):
        first = header.read_text().count("\n", 0, block.start()) + 1
        lines = [re.sub(r"^\s*/// ?", "", line) for line in block[0].splitlines()]
        labels = re.findall(rf"(?:^|[.)] +)(?:{LABELS}): ", " ".join(lines))
        if len(labels) > MOST_LABELS_IN_TEXT:
            wrong.append(f"{name}:{first}: {len(labels)} labels within text: each wants a line of its own, as @par")
        length = 0
        for number, line in enumerate(lines, first):
            if re.match(rf"(?:{LABELS}): ", line):
                wrong.append(f"{name}:{number}: a label that begins a line wants to be an @par")
            length = 0 if line.strip() == "" or line.startswith(("@par", "    ")) else length + 1
            if length == MOST_LINES + 1:
                wrong.append(f"{name}:{number}: a paragraph of more than {MOST_LINES} lines")
# The comment that CONTRIBUTING.md shows as a model is one of them.
model = re.search(r"```cpp\n(.*?)```", (root / "CONTRIBUTING.md").read_text(), flags=re.S)[1]
if not any(model in re.sub(r"^  ", "", header.read_text(), flags=re.M) for header in headers):
    wrong.append("CONTRIBUTING.md: the model of a comment is in no public header")
print("\n".join(wrong) or f"{len(headers)} headers")
sys.exit(bool(wrong))
