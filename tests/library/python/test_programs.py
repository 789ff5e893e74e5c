# SPDX-License-Identifier: MIT
"""The programs of demos/examples/python print what is written there, and find what the tools find that people use.

As a program this file measures both, by processor time: the table of docs/boxes-as-data.md.
"""
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "demos/examples/python"
sys.path.insert(0, str(EXAMPLES))

import board  # noqa: E402
import cad  # noqa: E402
import genomics  # noqa: E402
import gis  # noqa: E402
import simulation  # noqa: E402

EXPECTED = dict(line.split(": ", 1) for line in (EXAMPLES / "output.txt").read_text(encoding="utf-8").splitlines())


@pytest.mark.parametrize("name", ["gis", "cad", "board", "genomics", "simulation"])
def test_program_prints_what_is_written(name):
    run = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py")], capture_output=True, text=True, check=True)
    assert run.stdout.strip().replace("\n", "; ") == EXPECTED[name]


def sorted_rows(pairs):
    pairs = np.asarray(pairs, np.int64).reshape(-1, 2)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def by_shapely(buildings, circles):
    """STRtree of the buildings, asked for the box of each circle, and its exact distance."""
    geometry = pytest.importorskip("shapely.geometry", reason="Shapely (python3-shapely) is not installed")
    tree_module = pytest.importorskip("shapely.strtree")
    shapes = [geometry.box(*row) for row in buildings]
    tree = tree_module.STRtree(shapes)
    ask = getattr(tree, "query_items", None) or tree.query  # before Shapely 2 query gives geometries
    pairs = []
    for number, (x, y, radius) in enumerate(circles):
        centre = geometry.Point(x, y)
        asked = ask(geometry.box(x - radius, y - radius, x + radius, y + radius))
        pairs += [(which, number) for which in asked if centre.distance(shapes[which]) <= radius]
    return pairs


def by_rtree_of_layers(tracks, nets):
    """An index for each layer, asked for each track grown by the clearance."""
    index = pytest.importorskip("rtree", reason="Rtree (python3-rtree) is not installed").index
    clearance, pairs = board.CLEARANCE, []
    for layer in range(4):
        which = np.flatnonzero(tracks[:, 0] == layer)
        rows = tracks[which, 1:]
        tree = index.Index((int(i), tuple(map(float, row)), None) for i, row in zip(which, rows))
        grown = rows + np.array([-clearance, -clearance, clearance, clearance])
        for i, row in zip(which, grown):
            for j in tree.intersection(tuple(map(float, row))):
                if i < j and nets[i] != nets[j]:
                    a, b = tracks[i, 1:], tracks[j, 1:]
                    gap = np.maximum(0, np.maximum(a[:2] - b[2:], b[:2] - a[2:]))
                    if (gap**2).sum() < clearance**2:
                        pairs.append((i, j))
    return pairs


def by_bedtools(genes, reads):
    """bedtools intersect of two files; a name is a number of a row."""
    bedtools = shutil.which("bedtools")
    if bedtools is None:
        pytest.skip("bedtools is not installed")
    with tempfile.TemporaryDirectory() as folder:
        names = [pathlib.Path(folder) / name for name in ("genes.bed", "reads.bed")]
        for name, rows in zip(names, (genes, reads)):
            name.write_text("".join(f"chr{c}\t{s}\t{e}\t{i}\n" for i, (c, s, e) in enumerate(rows.tolist())))
        command = [bedtools, "intersect", "-wa", "-wb", "-a", str(names[0]), "-b", str(names[1])]
        lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return [(int(fields[3]), int(fields[7])) for fields in map(str.split, lines)]


def corners(centre, axes, half):
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return centre[:, None] + np.einsum("sk,nkd->nsd", signs, half[:, :, None] * axes)


def by_cgal(centre, axes, half):
    """CGAL's self_intersections of all bars as one mesh, by exact numbers; a pair of triangles says a pair of bars."""
    witness = os.environ.get("BOXSTREAM_CGAL_WITNESS")
    if not witness or not pathlib.Path(witness).is_file():
        pytest.skip("CGAL's witness (boxstream_cgal_witness) is not built")
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [(a, b, c) for q in quads for a, b, c in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    points = corners(centre, axes, half).reshape(-1, 3)
    lines = ["OFF", f"{len(points)} {len(centre) * 12} 0", *(" ".join(map(repr, row)) for row in points.tolist())]
    lines += [f"3 {8 * n + a} {8 * n + b} {8 * n + c}" for n in range(len(centre)) for a, b, c in triangles]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "bars.off"
        file.write_text("\n".join(lines) + "\n")
        run = subprocess.run([witness, "--list", str(file)], capture_output=True, text=True, check=True)
    faces = np.array([line.split() for line in run.stdout.splitlines()], np.int64).reshape(-1, 2) // 12
    return np.unique(np.sort(faces[faces[:, 0] != faces[:, 1]], axis=1), axis=0)


def by_kd_tree(centres, radii):
    """SciPy's tree of centres, asked for twice the largest radius."""
    tree = pytest.importorskip("scipy.spatial", reason="SciPy (python3-scipy) is not installed").cKDTree(centres)
    pairs = tree.query_pairs(2 * radii.max(), output_type="ndarray")
    i, j = pairs.T
    return pairs[np.linalg.norm(centres[i] - centres[j], axis=1) <= radii[i] + radii[j]]


# What it is called in tables, the program's module, its search, the tool and its answer.
PROGRAMS = [("buildings in circles of a map", gis.make, gis.find, "Shapely's `STRtree`", by_shapely),
            ("copper too close on a board", board.make, board.find, "Rtree", by_rtree_of_layers),
            ("reads of genes", genomics.make, genomics.find, "`bedtools intersect`", by_bedtools),
            ("bars that clash", cad.make, cad.find, "CGAL's `self_intersections`", by_cgal),
            ("grains that touch", simulation.make, simulation.contacts, "SciPy's `cKDTree`", by_kd_tree)]


@pytest.mark.parametrize("seed", [2, 3])
@pytest.mark.parametrize("make, find, answer", [(make, find, answer) for _, make, find, _, answer in PROGRAMS],
                         ids=[answer.__name__ for *_, answer in PROGRAMS])
def test_program_finds_what_the_tool_finds(make, find, answer, seed):
    data = make(3000, seed)
    pairs = sorted_rows(find(*data))
    assert len(pairs) > 50
    np.testing.assert_array_equal(pairs, sorted_rows(answer(*data)))


def test_a_simulation_goes_the_same_way_by_the_tool():
    ours, theirs = (simulation.make(500) for _ in range(2))
    for _ in range(5):
        overlaps = [simulation.step(*each, sorted_rows(find(*each)))
                    for each, find in ((ours, simulation.contacts), (theirs, by_kd_tree))]
        assert overlaps[0] == overlaps[1] > 0
    np.testing.assert_array_equal(ours[0], theirs[0])


def processor_time():
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def milliseconds(call, *data):
    begin = processor_time()
    call(*data)
    return 1000 * (processor_time() - begin)


def measure(count=20_000, rounds=5):
    print("| program | n | pairs | ours, ms | tool | its ms | ratio |\n|---|--:|--:|--:|---|--:|--:|")
    for title, make, find, tool, answer in PROGRAMS:
        data = make(count)
        pairs = len(find(*data))
        times = [(milliseconds(find, *data), milliseconds(answer, *data)) for _ in range(rounds)]
        ours, theirs = (statistics.median(column) for column in zip(*times))
        print(f"| {title} | {count} | {pairs} | {ours:.3g} | {tool} | {theirs:.4g} | {theirs / ours:.3g} |", flush=True)


if __name__ == "__main__":
    measure()
