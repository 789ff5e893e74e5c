#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes one offline page of the experiments and their tables.

  page.py --out PAGE.html [--template FILE] [--experiments DIR] [--fresh TABLES] [--stored TABLES] [--prices FILE] [--closed-forms FILE]
      [--witnesses FILE]

The template is a page that draws what its JSON says (demos/pictures/accuracy_page). Of each experiment the table that was
measured last is shown, of the two places: a directory of tables, or a file that holds many.
"""
import argparse
import base64
import json
import math
import pathlib
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from data import BadData, read_experiments  # noqa: E402

MARK = "/*data*/"


def number(value):
    return value if math.isfinite(value) else None


def digits(value):
    """Five of them: finer than any screen."""
    return float(f"{value:.5g}") if math.isfinite(value) else None


def point_row(point, metrics):
    numbers = [point.x, point.cost, point.cost_low, point.cost_high, point.cost_min, point.instructions]
    return [*point.key, *map(number, numbers), [number(point.values[metric]) for metric in metrics], point.failure]


def experiment_json(experiment, fresh_directory):
    table = experiment.table
    shown = {key: value for key, value in experiment.document.items() if key not in ("measure", "smoke", "kind", "knob")}
    if table is None:
        return {"id": experiment.id, **shown}
    counted = experiment.counts.points if experiment.counts else []
    return {
        "id": experiment.id, **shown,
        "knobs": {panel: experiment.knob(panel or None) for panel in ["", *table.panels]},
        "fresh": table.folder.path == pathlib.Path(fresh_directory),
        "table": {"facts": table.facts, "controls": [[panel, number(spread)] for panel, spread in table.controls],
                  "metrics": table.metrics, "points": [point_row(point, table.metrics) for point in table.points]},
        "counts": {"points": [[*p.key, p.instructions] for p in counted if not math.isnan(p.instructions)]},
        "countsFacts": experiment.counts.facts if counted else None,
        "curves": [[*key, [digits(at) for at, _ in points], [digits(value) for _, value in points]]
                   for key, points in table.curves.items()],
    }


def pictures():
    with zipfile.ZipFile(HERE / "thumbnails.zip") as archive:
        return {name.removesuffix(".png"): "data:image/png;base64," + base64.b64encode(archive.read(name)).decode()
                for name in sorted(archive.namelist())}


def page_json(experiments, fresh_directory, prices, closed_forms=None, witnesses=None):
    return {
        "kind": "report", "title": "What accuracy costs in time",
        "names": json.loads((HERE / "names.json").read_text()), "pictures": pictures(),
        "prices": json.loads(pathlib.Path(prices).read_text()) if prices else None,
        "closedForms": json.loads(pathlib.Path(closed_forms).read_text()) if closed_forms else None,
        "witnesses": json.loads(pathlib.Path(witnesses).read_text()) if witnesses else None,
        "experiments": [experiment_json(experiment, fresh_directory) for experiment in experiments],
    }


def build(template, data):
    """The page as one text. "<" in the JSON could end the element that it is in."""
    if MARK not in template:
        raise BadData(f"no {MARK} in the template")
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return template.replace(MARK, text, 1)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True)
    parser.add_argument("--template", default="build/release/demos/pictures/viewer/accuracy_shell.html")
    parser.add_argument("--experiments", default="bench/report/experiments")
    parser.add_argument("--fresh", default="out/report")
    parser.add_argument("--stored", default="bench/report/results.txt")
    parser.add_argument("--prices", default="demos/simulation/effects/prices.json")
    parser.add_argument("--closed-forms", default="tests/lab/scenes/closed_form/bands.json")
    parser.add_argument("--witnesses", default="tests/lab/scenes/witnessed/bands.json")
    spec = parser.parse_args(arguments)
    places = [spec.fresh, spec.stored] if spec.stored else [spec.fresh]
    try:
        experiments = read_experiments(spec.experiments, places)
        page = build(pathlib.Path(spec.template).read_text(), page_json(experiments, spec.fresh, spec.prices,
                                                                       spec.closed_forms, spec.witnesses))
    except (BadData, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    out = pathlib.Path(spec.out)
    out.parent.mkdir(parents=True, exist_ok=True)
    part = out.with_name(out.name + ".part")
    part.write_text(page)
    part.replace(out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
