"""Labels, hulls, features and segmentations are those of the program, to the byte."""

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, run, same_bytes


@pytest.mark.parametrize("options", [{}, {"measure": "valley", "max_hull_vertices": 20}, {"max_hulls": 3}])
def test_decompose_is_the_programs(tmp_path, options):
    words = [word for name, value in options.items() for word in ("--" + name.replace("_", "-"), value)]
    report = run(tmp_path, "decompose", CHAIR, "--tolerance", 0.1, "--labels", "a.seg", "--hulls", "a.obj", *words)
    parts = pw.decompose(pw.read_mesh(CHAIR), tolerance=0.1, **options)
    pw.write_labels(tmp_path / "b.seg", parts.labels)
    pw.write_meshes(tmp_path / "b.obj", parts.hulls)
    same_bytes(tmp_path, "a.seg", "b.seg")
    same_bytes(tmp_path, "a.obj", "b.obj")
    for name in ("concavity", "tolerance", "radius", "watertight", "cut_inside"):
        assert getattr(parts, name) == report[name], name
    assert len(parts) == len(parts.hulls) == report["parts"]


def test_parts_are_what_their_arrays_say():
    mesh = pw.read_mesh(CHAIR)
    parts = pw.decompose(mesh)
    assert parts.labels.dtype == np.int32 and parts.labels.shape == (len(mesh.faces),)
    assert parts.mesh_labels.shape == (len(parts.mesh.faces),)
    assert set(parts.mesh_labels) == set(range(len(parts)))
    for number, hull in enumerate(parts.hulls):
        inside = parts.mesh.vertices[np.unique(parts.mesh.faces[parts.mesh_labels == number])]
        a, b, c = (hull.vertices[hull.faces[:, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        outside = (np.einsum("pk,fk->pf", inside, normals) - np.einsum("fk,fk->f", a, normals)).max()
        assert outside < 1e-9 * parts.radius, f"part {number} leaves its hull by {outside}"


@pytest.mark.parametrize("kind", ["cvf", "cvf-avg", "sdf"])
def test_features_are_the_programs(tmp_path, kind):
    run(tmp_path, "feature", CHAIR, "--kind", kind, "--values", "a.txt")
    values = pw.feature(pw.read_mesh(CHAIR), kind)
    # The program writes the shortest digits that read back as the same numbers.
    assert [float(line) for line in (tmp_path / "a.txt").read_text().split()] == values.tolist()


@pytest.mark.parametrize("options", [{}, {"clusters": 3, "smoothness": 20.0}])
def test_segmentations_are_the_programs(tmp_path, options):
    words = [word for name, value in options.items() for word in ("--" + name, value)]
    report = run(tmp_path, "segment", CHAIR, "--feature", "cvf-avg", "--labels", "a.seg", *words)
    segments = pw.segment(pw.read_mesh(CHAIR), "cvf-avg", **options)
    pw.write_labels(tmp_path / "b.seg", segments.labels)
    same_bytes(tmp_path, "a.seg", "b.seg")
    assert len(segments) == report["parts"] == len(set(segments.labels))
    assert segments.borders == report["borders"]
