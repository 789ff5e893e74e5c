# SPDX-License-Identifier: MIT
"""An assembly: which parts clash. Boxes of parts say which may, the planes that separate two bars, which do."""
import numpy as np

import boxstream


def make(count, seed=1):
    """Bars: centres (n, 3), axes (n, 3, 3) by rows, half lengths along each (n, 3), in millimetres."""
    random = np.random.default_rng(seed)
    axes = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    half = np.column_stack([random.uniform(20, 60, count), random.uniform(1, 4, (count, 2))])
    return random.random((count, 3)) * count ** (1 / 3) * 40, axes, half


def find(centre, axes, half):
    """Pairs of bars that share a point."""
    reach = (np.abs(axes) * half[:, :, None]).sum(axis=1)
    near = boxstream.find_pairs(np.hstack([centre - reach, centre + reach]))
    i, j = near.T
    edges = np.cross(axes[i][:, :, None], axes[j][:, None]).reshape(-1, 9, 3)
    normals = np.concatenate([axes[i], axes[j], edges], axis=1)  # one of them separates bars that do not clash
    apart = np.abs(np.einsum("nkd,nd->nk", normals, centre[j] - centre[i]))
    extent = sum(np.einsum("nkm,nm->nk", np.abs(np.einsum("nkd,nmd->nkm", normals, axes[p])), half[p]) for p in (i, j))
    return near[(apart <= extent).all(axis=1)]


if __name__ == "__main__":
    parts = make(5_000)
    print(len(parts[0]), "bars:", len(find(*parts)), "pairs clash")
