#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes one offline page of the experiments and their tables.

  page.py --out PAGE.html [--experiments DIR] [--fresh DIR] [--stored DIR] [--prices FILE]

Of each experiment the table that was measured last is shown, of the two directories.
"""
import argparse
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import canvas  # noqa: E402
import plot_prices  # noqa: E402
import plots  # noqa: E402
from data import BadData, read_experiments  # noqa: E402
from markup import download, escape, table, tag  # noqa: E402
from section import section  # noqa: E402
from summary import summary  # noqa: E402
from words import figure, several  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


def price_text(price):
    """With the least and the greatest of the rounds, which may not agree on a sign."""
    low, high = price["interval_ns"]
    interval = f"{figure(low)} to {figure(high)}"
    return f"within noise: {interval}" if low <= 0 <= high else f"{figure(price['ns_per_body_step'])} ({interval})"


def prices_section(file):
    """What effects cost, from the file that `boxstream prices` writes."""
    text = pathlib.Path(file).read_text()
    prices = json.loads(text)
    svg = canvas.to_svg(plot_prices.plot(prices), "prices")
    rows = [[escape(name.replace("_", " ")),
             (price_text(price), "n"),
             *((figure(price.get(key, math.nan)), "n") for key in ("uncalled_ns_per_body_step", "bytes_per_body", "pairs_per_body"))]
            for name, price in sorted(prices["effects"].items(), key=lambda item: -item[1]["ns_per_body_step"])]
    head = ["effect", "ns per body and step (least to greatest round)", "where nothing calls for it", "bytes per body",
            "pairs per body"]
    return tag(
        "section", tag("h2", "Price list of effects"),
        tag("p", "What does it cost to switch an effect on?", class_="question"),
        tag("figure", tag("figcaption", "Effects by price ", download("SVG", "prices.svg", "image/svg+xml", svg)), svg,
            id="prices-plot"),
        tag("details", tag("summary", "Numbers: " + several(len(rows), "effect")), table(head, rows, "points")),
        tag("p", tag("code", "build/release/bin/boxstream prices"), " makes it again. ",
            download("JSON", "prices.json", "application/json", text), class_="again"),
        tag("p", escape(prices.get("machine", "")), class_="origin"), id="prices", class_="experiment")


def say(text):
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def build(experiments, fresh_directory, prices):
    """The page as one text."""
    sections = []
    for experiment in experiments:
        say(f"page: {experiment.id}")
        fresh = experiment.table is not None and experiment.table.file.parent == pathlib.Path(fresh_directory)
        sections.append(section(experiment, plots.draw(experiment), fresh))
    links = [tag("a", escape(e.id), href=f"#{e.id}", title=e.title) for e in experiments]
    if prices:
        sections.append(prices_section(prices))
        links.append(tag("a", "prices", href="#prices"))
    say("")
    head = tag("head", '<meta charset="utf-8">', '<meta name="viewport" content="width=device-width">',
               tag("title", "What accuracy costs in time"), '<link rel="icon" href="data:,">',
               tag("style", (HERE / "style.css").read_text()))
    return "<!doctype html>\n" + tag("html", head, tag("body", summary(experiments), tag("nav", *links), *sections),
                                     lang="en") + "\n"


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True)
    parser.add_argument("--experiments", default="bench/report/experiments")
    parser.add_argument("--fresh", default="out/report")
    parser.add_argument("--stored", default="bench/report/results")
    parser.add_argument("--prices", default="demos/simulation/effects/prices.json")
    spec = parser.parse_args(arguments)
    directories = [spec.fresh, spec.stored] if spec.stored else [spec.fresh]
    try:
        experiments = read_experiments(spec.experiments, directories,
                                       [pathlib.Path(directory) / "counts" for directory in directories])
        page = build(experiments, spec.fresh, spec.prices)
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
