"""Paths are the program's, to the byte, of problems that were read and of the same that were put together."""

import json

import numpy as np
import partwise as pw
import pytest
from program import run


def rectangle(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


# Two halves of a wall with a gap of 1, and a block beyond; a point, and a van that has to turn.
WALLS = [rectangle(-10, -1, 1.5, 1), rectangle(2.5, -1, 10, 1), rectangle(-4, 5, 4, 6)]
VAN = rectangle(-1, -0.2, 1, 0.2)
BOUNDS = [[-10, -10], [10, 10]]
QUERIES = {"plane": [([-5, -5], [-3, 8]), ([5, -5], [8, 8])], "se2": [([-5, -5, 0], [-3, 8, 1.5])]}


def put_together(space):
    walls = [[ring] for ring in WALLS]
    obstacles = pw.City(walls) if space == "plane" else pw.prisms(walls)
    robot = [] if space == "plane" else pw.prisms([[VAN]])
    return pw.Problem(space, obstacles, robot, bounds=BOUNDS, queries=QUERIES[space])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("paths")
    for space, queries in QUERIES.items():
        problem = {"space": space, "obstacles": [{"polygon": ring} for ring in WALLS],
                   "robot": [] if space == "plane" else [{"polygon": VAN}],
                   "bounds": {"low": BOUNDS[0], "high": BOUNDS[1]},
                   "queries": [{"start": start, "goal": goal} for start, goal in queries]}
        (folder / f"{space}.json").write_text(json.dumps(problem))
    return folder


def rows(file):
    return [[float(word) for word in line.split()] for line in file.read_text().splitlines()]


def is_the_programs(path, report, file):
    assert np.column_stack([path.configurations, path.clearances]).tolist() == rows(file)
    for name in ("length", "clearance_min", "clearance_mean", "found_length", "found_clearance_min", "samples", "edges",
                 "obstacles"):
        assert getattr(path, name) == report[name], name
    assert len(path) == report["configurations"]


@pytest.mark.parametrize("space, planner, options", [("plane", "svma", {}), ("plane", "svma", {"raw": True}),
                                                     ("plane", "maprm", {}), ("plane", "umaprm", {}),
                                                     ("se2", "svma", {}), ("se2", "umaprm", {"tolerance": 0.1})])
def test_paths_are_the_programs(folder, space, planner, options):
    words = ["--raw"] if "raw" in options else [word for name, value in options.items() for word in ("--" + name, value)]
    report = run(folder, "plan", f"{space}.json", "--planner", planner, "--seed", 2, "--path", "a.txt", *words)
    read = pw.read_problem(folder / f"{space}.json")
    for problem in (read, put_together(space)):
        is_the_programs(pw.plan(problem, planner=planner, seed=2, **options), report, folder / "a.txt")


def test_problems_are_what_was_given(folder):
    for space in QUERIES:
        read, made = pw.read_problem(folder / f"{space}.json"), put_together(space)
        assert (read.name, made.name, read.space, made.space) == (space, "problem", space, space)
        assert read.bounds.tolist() == made.bounds.tolist() == BOUNDS
        for one, other in zip(read.robot + read.obstacles, made.robot + made.obstacles, strict=True):
            assert (one.vertices == other.vertices).all() and (one.faces == other.faces).all()
        assert np.array_equal(read.footprints, made.footprints)
        assert [[q.tolist() for q in query] for query in made.queries] == [list(map(list, query)) for query in QUERIES[space]]
    assert made.robot[0].vertices.min(axis=0).tolist() == [-1, -0.2, -0.5]


def test_queries_are_numbers_or_pairs(folder):
    problem = put_together("plane")
    run(folder, "plan", "plane.json", "--query", 2, "--path", "a.txt")
    for query in (1, np.int32(1), QUERIES["plane"][1], np.array(QUERIES["plane"][1])):
        path = pw.plan(problem, query)
        assert np.column_stack([path.configurations, path.clearances]).tolist() == rows(folder / "a.txt")


def test_a_path_keeps_away_all_along():
    path = pw.plan(put_together("plane"))
    assert path.configurations.dtype == np.float64 and path.configurations.shape == (len(path), 2)
    assert path.found.shape[1] == 2 and path.clearances.min() >= path.clearance_min / 1.01
    assert path.configurations[0].tolist() == [-5, -5] and path.configurations[-1].tolist() == [-3, 8]
    between = np.concatenate([np.linspace(a, b, 100) for a, b in zip(path.configurations, path.configurations[1:])])
    corners = np.array([[ring[0], ring[2]] for ring in WALLS], float)
    beyond = np.maximum(corners[:, None, 0] - between, between - corners[:, None, 1]).clip(0)
    least = np.linalg.norm(beyond, axis=2).min()
    assert least * 1.01 >= path.clearance_min >= 0.9 * path.found_clearance_min / 1.01 > 0
    assert np.linalg.norm(np.diff(path.configurations, axis=0), axis=1).sum() == pytest.approx(path.length)


def test_roadmaps_of_problems_are_the_programs(folder):
    report = run(folder, "roadmap", "se2.json", "--samples", 40, "--seed", 5, "--samples-out", "a.txt")
    roadmap = pw.roadmap(put_together("se2"), samples=40, seed=5)
    assert roadmap.samples.shape == (40, 3)
    assert np.hstack([roadmap.samples, roadmap.distances]).tolist() == rows(folder / "a.txt")
    assert len(roadmap.edges) == report["edges"]


def test_a_search_ends_with_its_time():
    with pytest.raises(pw.InputError, match="problem: svma found no path within 1e-06 s; raise time"):
        pw.plan(put_together("se2"), time=1e-6)
