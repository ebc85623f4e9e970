"""Parts of shapes in the plane are the program's."""

import json

import numpy as np
import partwise as pw
import pytest
from program import DATA, run

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]


def rings_of(file):
    """The polygons of a .geojson; its rings repeat their first corner."""
    features = json.loads(file.read_text())["features"]
    return [[ring[:-1] for ring in feature["geometry"]["coordinates"]] for feature in features]


@pytest.mark.parametrize("name", ["hole3.poly", "mammoth.poly"])
def test_parts_are_the_programs(tmp_path, name):
    report = run(tmp_path, "outline", DATA / "outlines" / name, "--tolerance", 0.05, "--parts", "a.geojson")
    outline = pw.decompose_outline(pw.read_shape(DATA / "outlines" / name), 0.05)
    assert [[ring.tolist() for ring in part] for part in outline.parts] == rings_of(tmp_path / "a.geojson")
    assert (outline.concavity, outline.radius, len(outline.cuts)) == (report["concavity"], report["radius"], report["cuts"])
    assert [hole[2] for hole in outline.holes] == [hole["concavity"] for hole in report["holes"]]


def area(ring):
    x, y = np.asarray(ring, float).T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def test_holes_and_directions():
    hole = [[1, 1], [3, 1], [3, 3], [1, 3]]
    outline = pw.decompose_outline([[SQUARE, hole]], 0.01)
    assert len(outline) > 1 and len(outline.holes) == 1
    assert sum(area(ring) for part in outline.parts for ring in part) == pytest.approx(12)
    assert outline.cut_parts.min() >= 0 and outline.cut_parts.max() < len(outline)
    assert outline.skeleton_edges.max() < len(outline.skeleton_nodes)


def test_shapes_that_cross_themselves_are_repaired_on_request():
    bow = [[[[0, 0], [2, 2], [2, 0], [0, 2]]]]
    with pytest.raises(pw.InputError):
        pw.decompose_outline(bow)
    assert len(pw.decompose_outline(pw.repaired_shape(bow))) == 2
