"""Edits are the program's, to the byte; libtorch is there only once something is edited."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, run, same_bytes


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A picture of a chair before white, and its mask."""
    folder = tmp_path_factory.mktemp("edit")
    seen = pw.render(pw.read_mesh(CHAIR), "red-plastic", size=(96, 96))
    shown = pw.tone_mapped(seen.image, seen.mask)
    shown[seen.mask == 0] = 1
    pw.write_image(folder / "photo.png", shown, shown=True)
    pw.write_image(folder / "mask.png", seen.mask, shown=True)
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
    mask = np.rint(255 * pw.render(pw.read_mesh(CHAIR), "red-plastic", size=(96, 96)).mask).astype(np.uint8)
    run(folder, "edit", "photo.png", "--mask", "mask.png", "--material", "chrome", "-o", "a.png")
    seen = pw.render(pw.read_mesh(CHAIR), "red-plastic", size=(96, 96))
    shown = pw.tone_mapped(seen.image, seen.mask)
    shown[seen.mask == 0] = 1
    photo = np.rint(255 * np.clip(shown, 0, 1)).astype(np.uint8)
    edit = pw.edit(photo, pw.material("chrome"), masks=[mask])
    pw.write_image(folder / "b.png", edit.image, shown=True)
    same_bytes(folder, "a.png", "b.png")


def test_another_photo_gives_its_material(folder):
    run(folder, "edit", "photo.png", "--from", "photo.png", "-o", "a.png")
    pw.write_image(folder / "b.png", pw.edit(folder / "photo.png", other=folder / "photo.png").image, shown=True)
    same_bytes(folder, "a.png", "b.png")


WRONG = {
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
