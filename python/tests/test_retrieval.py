"""Parts like a given one are those that the program finds."""

import shutil

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, DATA, NOTCH, run


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A database of three meshes and a file that is none."""
    folder = tmp_path_factory.mktemp("retrieval")
    (folder / "meshes").mkdir()
    for file in (CHAIR, NOTCH, DATA / "models" / "table.obj"):
        shutil.copy(file, folder / "meshes")
    (folder / "meshes" / "broken.off").write_text("OFF\n1")
    return folder


def test_matches_are_the_programs(folder):
    report = run(folder, "retrieve", CHAIR, 1, folder / "meshes", "--top", 5, "--index", "a")
    database = pw.open_part_database(folder / "meshes", cache=folder / "b")
    assert database.files == ["chair.off", "notch.obj", "table.obj"]
    assert len(database) == report["meshes"] == database.indexed == 3
    assert [{"file": file, "reason": reason} for file, reason in database.skipped] == report["skipped"]
    query = pw.index_parts(pw.read_mesh(CHAIR))
    found = pw.similar_parts(query, 1, database.indices, 5)
    faces = [np.bincount(index.labels) for index in database.indices]
    assert report["matches"] == [
        {"file": database.files[mesh], "part": part, "similarity": similarity, "faces": faces[mesh][part]}
        for mesh, part, similarity in found]
    for name in database.files:
        assert (folder / "a" / f"{name}.parts.json").read_bytes() == (folder / "b" / f"{name}.parts.json").read_bytes()
    assert pw.open_part_database(folder / "meshes", cache=folder / "b").indexed == 0


def test_similarity_is_of_parts():
    chair, notch = (pw.index_parts(pw.read_mesh(file)) for file in (CHAIR, NOTCH))
    assert pw.part_similarity(chair, 1, chair, 1) == 1
    there = pw.part_similarity(chair, 1, notch, 0)
    assert 0 < there < 1 and there == pytest.approx(pw.part_similarity(notch, 0, chair, 1))
    best = pw.similar_parts(chair, 1, [notch, chair], count=1)
    assert best == [(1, 1, 1.0)]


def test_an_index_is_of_arrays():
    mesh = pw.read_mesh(CHAIR)
    index = pw.index_parts(mesh)
    assert (index.labels == pw.segment(mesh).labels).all() and len(index) == index.labels.max() + 1
    assert index.parents[-1] == -1 and (index.parents[:-1] > np.arange(len(index.parents) - 1)).all()
    assert index.histograms.shape == (len(index.parents), 288) and index.histograms[-1].sum() == pytest.approx(1)
    labels = index.labels
    del index
    assert labels.dtype == np.int32 and not labels.flags.writeable and labels.max() > 0
