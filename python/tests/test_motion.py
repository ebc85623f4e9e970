"""Samples of the medial axis are the program's, and the graph is a graph."""

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, TOWN, run


def two_squares():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    return pw.City([[square], [square + [2, 0]]])


def lines(file):
    return [[float(word) for word in line.split()] for line in file.read_text().splitlines()]


@pytest.mark.parametrize("method", ["svma", "maprm-exact"])
def test_samples_in_a_city_are_the_programs(tmp_path, method):
    report = run(tmp_path, "roadmap", TOWN, "--limit", 12, "--samples", 60, "--method", method, "--seed", 3,
                 "--samples-out", "a.txt")
    city = pw.read_city(TOWN, limit=12)
    roadmap = pw.roadmap(city, samples=60, method=method, seed=3)
    assert np.hstack([roadmap.samples, roadmap.distances]).tolist() == lines(tmp_path / "a.txt")
    for name in ("on_axis", "components", "obstacles"):
        assert getattr(roadmap, name) == report[name], name
    assert len(roadmap.edges) == report["edges"] == len(roadmap.between)


def test_samples_in_a_mesh_are_the_programs(tmp_path):
    report = run(tmp_path, "roadmap", CHAIR, "--samples", 20, "--tolerance", 0.1, "--samples-out", "a.txt")
    roadmap = pw.roadmap(pw.read_mesh(CHAIR), samples=20, tolerance=0.1)
    assert roadmap.samples.shape[1] == 3
    assert np.hstack([roadmap.samples, roadmap.distances]).tolist() == lines(tmp_path / "a.txt")
    assert len(roadmap.edges) == report["edges"]


def test_between_two_squares_the_axis_is_half_way():
    city = two_squares()
    assert len(city) == 2 and len(city.footprints[1][0]) == 4
    roadmap = pw.roadmap(city, samples=30)
    first, second = roadmap.distances.T
    assert roadmap.on_axis == 1 and (second <= 1.02 * first).all()
    between = (roadmap.samples[:, 1] > 0) & (roadmap.samples[:, 1] < 1)
    assert between.any() and np.allclose(roadmap.samples[between, 0], 1.5, atol=0.02)
    assert (roadmap.edges[:, 0] < roadmap.edges[:, 1]).all() and roadmap.edges.max() < len(roadmap)
    assert all(bends.shape[1] == 2 for bends in roadmap.between)
