# SPDX-License-Identifier: MIT
"""Pairs of boxes, and of points, with what Python users have. Each returns an array of shape (k, 2), a < b."""
import numpy as np


def versions():
    import rtree
    import scipy

    spatialindex = rtree.core.rt.SIDX_Version().decode()
    return f"SciPy {scipy.__version__}, Rtree {rtree.__version__} on libspatialindex {spatialindex}"


def brute_force(boxes):
    """NumPy: each box with all later ones."""
    minima, maxima = boxes[:, :3], boxes[:, 3:]
    found = []
    for i in range(len(boxes) - 1):
        rest = slice(i + 1, None)
        meet = ((minima[rest] <= maxima[i]) & (minima[i] <= maxima[rest])).all(axis=1)
        later = np.flatnonzero(meet) + i + 1
        found.append(np.column_stack([np.full(len(later), i), later]))
    return np.concatenate(found)


def rtree(boxes):
    """Rtree: a tree that libspatialindex packs from all boxes, then a query for each."""
    from rtree import index

    rows = boxes.tolist()
    tree = index.Index(((i, row, None) for i, row in enumerate(rows)), properties=index.Property(dimension=3))
    return np.array([(i, j) for i, row in enumerate(rows) for j in tree.intersection(row) if i < j]).reshape(-1, 2)


def kd_tree(boxes):
    """SciPy: centres within the largest side of each other, by a tree; then boxes, by NumPy."""
    from scipy.spatial import cKDTree

    wide = boxes.astype(np.float64)
    minima, maxima = wide[:, :3], wide[:, 3:]
    reach = (maxima - minima).max() * (1 + 1e-12)
    near = cKDTree((minima + maxima) / 2).query_pairs(reach, p=np.inf, output_type="ndarray")
    a, b = near[:, 0], near[:, 1]
    meet = ((minima[a] <= maxima[b]) & (minima[b] <= maxima[a])).all(axis=1)
    return near[meet]


def kd_tree_points(points, distance):
    """SciPy: points within a distance of each other."""
    from scipy.spatial import cKDTree

    return cKDTree(points).query_pairs(distance, output_type="ndarray")
