"""The verb dataset: what shards hold, that they are the same whoever makes them and however often it is stopped, and what is
refused.

    dataset_test.py PROGRAM
"""

import json
import os
import signal
import struct
import subprocess
import sys
import time
import unittest

import cli_test

sys.path.insert(0, str(cli_test.NOTCH.parent))
import load_shards  # noqa: E402

RANKS = ("RANK", "OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID", "JOB_COMPLETION_INDEX")


class Dataset(cli_test.CommandLine):
    """Two triangles apart, and the notched cube."""

    def setUp(self):
        super().setUp()
        (self.folder / "two.off").write_text("OFF\n6 2 0\n-1 0 0\n1 0 0\n0 1 0\n-1 2 0\n1 2 0\n0 4 1\n3 0 1 2\n3 3 4 5\n")
        (self.folder / "notch.obj").write_bytes(cli_test.NOTCH.read_bytes())
        self.alone = {name: value for name, value in os.environ.items() if name not in RANKS}

    def config(self, **changes):
        config = {"shapes": ["*.off", "notch.obj"], "materials": ["chrome", "blue-fabric", "gold-paint"], "lights": ["sky", "studio"],
                  "size": [24, 20], "light_size": [16, 8], "views": 2, "viewpoints": 4, "images": 11, "images_per_shard": 4}
        config.update(changes)
        (self.folder / "config.json").write_text(json.dumps({k: v for k, v in config.items() if v is not None}))

    def make(self, output, *arguments, environment=None):
        return self.run_program("dataset", "config.json", "-o", output, *arguments, env=self.alone | (environment or {}))

    def shards(self, output):
        return {path.name: path.read_bytes() for path in (self.folder / output).glob("*.tar")}

    def test_shards_hold_what_is_promised(self):
        self.config()
        result = self.make("out", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["images"], report["shards"], report["skipped"]), (11, 3, 0))
        self.assertGreater(report["images_per_second"], 0)
        images = list(load_shards.images(self.folder / "out"))
        self.assertEqual([key for key, _ in images], [f"{i:08d}" for i in range(11)])
        worn = set()
        for _, files in images:
            self.assertEqual(sorted(files), ["image.exr", "json", "mask.png", "normal.png", "part.png"])
            width, height, *kind, rows = cli_test.png_rows(files["part.png"])
            self.assertEqual(kind, [16, 0])
            parts = {part for row in rows for part in struct.unpack(f">{width}H", row)}
            mesh = json.loads(files["json"])["meshes"][0]
            self.assertEqual((width, height), (24, 20))
            self.assertIn(0, parts, "some background")
            self.assertLessEqual(max(parts), len(mesh["material"]))
            self.assertGreater(max(parts), 0)
            self.assertEqual(len(mesh["material"]), 2 if mesh["file"] == "two.off" else 1)
            self.assertEqual(len(set(mesh["material"])), len(mesh["material"]), "parts differ")
            worn.update(mesh["material"])
        self.assertEqual(worn, {"chrome", "blue-fabric", "gold-paint"})

    def test_an_image_is_rendered_again_from_its_scene(self):
        self.config(format="png")
        self.assert_done(self.make("out", "--quiet"))
        for key, files in list(load_shards.images(self.folder / "out"))[:5]:
            (self.folder / "out" / "scene.json").write_bytes(files["json"])
            self.assertEqual(self.run_program("render", "out/scene.json", "--folder", ".", "--png", "a.png", "--normals", "n.png", "--mask", "m.png",
                                              "--parts", "p.png", "--quiet").returncode, 0)
            for ours, theirs in (("a", "image"), ("n", "normal"), ("m", "mask"), ("p", "part")):
                self.assertEqual((self.folder / f"{ours}.png").read_bytes(), files[f"{theirs}.png"], f"{theirs} of {key}")

    def test_parts_come_from_files_too(self):
        """A tetrahedron whose sides are two and two, and its image rendered again from its scene."""
        (self.folder / "four.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        (self.folder / "four.seg").write_text("7\n7\n0\n0\n")
        labelled = {"shapes": [{"mesh": "four.off", "labels": "four.seg"}], "parts": "labels"}
        self.config(**labelled, format="png")
        result = self.make("out", "--json", "-")
        self.assert_done(result)
        self.assertEqual({name for name in json.loads(result.stdout)["reads"] if "four" in name}, {"four.off", "four.seg"})
        _, files = next(load_shards.images(self.folder / "out"))
        self.assertEqual(len(json.loads(files["json"])["meshes"][0]["material"]), 2)
        (self.folder / "out" / "scene.json").write_bytes(files["json"])
        self.assertEqual(self.run_program("render", "out/scene.json", "--folder", ".", "--png", "a.png", "--quiet").returncode, 0)
        self.assertEqual((self.folder / "a.png").read_bytes(), files["image.png"])
        (self.folder / "four.seg").write_text("7\n7\n0\n")
        self.assert_refused(self.make("short"), 1, "four.seg: has 3 labels", "4 faces")
        for changes, words in (({"shapes": ["four.off"], "parts": "labels"}, ["parts are labels", "four.off"]),
                               ({**labelled, "parts": "whole"}, ["parts are not labels", "four.off"]),
                               ({"shapes": [{"mesh": "four.off"}]}, ["shapes[0].labels is missing"]),
                               ({"shapes": [{"mesh": "four.off", "labels": "gone.seg"}]}, ["shapes[0].labels", "gone.seg"])):
            self.config(**changes)
            self.assert_refused(self.make("bad", "--quiet"), 1, "config.json", *words)

    def test_ranks_are_those_of_the_environment(self):
        self.config()
        self.assert_done(self.make("one", "--quiet"))
        for rank in (1, 0):
            environment = {"SLURM_PROCID": str(rank), "SLURM_NTASKS": "2"}
            result = self.make("ranks", "--json", "-", environment=environment)
            self.assert_done(result)
            self.assertEqual(json.loads(result.stdout)["shards"], 2 - rank)
        self.assertEqual(len(self.shards("one")), 3)
        self.assertEqual(self.shards("one"), self.shards("ranks"))

    def test_killed_and_gone_on_with(self):
        self.config(images=120, size=[96, 96], images_per_shard=10)
        process = subprocess.Popen([cli_test.PROGRAM, "dataset", "config.json", "-o", "out", "--quiet"], cwd=self.folder,
                                   env=self.alone)
        deadline = time.monotonic() + 60
        while not self.shards("out") and time.monotonic() < deadline:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
        finished = len(self.shards("out"))
        self.assertGreater(finished, 0)
        result = self.make("out", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["skipped"], report["shards"], report["images"]), (finished, 12 - finished, 120 - 10 * finished))
        self.assert_done(self.make("whole", "--quiet"))
        self.assertEqual(self.shards("out"), self.shards("whole"))
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         sorted(p.name for p in (self.folder / "whole").iterdir()))

    def test_nothing_is_made_twice_or_mixed(self):
        self.config()
        self.assert_done(self.make("out", "--quiet"))
        before = self.shards("out")
        again = json.loads(self.make("out", "--json", "-").stdout)
        self.assertEqual((again["images"], again["skipped"]), (0, 3))
        self.config(seed=2)
        self.assert_refused(self.make("out"), 1, "out", "another")
        self.assertEqual(self.shards("out"), before)
        self.assert_done(self.make("second", "--quiet"))
        self.assertNotEqual(self.shards("second"), before)

    def test_what_is_wrong_is_named(self):
        (self.folder / "no.sh3f").write_text("not a zip archive")
        (self.folder / "cut.hdr").write_text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n")
        for changes, words in (
            ({"shapes": None}, ["shapes"]),
            ({"shapes": []}, ["shapes"]),
            ({"shapes": ["gone.off"]}, ["shapes[0]", "gone.off"]),
            ({"shapes": ["*.ply"]}, ["shapes[0]", "matches no file"]),
            ({"shapes": ["no.sh3f"]}, ["no.sh3f"]),
            ({"shapes": ["two.off"], "parts": "materials"}, ["two.off"]),
            ({"shapes": ["notch.obj"], "parts": "materials"}, ["notch.obj"]),
            ({"parts": "by hand"}, ["parts", "corise"]),
            ({"groups": 0}, ["groups"]),
            ({"materials": ["unobtainium"]}, ["materials", "unobtainium", "partwise material list"]),
            ({"lights": ["moon"]}, ["lights", "moon", "studio"]),
            ({"lights": ["cut.hdr"]}, ["cut.hdr"]),
            ({"light_size": [0, 8]}, ["light_size"]),
            ({"size": [24]}, ["size"]),
            ({"images": 0}, ["images"]),
            ({"images": None}, ["images"]),
            ({"views": 9}, ["views", "viewpoints"]),
            ({"colour": "red"}, ["colour"]),
        ):
            with self.subTest(changes):
                self.config(**changes)
                self.assert_refused(self.make("out", "--quiet"), 1, *words)
                self.assertEqual(self.shards("out"), {})
        self.config()
        self.assert_refused(self.make("two.off"), 1, "two.off")
        self.assert_refused(self.make("out", environment={"RANK": "2", "WORLD_SIZE": "2"}), 1, "RANK")
        self.assert_refused(self.run_program("dataset", "config.json"), 1, "config.json", "output")
        (self.folder / "config.json").write_text("{")
        self.assert_refused(self.make("out"), 1, "config.json", "JSON")


if __name__ == "__main__":
    cli_test.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
