# SPDX-License-Identifier: MIT
"""What each effect costs where a scene calls for it, and where it does not."""
import canvas


def plot(prices):
    effects = sorted(prices["effects"].items(), key=lambda item: item[1]["ns_per_body_step"])
    figure, axes = canvas.panels([""], wide=True)
    ax = axes[""]
    figure.set_size_inches(7.8, 0.9 + 0.2 * len(effects))
    for place, (_, price) in enumerate(effects):
        middle, (low, high) = price["ns_per_body_step"], price["interval_ns"]
        ax.barh(place, middle, height=0.65, color=canvas.COLOURS[0], alpha=0.85,
                xerr=[[middle - low], [high - middle]], error_kw={"elinewidth": 1, "ecolor": "#444444"})
    # Most cost tens of nanoseconds, few thousands; measurement may fall below zero.
    ax.set_xscale("symlog", linthresh=10)
    ax.set_yticks(range(len(effects)), [name.replace("_", " ") for name, _ in effects])
    ax.set_ylim(-0.7, len(effects) - 0.3)
    ax.grid(axis="y", visible=False)
    ax.set_xlabel("ns per body and step where the scene calls for it; lines: the least and the greatest round")
    return figure
