# SPDX-License-Identifier: MIT
"""The table "Instead of what you have" of docs/python.md: each line finds what it stands for."""
import pathlib
import re
import types

import numpy as np
import pytest

import boxstream

TEXT = (pathlib.Path(__file__).resolve().parents[3] / "docs/python.md").read_text(encoding="utf-8")
TABLE = TEXT.split("## Instead of what you have")[1].split("\n## ")[0]
ROWS = dict(line[2:-2].split(" | ", 1) for line in TABLE.splitlines() if line.startswith("| ") and line != "|---|---|")
del ROWS["you have"]

RANDOM = np.random.default_rng(11)
LOW = RANDOM.random((300, 3)) * 10
BOXES = np.hstack([LOW, LOW + RANDOM.random((300, 3))])
RECTANGLES = BOXES[:, [0, 1, 3, 4]]
FEW = BOXES[:20] + 0.25
CELLS = np.unique(RANDOM.integers(0, 12, (400, 3)).astype(np.int32), axis=0)


def genes(count, seed):
    random = np.random.default_rng(seed)
    start = random.integers(0, 500, count) * 4
    return np.stack([start, start + 4 * random.integers(1, 9, count)], axis=1)


A, B = genes(80, 1), genes(90, 2)
A_OFFSETS, B_OFFSETS = np.array([0, 30, 30, 80]), np.array([0, 50, 60, 90])


def run(row, **names):
    """What each piece of code of a row gives, but for those that are another library's."""
    space = dict(vars(boxstream), np=np, boxes=BOXES, few=FEW, rectangles=RECTANGLES, a=A, b=B, a_offsets=A_OFFSETS,
                 b_offsets=B_OFFSETS, cells=CELLS, points=BOXES[:, :3].copy(), flat=BOXES[:, :2].copy())
    space.update(names)
    codes = [code for code in re.findall(r"`([^`]*)`", ROWS[row]) if "(" in code]
    for code in [code for code in codes if " = " in code]:
        exec(code, space)
    return [eval(code, space) for code in codes if " = " not in code and "shapely" not in code and "..." not in code]


def pairs(array):
    return {tuple(map(int, row)) for row in array}


def touching(a, b, closed=True, tolerance=0):
    half = a.shape[1] // 2
    meet = np.less_equal if closed else np.less
    return meet(a[:, None, :half], b[None, :, half:] + tolerance) & meet(b[None, :, :half], a[:, None, half:] + tolerance)


def self_pairs(boxes):
    return pairs(np.argwhere(np.triu(touching(boxes, boxes).all(axis=2), 1)))


def cross_pairs(a, b, **rules):
    return pairs(np.argwhere(touching(a, b, **rules).all(axis=2)))


def rtree_pairs(boxes):
    index = pytest.importorskip("rtree").index
    dimensions = boxes.shape[1] // 2
    tree = index.Index(properties=index.Property(dimension=dimensions))
    for i, box in enumerate(boxes.tolist()):
        tree.insert(i, box)
    return tree, {(i, j) for i, box in enumerate(boxes.tolist()) for j in tree.intersection(box) if i < j}


def test_rtree():
    (found,) = run("Rtree: an `index.Index` filled box by box, `intersection` for each box")[:1]
    assert pairs(found) == self_pairs(BOXES) == rtree_pairs(BOXES)[1]
    (found,) = run("Rtree of rectangles")
    assert pairs(found) == self_pairs(RECTANGLES) == rtree_pairs(RECTANGLES)[1]
    found, nearest = run("Rtree that stays, asked now and then: `index.intersection(box)`, `index.nearest(box, 3)`")
    tree = rtree_pairs(BOXES)[0]
    assert sorted(found) == sorted(j for box in FEW.tolist() for j in tree.intersection(box))
    for point, row in zip(BOXES[:, :3].tolist(), nearest.tolist()):
        assert set(row) <= set(tree.nearest(point * 2, 3))


def test_shapely_and_geopandas():
    shapes = [types.SimpleNamespace(bounds=tuple(each)) for each in RECTANGLES]
    (found,) = run("Shapely: `STRtree(a).query(b)`", a=shapes, b=shapes[:20])
    assert pairs(found) == cross_pairs(RECTANGLES[:20], RECTANGLES)
    pandas = pytest.importorskip("pandas")
    frame = types.SimpleNamespace(bounds=pandas.DataFrame(RECTANGLES, columns=["minx", "miny", "maxx", "maxy"]))
    (found,) = run("GeoPandas: the first step of `a.sjoin(b)`", a=frame, b=frame)
    assert pairs(found) == cross_pairs(RECTANGLES, RECTANGLES)


def test_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    sparse = pytest.importorskip("scipy.sparse")
    points = BOXES[:, :3]
    (found,) = run("SciPy: `cKDTree(points).query_pairs(r)`", r=0.7)
    assert pairs(found) == spatial.cKDTree(points).query_pairs(0.7)
    (found,) = run("SciPy: `cKDTree` of rows of two coordinates", r=0.4)
    assert pairs(found) == spatial.cKDTree(points[:, :2]).query_pairs(0.4)
    radii = RANDOM.random(300) / 2
    (found,) = run("SciPy: `cKDTree` of centres, for balls of different sizes", centres=points, radii=radii)
    assert pairs(found) == {(i, j) for i, j in spatial.cKDTree(points).query_pairs(1.0)
                            if np.linalg.norm(points[i] - points[j]) <= radii[i] + radii[j]}
    ((indptr, indices),) = run("SciPy: `cKDTree.sparse_distance_matrix`, `query_ball_point` of boxes")
    matrix = sparse.csr_array((np.ones(len(indices), bool), indices, indptr), shape=(300, 300))
    assert (matrix.toarray() == (touching(BOXES, BOXES).all(axis=2) & ~np.eye(300, dtype=bool))).all()


def test_trimesh():
    triangles = RANDOM.random((200, 3, 3))
    mesh = types.SimpleNamespace(triangles=triangles)
    (found,) = run("trimesh: `mesh.triangles_tree`", t=mesh.triangles)
    assert pairs(found) == self_pairs(np.hstack([triangles.min(axis=1), triangles.max(axis=1)]))


def test_intervals():
    (found,) = run("bedtools: `intersect` on one chromosome, pybedtools")
    assert pairs(found) == cross_pairs(A, B, closed=False) != cross_pairs(A, B)
    (found,) = run("bedtools on all chromosomes")
    assert pairs(found) == {(i + s, j + t) for s, e, t, f in zip(A_OFFSETS, A_OFFSETS[1:], B_OFFSETS, B_OFFSETS[1:])
                            for i, j in cross_pairs(A[s:e], B[t:f], closed=False)}
    (found,) = run("`bedtools window -w 100`")
    assert pairs(found) == cross_pairs(A, B, closed=False, tolerance=100)


def test_voxels():
    ((offsets, neighbours),) = run("voxels: `scipy.ndimage` for neighbours")
    full = np.zeros((14, 14, 14), int)
    full[tuple(CELLS.T + 1)] = 1
    ndimage = pytest.importorskip("scipy.ndimage")
    counts = ndimage.convolve(full, np.ones((3, 3, 3), int), mode="constant")[tuple(CELLS.T + 1)] - 1
    assert np.diff(offsets).tolist() == counts.tolist() and len(neighbours) == counts.sum()


def test_layouts_and_floats():
    (found,) = run("few boxes asked of many, once")
    assert pairs(found) == cross_pairs(FEW, BOXES)
    (found,) = run("doubles, where floats are enough")
    assert pairs(found) >= self_pairs(BOXES)
    (found,) = run("VTK, PyVista: bounds `xmin, xmax, ymin, ymax, zmin, zmax`", bounds=BOXES[:, [0, 3, 1, 4, 2, 5]])
    assert pairs(found) == self_pairs(BOXES)
    (found,) = run("origin and size", origin=LOW, size=BOXES[:, 3:] - LOW)
    assert pairs(found) >= self_pairs(np.hstack([LOW, LOW + (BOXES[:, 3:] - LOW)]))


def test_no_line_is_left_out():
    source = pathlib.Path(__file__).read_text(encoding="utf-8")
    assert len(ROWS) > 15 and [row for row in ROWS if f'run("{row}"' not in source] == []
