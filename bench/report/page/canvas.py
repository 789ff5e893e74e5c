# SPDX-License-Identifier: MIT
"""Figures of panels, and the SVG made of them: the same bytes for the same data."""
import io
import math
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402  (after the choice of the backend)

# Distinguishable with colour vision deficiency: Okabe and Ito, 2008.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444", "#8c6d1f"]
MARKERS = "osD^vP*X"
BAD = "#b3261e"

matplotlib.rcParams.update({
    "svg.fonttype": "none", "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans", "Verdana", "sans-serif"],
    "font.size": 8.5, "axes.titlesize": 9.5, "axes.labelsize": 8.5, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.6,
    "axes.edgecolor": "#888888", "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": 8,
    "xtick.color": "#444444", "ytick.color": "#444444", "axes.titlelocation": "left"})


def styles(names):
    """Name -> colour and marker."""
    return {name: {"color": COLOURS[i % len(COLOURS)], "marker": MARKERS[(i + i // len(COLOURS)) % len(MARKERS)]}
            for i, name in enumerate(names)}


def dashes(names):
    """Name -> line style, another one when colours begin again."""
    return {name: ["-", "--", ":", "-."][i // len(COLOURS) % 4] for i, name in enumerate(names)}


def panels(names, wide=False):
    """A figure with axes for each name."""
    columns = 1 if wide else min(len(names), 3)
    rows = math.ceil(len(names) / columns)
    width, height = {1: (7.2, 3.5), 2: (4.9, 3.3), 3: (3.9, 3.0)}[1 if wide else columns]
    figure, axes = pyplot.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False,
                                   layout="constrained")
    for extra in axes.flat[len(names):]:
        extra.set_visible(False)
    for ax, name in zip(axes.flat, names):
        ax.set_title(name)
    return figure, dict(zip(names, axes.flat))


def legend(figure, handles, always=False):
    """Below all panels."""
    if len(handles) > 1 or (always and handles):
        # In typographic points; letters are about 0.6 of their size wide.
        column = 0.6 * 8 * max(map(len, handles)) + 45
        figure.legend(list(handles.values()), list(handles), loc="upper center", bbox_to_anchor=(0.5, 0),
                      ncols=max(1, min(len(handles), int(72 * figure.get_figwidth() / column))))


class Axis:
    """A logarithmic axis also has a place for zero, below all else; a linear one leaves values alone."""

    def __init__(self, values, log):
        values = [value for value in values if math.isfinite(value)]
        positive = [value for value in values if value > 0]
        self.log = log and bool(positive) and all(value >= 0 for value in values)
        self.has_zero = self.log and len(positive) < len(values)
        self.least = min(positive, default=1.0)
        self.most = max(positive, default=1.0)
        # An exact power of ten, so that the tick stands on it.
        self.zero = 10.0 ** (math.ceil(math.log10(self.least)) - 2)

    def place(self, value):
        return self.zero if self.has_zero and value == 0 else value

    def apply(self, axis, set_scale):
        if not self.log:
            return
        set_scale("log")
        locator = matplotlib.ticker.LogLocator(base=10, numticks=8)
        few = self.most < 30 * self.least and not self.has_zero
        axis.set_major_locator(matplotlib.ticker.LogLocator(base=10, subs=(1, 2, 5)) if few else locator)
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(self.tick))
        axis.set_minor_locator(matplotlib.ticker.NullLocator())

    def tick(self, value, _):
        if self.has_zero and value <= self.zero * 1.001:
            return "0" if value >= self.zero * 0.999 else ""
        return f"{value:g}"


def axes_of(ax, xs, ys, log):
    """The two axes, logarithmic where `log` names them and the values allow it."""
    x_axis, y_axis = Axis(xs, "x" in log), Axis(ys, "y" in log)
    x_axis.apply(ax.xaxis, ax.set_xscale)
    y_axis.apply(ax.yaxis, ax.set_yscale)
    return x_axis, y_axis


def cross(ax, x, y, colour, transform):
    """The mark of a failure."""
    ax.plot([x], [y], marker="x", color=colour, markersize=7, markeredgewidth=1.8, transform=transform, clip_on=False,
            linestyle="none", gid="failed")


def settle(figure):
    """Lays panels out, once: then it is known where labels have room."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    for ax in figure.axes:
        ax.get_xlim()  # limits that are still open are settled by asking for them


def to_svg(figure, name):
    """`name` makes the names inside it unique on a page."""
    settle(figure)
    matplotlib.rcParams["svg.hashsalt"] = name
    stream = io.StringIO()
    figure.savefig(stream, format="svg", bbox_inches="tight", pad_inches=0.05,
                   metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    pyplot.close(figure)
    text = stream.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"\s*<metadata>.*?</metadata>", "", text, flags=re.S)
    # A hundredth of a point is finer than any screen.
    text = re.sub(r' (?:d|x|y)="[^"]*"', lambda part: re.sub(r"(\.\d\d)\d+", r"\1", part[0]), text)
    for mark in ('id="', 'href="#', "url(#"):
        text = text.replace(mark, mark + name + "-")
    return text
