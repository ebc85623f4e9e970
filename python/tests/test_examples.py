"""The worked examples do what they say; docs/python.md quotes them as they are."""

import importlib.util
import subprocess
import sys

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, REPOSITORY, TOWN

EXAMPLES = REPOSITORY / "examples" / "python"


def example(name, *arguments):
    done = subprocess.run([sys.executable, EXAMPLES / name, *arguments], capture_output=True, text=True, timeout=500)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_decompose(tmp_path):
    said = example("decompose.py", CHAIR, tmp_path / "hulls.obj", tmp_path / "parts.png")
    parts = int(said.split()[0])
    assert parts > 1 and (tmp_path / "hulls.obj").read_text().count("\no part_") + 1 >= parts
    assert pw.read_image(tmp_path / "parts.png").shape == (480, 640, 3)


@pytest.mark.skipif(importlib.util.find_spec("partwise._editing") is None, reason="built without libtorch")
def test_edit_photo(tmp_path):
    seen = pw.render(pw.read_mesh(CHAIR), "red-plastic", size=(96, 96))
    pw.write_image(tmp_path / "photo.png", np.where(seen.mask[..., None] > 0, pw.tone_mapped(seen.image, seen.mask), 1),
                   shown=True)
    assert "differs from the photo" in example("edit_photo.py", tmp_path / "photo.png", tmp_path / "edited.png")
    assert pw.read_image(tmp_path / "edited.png").shape == (96, 96, 3)


def test_streets(tmp_path):
    assert "between 40 buildings" in example("streets.py", TOWN, tmp_path / "streets.txt")
    assert np.loadtxt(tmp_path / "streets.txt").shape == (400, 3)


def test_plan_path(tmp_path):
    said = example("plan_path.py", TOWN, tmp_path / "way.txt")
    assert float(said.split("nearer than ")[1].split()[0]) > 0
    way = np.loadtxt(tmp_path / "way.txt")
    assert way.shape[1] == 3 and len(way) == int(said.split(" m and ")[1].split()[0]) + 2


def test_the_page_plans_a_path():
    page = (REPOSITORY / "docs" / "python.md").read_text()
    names = {"pw": pw, "np": np}
    exec(page.split("## Paths\n\n```python\n")[1].split("```")[0], names)
    assert names["path"].clearance_min > 0.1


def test_the_page_quotes_the_first_example():
    source = (EXAMPLES / "decompose.py").read_text()
    quoted = source[source.index("mesh ="):]
    assert quoted in (REPOSITORY / "docs" / "python.md").read_text()
