"""Cages, deformed and repaired meshes, nets and points of the medial axis are the program's, to the byte."""

import json

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, NOTCH, run, same_bytes

MOVES = {"handles": [{"near": [0, 0, 0], "within": 1e3, "scale": [1, 1, 1.2]}, {"vertices": [0, 3], "move": [0, 0.1, 0]}]}


def test_cages_are_the_programs(tmp_path):
    report = run(tmp_path, "cage", CHAIR, "-o", "a.obj", "--max-faces", 200)
    cage = pw.make_cage(pw.read_mesh(CHAIR), max_faces=200)
    pw.write_mesh(tmp_path / "b.obj", cage.mesh)
    same_bytes(tmp_path, "a.obj", "b.obj")
    for name in ("parts", "radius", "expansion", "volume"):
        assert getattr(cage, name) == report[name], name


@pytest.mark.parametrize("coordinates", ["green", "mean-value"])
def test_deformed_meshes_are_the_programs(tmp_path, coordinates):
    mesh = pw.read_mesh(NOTCH)
    pw.write_mesh(tmp_path / "cage.off", pw.make_cage(mesh).mesh)
    (tmp_path / "moves.json").write_text(json.dumps(MOVES))
    run(tmp_path, "deform", NOTCH, "cage.off", "moves.json", "-o", "a.obj", "--coordinates", coordinates)
    cage = pw.read_mesh(tmp_path / "cage.off")
    moved = pw.read_cage_moves(tmp_path / "moves.json", cage)
    assert moved.shape == cage.vertices.shape
    deformed = pw.deform(mesh, cage, moved, coordinates=coordinates)
    pw.write_mesh(tmp_path / "b.obj", deformed)
    same_bytes(tmp_path, "a.obj", "b.obj")
    deformer = pw.CageDeformer(mesh.vertices, cage, coordinates)
    assert (deformer.deformed(moved) == deformed.vertices).all()


def test_weights_are_views_that_give_the_points_back():
    mesh = pw.read_mesh(NOTCH)
    cage = pw.make_cage(mesh).mesh
    deformer = pw.CageDeformer(mesh.vertices, cage, "mean-value")
    weights = deformer.vertex_weights
    del deformer
    assert weights.shape == (len(mesh.vertices), len(cage.vertices)) and not weights.flags.writeable
    assert np.allclose(weights @ cage.vertices, mesh.vertices) and np.allclose(weights.sum(axis=1), 1)
    green = pw.CageDeformer(mesh.vertices, cage)
    assert green.face_weights.shape == (len(mesh.vertices), len(cage.faces))
    assert np.allclose(green.deformed(cage.vertices + [1, 2, 3]), mesh.vertices + [1, 2, 3])


def test_repaired_meshes_are_the_programs(tmp_path):
    whole = pw.read_mesh(NOTCH)
    broken = pw.Mesh(whole.vertices, whole.faces[:-2])
    pw.write_mesh(tmp_path / "broken.off", broken)
    report = run(tmp_path, "repair", "broken.off", "-o", "a.obj", "--tolerance", 0.3, "--max-faces", 300, "--reference", NOTCH)
    repaired = pw.repair(broken, tolerance=0.3, max_faces=300)
    pw.write_mesh(tmp_path / "b.obj", repaired.mesh)
    same_bytes(tmp_path, "a.obj", "b.obj")
    for name in ("parts", "radius", "reach"):
        assert getattr(repaired, name) == report[name], name
    loss = pw.repair_loss(repaired.mesh, whole)
    for name in ("added", "lost", "volume_added", "volume_lost"):
        assert getattr(loss, name) == report[name], name


def test_nets_are_the_programs(tmp_path):
    report = run(tmp_path, "unfold", CHAIR, "-o", "a.svg", "--pdf", "a.pdf", "--scale", 2)
    parts = pw.decompose(pw.read_mesh(CHAIR), max_hull_vertices=32)
    unfoldings = [pw.unfold(hull) for hull in parts.hulls]
    for ending in ("svg", "pdf"):
        assert pw.write_nets(tmp_path / f"b.{ending}", unfoldings, scale=2) == (report["pages"], report["scale"])
        same_bytes(tmp_path, f"a.{ending}", f"b.{ending}")
    assert sum(map(len, unfoldings)) == report["nets"] and sum(each.overlaps for each in unfoldings) == 0
    for name in ("glued", "without_tab"):
        assert sum(getattr(each, name) for each in unfoldings) == report[name], name
    assert max(each.refolding_error for each in unfoldings) == report["refolding_error"]


def test_a_net_is_the_surface_in_the_plane():
    cube = pw.prisms([[[[0, 0], [1, 0], [1, 1], [0, 1]]]])[0]
    net = pw.unfold(cube)
    assert len(net) == 1 and sorted(net.faces) == list(range(12)) and (net.nets == 0).all()
    a, b, c = np.moveaxis(net.corners, 1, 0)
    assert ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum() == pytest.approx(2 * 6)
    inner = net.parents >= 0
    assert (net.parents[inner] < np.flatnonzero(inner)).all() and (net.folds[~inner] == -1).all()
    assert np.allclose(np.unique(net.angles[inner].round(9)), [0, np.pi / 2], atol=1e-8)
    numbers, times = np.unique(net.cuts[:, 2], return_counts=True)
    assert (times == 2).all() and len(numbers) == net.glued
    tabs = ~np.isnan(net.tabs).any(axis=(1, 2))
    assert tabs.sum() == net.glued - net.without_tab


def test_points_of_the_medial_axis_are_the_programs(tmp_path):
    run(tmp_path, "medial", CHAIR, "--points", "a.ply", "--spacing", 0.2, "--least-angle", 50)
    samples = pw.medial_samples(pw.read_mesh(CHAIR), spacing=0.2, least_angle=50)
    text = (tmp_path / "a.ply").read_text().split("end_header\n")[1]
    # The program writes the shortest digits that read back as the same numbers.
    written = [[float(word) for word in line.split()] for line in text.splitlines()]
    assert np.column_stack([samples.points, samples.radii]).tolist() == written
    assert len(samples) == len(written) > 100
