# SPDX-License-Identifier: MIT
"""Numbers and names as people read them."""
import math

UNITS = {"m": "m", "s": "s", "ms": "ms", "us": "µs", "ns": "ns", "deg": "degrees", "rad": "rad", "bytes": "bytes",
         "j": "J", "percent": "%"}


def metric_name(name):
    """("penetration", "m") of "penetration_m"."""
    stem, _, unit = name.rpartition("_")
    text = stem if stem and unit in UNITS else name
    return text.replace("_", " ").replace(".", ", "), UNITS[unit] if text == stem else ""


def metric_label(name, cost_unit=""):
    """"penetration (m)", for axes."""
    if name == "cost":
        return cost_unit or "cost"
    text, unit = metric_name(name)
    return f"{text} ({unit})" if unit else text


def figure(value):
    """Three digits, without an exponent where that can be read."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    size = abs(value)
    if value == int(value) and size < 1e6:
        return f"{int(value):,}".replace(",", "\u202f").replace("-", "−")
    if size >= 1e6 or size < 1e-4:
        mantissa, exponent = f"{value:.2e}".split("e")
        text = f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"
    elif size >= 100:
        text = f"{value:.0f}"
    else:
        text = f"{value:.{2 - math.floor(math.log10(size))}f}"
    return text.replace("-", "−")


def measured(metric, value):
    """"0.02 m"."""
    unit = metric_name(metric)[1]
    return f"{figure(value)} {unit}" if unit else figure(value)


def percent(share):
    return f"{100 * share:.1f} %"


def several(count, noun):
    """"1 point", "2 points"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
