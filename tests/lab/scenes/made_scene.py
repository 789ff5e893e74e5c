# SPDX-License-Identifier: MIT
"""Runs of scenes that a script makes, and the table that comes of them."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402


def simulate(tool, scene, folder, *options):
    """What `boxstream simulate` printed for `scene`, which needs no "format" and "meta". Ends the program with its line
    if it refused; a criterion that failed is no refusal."""
    file = pathlib.Path(folder) / "world.json"
    about = pathlib.Path(sys.argv[0]).name
    file.write_text(json.dumps({"format": 1, "meta": {"name": "made", "about": about}} | scene))
    run = subprocess.run([tool, "simulate", str(file), *options], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        raise SystemExit(run.stderr)
    return run


def bounds(size):
    return {"min": [-size] * 3, "max": [size] * 3}


def table_script(doc, mark, make):
    """The whole of a script that makes one table: `make(tool, folder)` returns what lines_of() takes."""
    parser = marked_page.parser(doc)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("--check", action="store_true", help="only compare with the page of --into; fails if it differs")
    options = parser.parse_args()
    if options.check and not options.into:
        parser.error("--check: needs --into")
    marked_page.require_marks(options.into, mark)
    with tempfile.TemporaryDirectory() as folder:
        text = marked_page.lines_of(*make(options.tool, pathlib.Path(folder)))
    if not options.check:
        marked_page.put_out(text, options.into, mark)
    elif text != marked_page.text_of(options.into, mark):
        raise SystemExit(f"{options.into} has another table than this:\n{text}")
