"""A thousand calls of each kind leave the memory of the process where it was."""

import tempfile
from pathlib import Path

import numpy as np
import partwise as pw
import pytest
from memory import expect_nothing_left
from program import NOTCH

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
SQUARE = [[[[0, 0], [1, 0], [1, 1], [0, 1]]]]
# Large arrays, so that a single one that is kept in every tenth call would show.
GRID = np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0), [0.0]), -1).reshape(-1, 3)
CLOUD = 0.1 + 0.005 * GRID
STRIPS = np.array([[i, i + 1, i + 40] for i in range(1560) if i % 40 < 39])
IMAGE = np.linspace(0, 1, 100 * 100 * 3, dtype=np.float32).reshape(100, 100, 3)


def fail():
    with pytest.raises(pw.InputError):
        pw.decompose((np.full((2000, 3), np.nan), FACES))


CALLS = {
    "meshes": lambda: pw.Mesh(GRID, STRIPS).vertices.sum(),
    "decompose": lambda: pw.decompose(NOTCHED, 0.05, measure="valley").hulls[0].vertices,
    "feature": lambda: pw.feature((VERTICES, FACES), "cvf"),
    "segment": lambda: pw.segment((VERTICES, FACES), "cvf", borders="plain"),
    "outline": lambda: pw.decompose_outline(SQUARE, 0.1).parts,
    "image": lambda: pw.tone_mapped(IMAGE, IMAGE[:, :, 0]),
    "material": lambda: pw.material("chrome").evaluate(np.tile([0.0, 0.0, 1.0], (3000, 1)), [0, 0, 1]),
    "ball": lambda: pw.material_ball(STEEL, light=LIGHT, size=4),
    "render": lambda: pw.render((VERTICES, FACES), STEEL, light=LIGHT, size=(8, 8), samples=1, exact=True).image,
    "roadmap": lambda: pw.roadmap(TOWN, samples=3).between,
    "normals": lambda: pw.normals_from_depth(IMAGE[:40, :40, 0] + 1, 500),
    "normals in files": lambda: pw.read_normals(FOLDER / "a.png"),
    "medial": lambda: pw.medial_samples((VERTICES, FACES), spacing=1).points,
    "cage": lambda: pw.make_cage((VERTICES, FACES), tolerance=0.9, expansion=1, max_faces=20).mesh.vertices,
    "deform": lambda: pw.CageDeformer(CLOUD, (VERTICES, FACES)).deformed(VERTICES + 1).sum(),
    "weights": lambda: DEFORMER.vertex_weights.sum(),
    "repair": lambda: pw.repair((VERTICES, FACES), tolerance=1, max_faces=100).mesh.faces,
    "unfold": lambda: pw.unfold((VERTICES, FACES)).corners,
    "nets": lambda: pw.write_nets(FOLDER / "a.svg", [NET]),
    "index": lambda: pw.index_parts((VERTICES, FACES)).histograms.sum(),
    "similar": lambda: pw.similar_parts(INDEX, 0, [INDEX] * 10),
    "problem": lambda: pw.Problem("se3", [(GRID, STRIPS)], [(VERTICES, FACES)]).obstacles[0].vertices,
    "plan": lambda: pw.plan(PROBLEM, planner="umaprm").configurations,
    "error": fail,
}
NOTCHED = pw.read_mesh(NOTCH)
LIGHT = np.ones((4, 8, 3), np.float32)
TOWN = pw.City([SQUARE[0], [[[x + 2, y] for x, y in SQUARE[0][0]]]])
STEEL = pw.material("steel")
SCRATCH = tempfile.TemporaryDirectory()
FOLDER = Path(SCRATCH.name)
pw.write_normals(FOLDER / "a.png", 2 * IMAGE[:60] - 1)
DEFORMER = pw.CageDeformer(CLOUD, (VERTICES, FACES))
NET = pw.unfold((VERTICES, FACES))
INDEX = pw.index_parts((VERTICES, FACES))
PROBLEM = pw.Problem("plane", TOWN, queries=[([-0.1, -0.1], [3.1, 1.1])])


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_a_thousand_calls_leave_nothing(call):
    expect_nothing_left(call)
