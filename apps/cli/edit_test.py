#!/usr/bin/env python3
"""partwise edit with networks that have learnt next to nothing: what is written, where it changes the photo, and what is
refused. edit_test.py PARTWISE"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import cli_test

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import load_shards  # noqa: E402

PROGRAM = Path(sys.argv[1]).resolve()
REPOSITORY = Path(__file__).resolve().parents[2]
MODELS = REPOSITORY / "data" / "models"


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=cwd)


class Edit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        folder = cls.folder = Path(cls.shared.name)
        (folder / "views.json").write_text(json.dumps({
            "shapes": [str(MODELS / "chair.off")], "materials": "training", "lights": ["studio"], "light_size": [16, 8],
            "map_size": 8, "format": "png", "views": 1, "images": 2}))
        (folder / "train.json").write_text(json.dumps({
            "network": "editing", "views": ["views"], "materials": ["pvc", "nylon"], "lights": ["studio"], "batch": 2, "group": 2,
            "map_size": 16, "stages": [{"steps": 2, "pixel": 0}], "validate_every": 2, "validation_batches": 1}))
        for arguments in (["dataset", "views.json", "-o", "views"], ["train", "train.json", "-o", "net"]):
            done = run(*arguments, "--quiet", cwd=folder)
            assert done.returncode == 0, done.stderr
        for key, files in load_shards.images(folder / "views"):
            (folder / f"{key}.png").write_bytes(files["image.png"])
            (folder / f"{key}.mask.png").write_bytes(files["mask.png"])
            (folder / f"{key}.part.png").write_bytes(files["part.png"])

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def edit(self, *arguments):
        return run("edit", *arguments, "--weights", "net/best.pt", cwd=self.folder)

    def pixels(self, name):
        width, height, depth, colour, rows = cli_test.png_rows((self.folder / name).read_bytes())
        channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour] * depth // 8
        return [[row[channels * x:channels * (x + 1)] for x in range(width)] for row in rows]

    def test_changes_the_object_and_nothing_else(self):
        done = self.edit("00000000.png", "--mask", "00000000.mask.png", "--material", "chrome", "-o", "a.png", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertGreater(report["l2_reconstruction"], 0)
        before, after, mask = (self.pixels(name) for name in ("00000000.png", "a.png", "00000000.mask.png"))
        changed = 0
        for old_row, new_row, mask_row in zip(before, after, mask, strict=True):
            for old, new, covered in zip(old_row, new_row, mask_row, strict=True):
                if covered[0] == 0:
                    self.assertEqual(old[:3], new[:3])
                changed += old[:3] != new[:3]
        self.assertGreater(changed, 1000)

    def test_refinement_comes_nearer_and_layers_are_written(self):
        done = self.edit("00000000.png", "--mask", "00000000.mask.png", "--material", "nylon", "-o", "b.png", "--refine", "--layers", "layers",
                         "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertLess(report["l2_reconstruction"], report["l2_before_refinement"] / 2)
        self.assertEqual(sorted(path.name for path in (self.folder / "layers").iterdir()),
                         ["ball.png", "light.exr", "material.json", "normals.png", "picture.png", "rendered.png"])

    def test_material_of_another_photo_and_another_light(self):
        masks = ["--mask", "00000000.mask.png", "--from-mask", "00000001.mask.png"]
        done = self.edit("00000000.png", *masks, "--from", "00000001.png", "-o", "c.png", "--light", "park")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "c.png").is_file())

    def test_networks_that_ship_give_the_other_materials_colour(self):
        scene = json.loads((REPOSITORY / "examples" / "photo.json").read_text()) | {"size": [128, 128]}
        for material in ("red-specular-plastic", "blue-rubber"):
            scene["meshes"][0]["material"] = material
            (self.folder / "scene.json").write_text(json.dumps(scene))
            done = run("render", "scene.json", "--folder", REPOSITORY / "examples", "--png", f"{material}.png", "--mask", "mask.png", "--quiet",
                       cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = run("edit", "red-specular-plastic.png", "--material", "blue-rubber", "-o", "blue.png", "--quiet", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

        def tint(name):  # mean colour of the object, however bright: renderings are exposed each by itself
            pixels, mask = (sum(self.pixels(each), []) for each in (name, "mask.png"))
            sums = [sum(pixel[c] for pixel, covered in zip(pixels, mask, strict=True) if covered[0] == 255) for c in range(3)]
            return [each / sum(sums) for each in sums]

        def difference(name):
            return max(abs(a - b) for a, b in zip(tint(name), tint("blue-rubber.png"), strict=True))

        self.assertLess(difference("blue.png"), difference("red-specular-plastic.png") / 3)

    def test_what_is_refused(self):
        whole = (self.folder / "net/best.pt").read_bytes()
        (self.folder / "cut.pt").write_bytes(whole[:len(whole) // 2])
        (self.folder / "text.png").write_text("no picture")
        photo, mask = "00000000.png", ["--mask", "00000000.mask.png"]
        cases = [([photo, *mask, "--material", "granite", "-o", "d.png"], 1, "granite"),
                 (["none.png", "--material", "nylon", "-o", "d.png"], 1, "none.png"),
                 (["text.png", "--material", "nylon", "-o", "d.png"], 1, "text.png"),
                 ([photo, "--mask", "none.png", "--material", "nylon", "-o", "d.png"], 1, "none.png"),
                 ([photo, *mask, "--material", "nylon", "--material", "pvc", "-o", "d.png"], 1, "regions"),
                 ([photo, *mask, "--material", "nylon", "-o", "nowhere/d.png"], 1, "nowhere"),
                 ([photo, *mask, "--material", "nylon", "-o", "d.jpg"], 2, ".png"),
                 ([photo, *mask, "--material", "nylon", "-o", photo], 2, "same file"),
                 ([photo, *mask, "--material", "nylon"], 2, "-o"),
                 ([photo, *mask, "-o", "d.png"], 2, "--material"),
                 ([photo, "--material", "nylon", "--from", photo, "-o", "d.png"], 2, "--from")]
        for arguments, status, word in cases:
            done = self.edit(*arguments)
            self.assertEqual(done.returncode, status, (arguments, done.stderr))
            self.assertIn(word, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for weights in ("cut.pt", "text.png", "none.pt", "net/checkpoint.pt"):
            done = run("edit", photo, *mask, "--material", "nylon", "-o", "d.png", "--weights", weights, cwd=self.folder)
            self.assertEqual(done.returncode, 1, weights)
            self.assertIn(weights, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "d.png").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
