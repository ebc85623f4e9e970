"""The verb rooms: what a folder holds, that it is the same whoever makes it and however often it is stopped, what is refused;
then a network that learns from it, and the normals that this one reads.

    rooms_test.py PROGRAM LEARNING
"""

import json
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import cli_test

MODELS = Path(__file__).resolve().parents[2] / "data" / "models"
LEARNING = False


class Rooms(cli_test.CommandLine):
    def config(self, **changes):
        config = {"shapes": [str(MODELS / "chair.off"), str(MODELS / "table.obj")], "height": 0.8, "materials": ["chrome", "blue-fabric", "nylon"],
                  "lights": ["sky", "studio"], "size": [64, 48], "map_size": 12, "light_size": [32, 16], "images": 4}
        config.update(changes)
        (self.folder / "config.json").write_text(json.dumps({k: v for k, v in config.items() if v is not None}))

    def make(self, output, *arguments):
        return self.run_program("rooms", "config.json", "-o", output, *arguments)

    def files(self, output):
        return {str(path.relative_to(self.folder / output)): path.read_bytes() for path in (self.folder / output).rglob("*") if path.is_file()}

    def test_holds_what_is_promised_and_goes_on(self):
        self.config()
        result = self.make("out", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["images"], report["kept"]), (4, 0))
        self.assertGreater(report["images_per_second"], 0)
        whole = self.files("out")
        self.assertEqual(len(whole), 4 * 5 + 2)
        for folder, bits, colour in (("color", 8, 2), ("depth", 16, 0), ("normals", 16, 2), ("materials", 8, 0)):
            width, height, *kind, _ = cli_test.png_rows(whole[f"{folder}/000003.png"])
            self.assertEqual((width, height, *kind), (64, 48, bits, colour), folder)
        self.assertEqual(len(json.loads(whole["truth/000000.json"])["light"]["radiance"]), 3 * 16 * 8)
        for threads in (1, 2):
            self.assert_done(self.make(f"again{threads}", "--threads", threads, "--quiet"))
            self.assertEqual(self.files(f"again{threads}"), whole)
        (self.folder / "out" / "color" / "000001.png").unlink()
        report = json.loads(self.make("out", "--json", "-").stdout)
        self.assertEqual((report["images"], report["kept"]), (1, 3))
        self.assertEqual(self.files("out"), whole)
        self.assert_refused(self.make("out", "--seed", 5), 1, "out", "another configuration")

    def test_killed_and_gone_on_with(self):
        self.config(images=60)
        process = subprocess.Popen([cli_test.PROGRAM, "rooms", "config.json", "-o", "out", "--quiet"], cwd=self.folder)
        deadline = time.monotonic() + 60
        while not list((self.folder / "out").glob("color/*.png")) and time.monotonic() < deadline:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
        result = self.make("out", "--json", "-")
        self.assert_done(result)
        self.assertGreater(json.loads(result.stdout)["kept"], 0)
        self.assert_done(self.make("whole", "--quiet"))
        whole, gone_on = self.files("whole"), self.files("out")
        self.assertEqual({name: data for name, data in gone_on.items() if name in whole}, whole)

    def test_what_is_wrong_is_named(self):
        for changes, words in (({"shapes": None}, ["shapes"]), ({"shapes": ["gone.off"]}, ["shapes[0]", "gone.off"]),
                               ({"materials": ["unobtainium"]}, ["unobtainium"]), ({"lights": ["moon"]}, ["moon"]), ({"images": None}, ["images"]),
                               ({"images": 0}, ["images"]), ({"size": [64]}, ["size"]), ({"field_of_view": 200}, ["field_of_view"]),
                               ({"least_pieces": 9, "most_pieces": 3}, ["most_pieces"]), ({"room_materials": 0}, ["room_materials"]),
                               ({"views": 4}, ["views", "docs/rooms.md"])):
            with self.subTest(changes):
                self.config(**changes)
                self.assert_refused(self.make("out", "--quiet"), 1, *words)
                self.assertFalse((self.folder / "out").exists())
        self.config()
        self.assert_refused(self.run_program("rooms", "config.json"), 1, "config.json", "output")

    def test_a_network_learns_from_them_and_reads_a_picture(self):
        if not LEARNING:
            self.skipTest("a build without libtorch")
        self.config(images=6)
        self.assert_done(self.make("rooms", "--quiet"))
        stage = {"steps": 4, "learning_rate": 1e-3, "normal": 1, "pixel": 20, "material": 0.1, "light": 0.1}
        training = {"network": "scenes", "frames": "rooms", "width": 64, "batch": 2, "report_every": 1, "checkpoint_every": 2, "validate_every": 2,
                    "validation_batches": 1, "stages": [stage]}
        (self.folder / "train.json").write_text(json.dumps(training))
        result = self.run_program("train", "train.json", "-o", "net", "--json", "-")
        self.assert_done(result)
        self.assertEqual(json.loads(result.stdout)["step"], 4)
        lines = [json.loads(line) for line in (self.folder / "net" / "log.jsonl").read_text().splitlines()]
        self.assertEqual(set(lines[0]["training"]) - {"seconds", "learning_rate", "gradient"}, {"loss", "normal", "pixel", "material", "light"})
        result = self.run_program("normals", "rooms/color/000000.png", "--model", "scene", "--weights", "net/best.pt", "-o", "n.png", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["model"], report["pixels"], report["width"]), ("scene", 64 * 48, 64))
        of_objects = str(MODELS.parents[1] / "models" / "networks" / "editing.pt")
        for arguments, status, words in ((["--mask", "rooms/materials/000000.png"], 2, ["--mask", "whole"]),
                                         (["--weights", of_objects], 1, ["editing.pt", "scenes"])):
            self.assert_refused(self.run_program("normals", "rooms/color/000000.png", "--model", "scene", *arguments, "-o", "m.png"), status, *words)
        (self.folder / "train.json").write_text(json.dumps(training | {"width": 50}))
        self.assert_refused(self.run_program("train", "train.json", "-o", "bad"), 1, "train.json", "width")
        (self.folder / "train.json").write_text(json.dumps(training | {"frames": "nowhere"}))
        self.assert_refused(self.run_program("train", "train.json", "-o", "bad"), 1, "nowhere")


if __name__ == "__main__":
    LEARNING = sys.argv.pop(2) in ("1", "ON", "TRUE")
    cli_test.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
