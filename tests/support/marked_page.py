# SPDX-License-Identifier: MIT
"""Tables that scripts make of runs, in the pages of docs/: each stands between two marks that have its name,
"<!-- NAME: begin -->" and "<!-- NAME: end -->"."""
import argparse
import pathlib
import sys


def parser(doc):
    """Of a script whose docstring says what it does; with the option --into."""
    made = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--into", type=pathlib.Path, metavar="PAGE.md",
                      help="replace what is between the marks in this page; else the table is printed")
    return made


def require_marks(page, *names):
    """Ends the program, with a line that says why, if a page (or None) cannot take what is to be put into it. Asked
    first, for what comes then takes long."""
    if page is None:
        return
    if not page.is_file() or any(mark not in page.read_text() for name in names for mark in _marks(name)):
        print(f"{page}: no such page, or it has no marks", file=sys.stderr)
        sys.exit(2)


def put_out(text, page, name):
    """Between the marks, or to standard output if there is no page."""
    if page is None:
        print(text, end="")
        return
    begin, end = _marks(name)
    before, rest = page.read_text().split(begin)
    page.write_text(before + begin + text + end + rest.split(end)[1])


def text_of(page, name):
    begin, end = _marks(name)
    return page.read_text().split(begin)[1].split(end)[0]


def lines_of(head, rows, align=None):
    """A table in Markdown; `align` is "---:" for a column of numbers."""
    ruler = align or ["---"] * len(head)
    return "".join("|" + "".join(f" {cell} |" if cell else " |" for cell in row) + "\n" for row in (head, ruler, *rows))


def _marks(name):
    return f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
