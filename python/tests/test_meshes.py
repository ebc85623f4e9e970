"""Meshes between files, arrays and the library, and how long their memory lives."""

import gc

import numpy as np
import partwise as pw
import pytest
from program import NOTCH, same_bytes

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


class LikeTrimesh:
    vertices, faces = VERTICES, FACES


@pytest.mark.parametrize("given", [(VERTICES, FACES), [VERTICES.tolist(), FACES.tolist()], LikeTrimesh(),
                                   (np.asfortranarray(VERTICES), FACES[::-1][::-1]),
                                   (VERTICES.astype(np.float32), FACES.astype(np.uint8)),
                                   (VERTICES.astype(">f8"), FACES.astype(">i4"))])
def test_arrays_of_any_layout_are_meshes(given):
    assert pw.decompose(given).labels.tolist() == pw.decompose(pw.Mesh(VERTICES, FACES)).labels.tolist() == [0] * 4


def test_a_mesh_copies_its_arrays_and_cannot_be_changed():
    vertices = VERTICES.copy()
    mesh = pw.Mesh(vertices, FACES)
    vertices[0] = 9
    assert mesh.vertices.tolist() == VERTICES.tolist() and mesh.faces.dtype == np.int32
    with pytest.raises(ValueError):
        mesh.faces[0, 0] = 10**6
    with pytest.raises(ValueError):
        mesh.vertices.flags.writeable = True


def test_views_outlive_their_mesh():
    parts = pw.decompose((VERTICES, FACES))
    labels, hull = parts.labels, parts.hulls[0].vertices
    before = hull.copy(), labels.copy()
    del parts
    gc.collect()
    scratch = [np.full((4, 3), 7.0) for _ in range(1000)]
    assert (hull == before[0]).all() and (labels == before[1]).all(), len(scratch)


def test_views_are_no_copies():
    mesh = pw.Mesh(VERTICES, FACES)
    assert np.shares_memory(mesh.vertices, mesh.vertices)
    parts = pw.decompose(mesh)
    assert np.shares_memory(parts.labels, parts.labels) and parts.mesh is mesh


@pytest.mark.parametrize("ending", ["off", "obj", "ply"])
def test_files_keep_meshes_to_the_bit(tmp_path, ending):
    mesh = pw.read_mesh(NOTCH)
    file = tmp_path / f"a.{ending}"
    pw.write_mesh(file, mesh)
    again = pw.read_mesh(str(file))
    assert (again.vertices == mesh.vertices).all() and (again.faces == mesh.faces).all()
    pw.write_mesh(tmp_path / f"b.{ending}", (again.vertices, again.faces))
    same_bytes(tmp_path, f"a.{ending}", f"b.{ending}")


def test_labels_between_file_and_array(tmp_path):
    pw.write_labels(tmp_path / "a.seg", [3, 0, -1])
    assert pw.read_labels(tmp_path / "a.seg").tolist() == [3, 0, -1]
