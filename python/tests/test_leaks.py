"""A thousand calls of each kind leave the memory of the process where it was."""

import gc
from pathlib import Path

import numpy as np
import partwise as pw
import pytest
from program import NOTCH

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
SQUARE = [[[[0, 0], [1, 0], [1, 1], [0, 1]]]]
# Large arrays, so that a single one that is kept in every tenth call would show.
GRID = np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0), [0.0]), -1).reshape(-1, 3)
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
    "error": fail,
}
NOTCHED = pw.read_mesh(NOTCH)
LIGHT = np.ones((4, 8, 3), np.float32)
TOWN = pw.City([SQUARE[0], [[[x + 2, y] for x, y in SQUARE[0][0]]]])
STEEL = pw.material("steel")


def resident():
    """Bytes."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_a_thousand_calls_leave_nothing(call):
    for _ in range(100):
        call()
    before = resident()
    for _ in range(1000):
        call()
    grown = resident() - before
    assert grown < 2 << 20, f"{grown / 1000:.0f} bytes a call"
