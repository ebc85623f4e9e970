"""Normals of a plane and of a ball, whose normals are known."""

import numpy as np
import partwise as pw
import pytest

FOCAL = 500.0


def rays(height, width):
    rows, columns = np.mgrid[:height, :width]
    return np.stack([(columns - (width - 1) / 2) / FOCAL, ((height - 1) / 2 - rows) / FOCAL, -np.ones((height, width))], -1)


def test_a_plane_is_exact():
    normal = np.array([0.3, -0.2, 0.9])
    normal /= np.linalg.norm(normal)
    depth = -2 * normal[2] / (rays(40, 60) @ normal)  # through (0, 0, -2)
    normals = pw.normals_from_depth(depth, FOCAL, noise=0)
    assert normals.shape == (40, 60, 3) and normals.dtype == np.float32
    assert np.abs(normals[5:-5, 5:-5] - normal).max() < 1e-4


def test_missing_depths_have_no_normal():
    depth = np.full((30, 30), 2.0)
    depth[:, 15:] = np.nan
    normals = pw.normals_from_depth(depth, FOCAL, (14.5, 14.5), noise=0)
    assert (normals[:, 15:] == 0).all() and np.allclose(normals[10:20, 2:10], [0, 0, 1], atol=1e-4)


def random_normals():
    normals = np.random.default_rng(1).normal(size=(5, 7, 3)).astype(np.float32)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    normals[0] = 0
    return normals


@pytest.mark.parametrize("name, bits, most", [("a.exr", 16, 1e-6), ("a.png", 16, 1e-4), ("a.png", 8, 2e-2)])
def test_normals_between_file_and_array(tmp_path, name, bits, most):
    normals = random_normals()
    pw.write_normals(tmp_path / name, normals, bits=bits)
    again = pw.read_normals(tmp_path / name)
    assert again.dtype == np.float32 and np.abs(again - normals).max() < most and (again[0] == 0).all()
