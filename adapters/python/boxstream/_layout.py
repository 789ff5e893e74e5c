# SPDX-License-Identifier: MIT
"""What boxes of which many are invalid probably are."""
import sys
import warnings

import numpy as np


class InvalidBoxesWarning(UserWarning):
    """More than a tenth of the boxes or points given are invalid, and pair with nothing."""


def likely_layout(boxes):
    """A sentence about an array of boxes, (n, 2 d) or (n, 2, d); '' if it looks like none that is known."""
    dimensions = boxes.shape[-1] if boxes.ndim == 3 else boxes.shape[1] // 2
    flat = boxes.reshape(len(boxes), 2 * dimensions).astype(float, copy=False)  # squares of large float32 overflow
    with_nan = np.isnan(flat).any(axis=1).sum()
    if with_nan > 0 and with_nan >= 0.1 * len(flat):
        return f"{with_nan} have a NaN"
    known = flat[(np.abs(flat) < 1e150).all(axis=1)]
    if len(known) == 0:
        return ""
    low, high = known[:, :dimensions], known[:, dimensions:]
    ordered = [2 * axis for axis in range(dimensions)]
    if dimensions > 1 and (known[:, ordered] <= known[:, 1::2]).all(axis=1).mean() > 0.9:
        columns = ordered + [column + 1 for column in ordered]
        return f"min and max seem interleaved, axis by axis: boxes[:, {columns}] puts them in order"
    if (high >= 0).all() and (high.std(axis=0) < 0.5 * low.std(axis=0)).all():
        return f"maxima seem to be sizes: boxes[:, {dimensions}:] += boxes[:, :{dimensions}] makes them maxima"
    if (high <= low).all(axis=1).mean() > 0.9:
        columns = [*range(dimensions, 2 * dimensions), *range(dimensions)]
        return f"maxima seem to come first: boxes[:, {columns}] puts them in order"
    return ""


def _warn(text):
    # Above are warn_of_..., which the extension calls, and the caller, or a function of the package that it has called;
    # nothing, if the caller is no Python.
    caller = sys._getframe(1).f_back
    level = 4 if caller is not None and caller.f_globals.get("__name__") == "boxstream._functions" else 3
    warnings.warn(text + "; invalid='skip' says nothing of that, invalid='raise' names the first", InvalidBoxesWarning,
                  stacklevel=level)


def warn_of_boxes(boxes, other, invalid, count):
    with np.errstate(all="ignore"):  # which the caller may have made exceptions
        hints = [hint for hint in (likely_layout(each) for each in (boxes, other) if each is not None) if hint]
    _warn(f"{invalid} of {count} boxes are invalid (a NaN, or min > max) and pair with nothing" +
          "".join(f"; {hint}" for hint in dict.fromkeys(hints)))


def warn_of_points(invalid, count):
    _warn(f"{invalid} of {count} points are invalid (not finite, or a radius below 0) and are near nothing")
