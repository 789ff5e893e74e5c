# SPDX-License-Identifier: MIT
"""Pareto-optimal settings, and the hypervolume of a series."""
import math

# Studentised range divided by the square root of two, for 5 %: Demsar, "Statistical comparisons of classifiers", 2006.
NEMENYI = {2: 1.960, 3: 2.343, 4: 2.569, 5: 2.728, 6: 2.850, 7: 2.949, 8: 3.031, 9: 3.102, 10: 3.164}


def error_of(point, metric, better="low"):
    """Smaller is better."""
    return -point.value(metric) if better == "high" else point.value(metric)


def counts_here(point, metric):
    return not point.failure and not math.isnan(point.value(metric)) and not math.isnan(point.cost)


def front(points, metric, better="low"):
    """The Pareto-optimal points, by increasing cost."""
    best, least = [], math.inf
    usable = [point for point in points if counts_here(point, metric)]
    for point in sorted(usable, key=lambda p: (p.cost, error_of(p, metric, better))):
        if error_of(point, metric, better) < least:
            least = error_of(point, metric, better)
            best.append(point)
    return best


def scale_of(values):
    """Maps values to 0..1: by their logarithms, where zero is a tenth of the least that is not. None if all are equal."""
    positive = [value for value in values if value > 0]
    if not positive or any(value < 0 for value in values):
        low, high = min(values), max(values)
        place = lambda value: value
    else:
        floor = min(positive) / 10 if len(positive) < len(values) else min(positive)
        place = lambda value: math.log10(max(value, floor))
        low, high = place(min(values)), place(max(values))
    return None if high == low else lambda value: (place(value) - low) / (high - low)


def hypervolumes(points, metric, better="low"):
    """Series -> the part of the plane of cost and error, both scaled to what was measured, that it reaches; 1 is all.
    A series that failed everywhere reaches nothing."""
    series = list(dict.fromkeys(point.series for point in points))
    usable = [point for point in points if counts_here(point, metric)]
    volumes = dict.fromkeys(series, 0.0)
    if not usable:
        return volumes
    x = scale_of([point.cost for point in usable]) or (lambda _: 0.5)
    y = scale_of([error_of(point, metric, better) for point in usable]) or (lambda _: 0.5)
    for name in series:
        best = front([point for point in usable if point.series == name], metric, better)
        places = [(x(point.cost), y(error_of(point, metric, better))) for point in best] + [(1.0, 0.0)]
        volumes[name] = sum((after - at) * (1 - error) for (at, error), (after, _) in zip(places, places[1:]))
    return volumes


def ranks(volumes):
    """Name -> rank, 1 is the largest; equal ones share the mean."""
    order = sorted(volumes.values(), reverse=True)
    return {name: order.index(value) + (order.count(value) + 1) / 2 for name, value in volumes.items()}


def critical_difference(series, panels):
    """Mean ranks that differ by less are not significantly different (Nemenyi, 5 %). None where the table of that test ends."""
    if series not in NEMENYI or panels < 2:
        return None
    return NEMENYI[series] * math.sqrt(series * (series + 1) / (6 * panels))
