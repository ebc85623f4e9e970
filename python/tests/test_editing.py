"""Edits and normals off photos are the program's, to the byte; libtorch is there only once it is needed."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import partwise as pw
import pytest
from memory import expect_nothing_left
from program import CHAIR, run, same_bytes


def photo_and_mask():
    """A picture of a chair before white, and where it is, both 0 to 1."""
    seen = pw.render(pw.read_mesh(CHAIR), "red-plastic", size=(96, 96))
    shown = pw.tone_mapped(seen.image, seen.mask)
    shown[seen.mask == 0] = 1
    return np.clip(shown, 0, 1), seen.mask


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("edit")
    for name, image in zip(("photo.png", "mask.png"), photo_and_mask(), strict=True):
        pw.write_image(folder / name, image, shown=True)
    return folder


@pytest.mark.parametrize("light", [None, "venice"])
def test_edits_are_the_programs(folder, light):
    more = [] if light is None else ["--light", light]
    report = run(folder, "edit", "photo.png", "--material", "chrome", "-o", "a.png", *more)
    edit = pw.edit(folder / "photo.png", "chrome", light=light)
    pw.write_image(folder / "b.png", edit.image, shown=True)
    same_bytes(folder, "a.png", "b.png")
    assert edit.l2_reconstruction == report["l2_reconstruction"]
    assert edit.materials.shape == (1, 108) and edit.light.shape == (64, 128, 3)
    assert edit.normals.ndim == 3 and np.isfinite(edit.normals).all()


def test_arrays_are_photos(folder):
    """Of the same values as a file and its mask."""
    run(folder, "edit", "photo.png", "--mask", "mask.png", "--material", "chrome", "-o", "a.png")
    photo, mask = (np.rint(255 * each).astype(np.uint8) for each in photo_and_mask())
    edit = pw.edit(photo, pw.material("chrome"), masks=[mask])
    pw.write_image(folder / "b.png", edit.image, shown=True)
    same_bytes(folder, "a.png", "b.png")


def test_another_photo_gives_its_material(folder):
    run(folder, "edit", "photo.png", "--from", "photo.png", "-o", "a.png")
    pw.write_image(folder / "b.png", pw.edit(folder / "photo.png", other=folder / "photo.png").image, shown=True)
    same_bytes(folder, "a.png", "b.png")


@pytest.mark.parametrize("masked", [False, True])
def test_normals_are_the_programs(folder, masked):
    run(folder, "normals", "photo.png", "-o", "a.png", *(["--mask", "mask.png"] if masked else []))
    normals = pw.photo_normals(folder / "photo.png", mask=folder / "mask.png" if masked else None)
    pw.write_normals(folder / "b.png", normals)
    same_bytes(folder, "a.png", "b.png")
    lengths = np.linalg.norm(normals, axis=2)
    assert normals.shape == (96, 96, 3) and normals.dtype == np.float32
    assert ((np.abs(lengths - 1) < 1e-5) | (lengths == 0)).all() and 0 < lengths.mean() < 1


def test_normals_of_arrays_are_those_of_files(folder):
    photo, mask = (np.rint(255 * each).astype(np.uint8) for each in photo_and_mask())
    of_files = pw.photo_normals(folder / "photo.png", mask=folder / "mask.png")
    assert (pw.photo_normals(photo, mask=mask) == of_files).all()
    assert (pw.photo_normals(np.dstack([photo, mask])) == of_files).all()


def test_normals_of_scenes_are_the_programs(folder):
    run(folder, "normals", "photo.png", "--model", "scene", "-o", "a.png")
    normals = pw.scene_normals(folder / "photo.png")
    pw.write_normals(folder / "b.png", normals)
    same_bytes(folder, "a.png", "b.png")
    assert np.allclose(np.linalg.norm(normals, axis=2), 1, atol=1e-4)
    photo = np.rint(255 * photo_and_mask()[0]).astype(np.uint8)
    assert (pw.scene_normals(photo) == normals).all()


def test_calls_leave_nothing():
    """Fewer than elsewhere, as each reads the network; of a larger photo, one array of which would show."""
    photo = np.dstack([np.full((64, 64, 3), 0.5), np.pad(np.ones((32, 32)), 16)])
    expect_nothing_left(lambda: pw.photo_normals(photo), times=200)


WRONG = {
    "channels of normals": (lambda: pw.photo_normals(np.zeros((4, 4))), "photo: has 1 channels"),
    "channels of a scene": (lambda: pw.scene_normals(np.zeros((4, 4, 4))), "photo: has 4 channels"),
    "weights of a scene": (lambda: pw.scene_normals(np.zeros((4, 4, 3)), weights="nowhere.pt"), "nowhere.pt: "),
    "no object": (lambda: pw.photo_normals(np.zeros((4, 4, 3))), "photo: has no transparency"),
    "NaN": (lambda: pw.photo_normals(np.full((4, 4, 3), np.nan)), "photo[0]: holds nan"),
    "mask of normals": (lambda: pw.photo_normals(np.zeros((4, 4, 3)), mask=np.ones((3, 4))), "masks[0]: is 3 x 4 x 1"),
    "weights": (lambda: pw.photo_normals(np.zeros((4, 4, 3)), mask=np.ones((4, 4)), weights="nowhere.pt"), "nowhere.pt: "),
    "channels": (lambda: pw.edit(np.zeros((4, 4)), "chrome"), "photo: has 1 channels"),
    "no mask": (lambda: pw.edit(np.zeros((4, 4, 3)), "chrome"), "photo: has no transparency"),
    "values": (lambda: pw.edit(np.full((4, 4, 3), 7.0), "chrome"), "photo: holds 7"),
    "mask": (lambda: pw.edit(np.zeros((4, 4, 3)), "chrome", masks=[np.ones((3, 4))]), "masks[0]: is 3 x 4 x 1"),
    "dark mask": (lambda: pw.edit(np.zeros((4, 4, 3)), "chrome", masks=[np.zeros((4, 4))]), "masks: leave a region nothing"),
    "file": (lambda: pw.edit("nowhere.png", "chrome"), "nowhere.png: does not exist"),
}


@pytest.mark.parametrize("wrong, message", WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_said(wrong, message):
    with pytest.raises(pw.InputError) as raised:
        wrong()
    assert str(raised.value).startswith(message), raised.value


def test_libtorch_is_loaded_by_the_first_edit():
    code = ("import partwise as pw; maps = lambda: 'libtorch' in open('/proc/self/maps').read(); assert not maps();\n"
            "try: pw.edit('nowhere.png', 'chrome')\n"
            "except pw.InputError: assert maps()")
    assert subprocess.run([sys.executable, "-c", code], cwd=Path(__file__).parent).returncode == 0
