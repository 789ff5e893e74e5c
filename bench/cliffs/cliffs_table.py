#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the tables of docs/internals/cliffs.md of a file that boxstream_cliffs --json wrote."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "support"))
import marked_page  # noqa: E402


def places(row):
    """What is found about one call, the worst first, and how many more."""
    found = []
    for cliff in row["cliffs"]:
        if cliff["jump"] > 0:
            found.append((-cliff["jump"], f"{cliff['jump']:.1f} from {cliff['from']} to {cliff['to']}, {cliff['history']}"))
        else:
            sizes = str(cliff["from"]) if cliff["from"] == cliff["to"] else f"{cliff['from']} to {cliff['to']}"
            found.append((-1 / cliff["below"], f"{cliff['below']:.2f} of the peer at {sizes}, {cliff['history']}"))
    found.sort()
    more = [f"{len(found) - 3} more"] if len(found) > 3 else []
    return "; ".join([text for _, text in found[:3]] + more)


def table(results):
    machine, sizes = results["machine"], results["sizes"]
    rows = [[row["owner"], row["name"], f"{row['largest_jump']:.2f}",
             f"{row['least']:.2f}" if "least" in row else "", places(row)] for row in results["rows"]]
    head = ["", "call", "largest jump", "least beside the peer", "places"]
    text = (f"{machine['cpu']}, {machine['compiler']}, {machine['date'][:10]}; sizes one by one to {sizes['by_one']}, "
            f"then by {sizes['step']:g} to {sizes['most']}.\n\n")
    return text + marked_page.lines_of(head, rows, ["---", "---", "--:", "--:", "---"])


def sizes_table(results):
    """The peer's time over that of boxstream at some sizes, or at those measured that are next to them."""
    shown = [n for n in (1, 2, 3, 5, 10, 30, 100, 300, 1000, 3000) if n <= results["sizes"]["most"]]
    rows = []
    for row in results["rows"]:
        if "fresh" in row:
            ratios = [min(row["fresh"], key=lambda point: abs(point[0] - n))[1] for n in shown]
            rows.append([row["owner"], row["name"]] + [f"{ratio:.2g}" if ratio < 100 else f"{ratio:.0f}" for ratio in ratios])
    return marked_page.lines_of(["", "call"] + [str(n) for n in shown], rows, ["---", "---"] + ["--:"] * len(shown))


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("results", type=pathlib.Path)
    arguments = parser.parse_args()
    marked_page.require_marks(arguments.into, "cliffs", "sizes")
    results = json.loads(arguments.results.read_text())
    marked_page.put_out(table(results), arguments.into, "cliffs")
    marked_page.put_out(sizes_table(results), arguments.into, "sizes")


if __name__ == "__main__":
    main()
