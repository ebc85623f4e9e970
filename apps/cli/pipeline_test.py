#!/usr/bin/env python3
"""partwise pipeline over a few small files: every stage, killed once in each and gone on with, what a change touches, and
what a bad file does. pipeline_test.py PARTWISE HAS_LEARNING"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import cli_test

PROGRAM = Path(sys.argv[1]).resolve()
HAS_LEARNING = sys.argv[2] == "1"
MODELS = cli_test.DATA / "models"


def box(low, high):
    """A closed box as an OFF file."""
    corners = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return "OFF\n8 6 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in corners) + "".join(f"4 {a} {b} {c} {d}\n" for a, b, c, d in quads)


IMAGES = {"materials": ["pvc", "blue-rubber", "nylon"], "lights": ["studio"], "light_size": [16, 8], "map_size": 8, "format": "png",
          "views": 1, "images": 9, "images_per_shard": 3}
TRAINING = {"materials": ["pvc", "blue-rubber", "nylon"], "lights": ["studio"], "batch": 2, "group": 2, "map_size": 16, "layer_map": 16,
            "layer_light": 16, "normal_channels": 32, "stages": [{"steps": 3, "learning_rate": 1e-3}], "report_every": 1, "checkpoint_every": 1,
            "validate_every": 3, "validation_batches": 1, "threads": 1}
VAN = {"space": "se2", "robot": [{"polygon": [[-1, -0.2], [1, -0.2], [1, 0.2], [-1, 0.2]]}],
       "obstacles": [{"polygon": [[-10, -1], [1.5, -1], [1.5, 1], [-10, 1]]}, {"polygon": [[2.5, -1], [10, -1], [10, 1], [2.5, 1]]},
                     {"polygon": [[-4, 5], [4, 5], [4, 6], [-4, 6]]}],
       "bounds": {"low": [-10, -10], "high": [10, 10]}, "queries": [{"start": [-5, -5, 0], "goal": [-3, 8, 0]}]}
HALL = {"name": "hall", "obstacles": ["walls"], "robot": "stick.off", "space": "se3", "samples": 40,
        "bounds": {"low": [-6, -6, -6], "high": [6, 6, 6]},
        "queries": [{"start": [-4, 0, 0, 1, 0, 0, 0], "goal": [4, 0, 0, 1, 0, 0, 0]}]}


class Pipeline(unittest.TestCase):
    def setUp(self):
        shared = tempfile.TemporaryDirectory(prefix="partwise-pipeline-")
        self.addCleanup(shared.cleanup)
        self.folder = Path(shared.name).resolve()
        for name in ("shapes", "walls"):
            (self.folder / name).mkdir()
        (self.folder / "shapes" / "notch.obj").write_bytes(cli_test.NOTCH.read_bytes())
        (self.folder / "shapes" / "table.obj").write_bytes((MODELS / "table.obj").read_bytes())
        (self.folder / "walls" / "left.off").write_text(box((-0.5, -5, -5), (0.5, -0.6, 5)))
        (self.folder / "walls" / "right.off").write_text(box((-0.5, 0.6, -5), (0.5, 5, 5)))
        (self.folder / "stick.off").write_text(box((-0.8, -0.1, -0.1), (0.8, 0.1, 0.1)))
        (self.folder / "van.json").write_text(json.dumps(VAN))
        (self.folder / "hole3.poly").write_bytes((cli_test.DATA / "outlines" / "hole3.poly").read_bytes())

    def write(self, config, name="c.json"):
        (self.folder / name).write_text(json.dumps(config))

    def command(self, output, *arguments, config="c.json"):
        return [PROGRAM, "pipeline", config, "-o", output, *map(str, arguments)]

    def run_pipeline(self, output, *arguments, **settings):
        return subprocess.run(self.command(output, *arguments), capture_output=True, text=True, timeout=600, cwd=self.folder, **settings)

    def stages(self, output, *arguments):
        """Of each stage how many jobs were made and kept."""
        done = self.run_pipeline(output, "--json", "-", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {stage["name"]: (stage["made"], stage["kept"]) for stage in json.loads(done.stdout)["stages"]}

    def manifest(self, output):
        return json.loads((self.folder / output / "manifest.json").read_text())

    def bytes_of(self, output):
        """What the manifest says was made, from the files themselves."""
        jobs = [job for stage in self.manifest(output)["stages"] for job in stage["jobs"]]
        return {each["file"]: (self.folder / output / each["file"]).read_bytes() for job in jobs for each in job["outputs"]}

    def assert_same_bytes(self, one, other):
        ours, theirs = self.bytes_of(one), self.bytes_of(other)
        self.assertEqual(sorted(ours), sorted(theirs))
        self.assertEqual([name for name in ours if ours[name] != theirs[name]], [])

    def left_unfinished(self, output):
        return [path for path in (self.folder / output).rglob("*") if path.suffix in (".unfinished", ".old", ".check", ".tmp")]

    def stop_when(self, output, number, pattern, *arguments):
        """Kills the pipeline as soon as there is such a file."""
        process = subprocess.Popen(self.command(output, *arguments), cwd=self.folder, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while process.poll() is None and time.monotonic() < deadline and not list((self.folder / output).glob(pattern)):
            time.sleep(0.001)
        process.send_signal(number)
        message = process.communicate(timeout=60)[1]
        if number == signal.SIGKILL:
            self.assertEqual(process.returncode, -number, f"{pattern} was not seen in time: {message}")
        else:
            self.assertEqual((process.returncode, message),
                             (128 + number, "partwise: stopped on request; what is done stays, and running it again goes on from there\n"), pattern)
        self.assertFalse((self.folder / output / "manifest.json").exists())


class Stages(Pipeline):
    def config(self):
        config = {"shapes": "shapes", "outlines": "hole3.poly", "images": IMAGES, "motion": [{"scene": "van.json", "samples": 40}, HALL],
                  "parts": {"convex": {"tolerance": 0.1}, "meaningful": {"feature": "sdf"}, "planar": {"tolerance": 0.05}}}
        if HAS_LEARNING:
            done = subprocess.run([PROGRAM, "material", "ball", "green-plastic", "--size", "96", "-o", "ball.png", "--quiet"], cwd=self.folder)
            self.assertEqual(done.returncode, 0)
            config["training"] = {"editing": TRAINING}
            config["photos"] = [{"photo": "ball.png", "materials": ["chrome"], "normals": True}]
        return config

    def test_stopped_in_each_stage_the_bytes_are_the_same(self):
        self.write(self.config())
        made = self.stages("whole", "--threads", 2)
        expected = {"parts": (7, 0), "roadmaps": (2, 0), "paths": (2, 0), "images": (1, 0)}
        if HAS_LEARNING:
            expected |= {"training": (1, 0), "edits": (1, 0), "normals": (1, 0)}
        self.assertEqual(made, expected)

        stops = ["parts/*/*.unfinished", "motion/*/roadmap.unfinished", "motion/*/path-1.unfinished", "images.unfinished/*.tar"]
        if HAS_LEARNING:
            stops += ["training/editing.unfinished/checkpoint.pt", "photos/ball.png/chrome.unfinished", "photos/ball.png/normals.unfinished"]
        for i, pattern in enumerate(stops):
            self.stop_when("stopped", (signal.SIGTERM, signal.SIGKILL, signal.SIGINT)[i % 3], pattern, "--threads", 1)
        self.stages("stopped", "--threads", 1)
        self.assert_same_bytes("stopped", "whole")
        self.assertEqual(self.left_unfinished("stopped"), [])
        self.assertEqual(self.stages("stopped"), {name: (0, made) for name, (made, _) in expected.items()})
        self.check_manifest(self.manifest("whole"))

    def check_manifest(self, manifest):
        jobs = {job["name"]: job for stage in manifest["stages"] for job in stage["jobs"]}
        convex = jobs["parts/notch.obj/convex"]
        self.assertEqual(convex["command"][:2], ["decompose", "../shapes/notch.obj"])
        self.assertEqual([each["file"] for each in convex["inputs"]], ["../shapes/notch.obj"])
        self.assertEqual([each["file"] for each in convex["outputs"]], [f"parts/notch.obj/convex/{name}" for name in ("hulls.obj", "labels.seg", "parts.glb")])
        self.assertGreater(convex["report"]["parts"], 1)
        self.assertGreater(convex["seconds"], 0)
        labels = next(each for each in jobs["parts/table.obj/meaningful"]["outputs"] if each["file"].endswith(".seg"))
        self.assertIn(labels, jobs["images"]["inputs"])
        self.assertIn("partwise:models/materials/pvc.json", [each["file"] for each in jobs["images"]["inputs"]])
        self.assertNotIn(str(self.folder), json.dumps(manifest))
        if HAS_LEARNING:
            self.assertTrue({each["file"] for each in jobs["training/editing"]["inputs"]} > {f"images/shard-{i:06}.tar" for i in range(3)})
            self.assertIn("training/editing/best.pt", [each["file"] for each in jobs["photos/ball.png/normals"]["inputs"]])


@unittest.skipUnless(HAS_LEARNING, "built without libtorch")
class Checks(Pipeline):
    def test_a_training_is_looked_at_before_anything_is_made(self):
        self.write({"shapes": "shapes", "images": IMAGES, "training": {"editing": {**TRAINING, "stages": [{"steps": 3, "speed": 2}]}}})
        done = self.run_pipeline("out")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr, "partwise: c.json: training.editing.stages[0].speed is not a field that is known; see docs/training.md\n")
        self.assertFalse((self.folder / "out" / "images").exists())
        self.assertEqual(self.left_unfinished("out"), [])


class Example(unittest.TestCase):
    def test_is_what_its_page_says_and_can_be_run(self):
        example = cli_test.NOTCH.parent / "pipeline.json"
        self.assertIn("```json\n" + example.read_text() + "```", (example.parents[1] / "docs" / "pipeline.md").read_text())
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, "pipeline", example, "-o", folder, "--dry-run", "--json", "-"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual({job["stage"] for job in json.loads(done.stdout)["jobs"]}, {"parts", "roadmaps", "paths", "images", "edits", "normals"})


class Changes(Pipeline):
    def setUp(self):
        super().setUp()
        self.config = {"shapes": ["shapes"], "parts": {"convex": {"tolerance": 0.1}, "meaningful": {"feature": "sdf"}},
                       "images": {**IMAGES, "images": 2}, "motion": [{"scene": "van.json", "samples": 20}]}
        self.write(self.config)

    def test_a_change_touches_what_depends_on_it(self):
        self.stages("out")
        before = self.bytes_of("out")
        self.config["parts"]["convex"]["tolerance"] = 0.2  # images show the other parts
        self.write(self.config)
        self.assertEqual(self.stages("out"), {"parts": (2, 2), "roadmaps": (0, 1), "paths": (0, 1), "images": (0, 1)})
        mesh = self.folder / "shapes" / "notch.obj"
        mesh.write_text(mesh.read_text().replace("v 1 ", "v 1.5 "))
        dry = self.run_pipeline("out", "--dry-run")
        self.assertIn("make parts/notch.obj/convex: ../shapes/notch.obj has changed\n", dry.stdout)
        self.assertIn("see  images: after parts/notch.obj/meaningful\n", dry.stdout)
        self.assertIn("4 of 7 jobs stand", dry.stdout)
        self.assertEqual(self.stages("out"), {"parts": (2, 2), "roadmaps": (0, 1), "paths": (0, 1), "images": (1, 0)})
        after = self.bytes_of("out")
        changed = {name.split("/")[1] for name in before if before[name] != after[name]}
        self.assertEqual(changed, {"notch.obj", "dataset.json", "shard-000000.tar"})
        (self.folder / "out" / "images" / "shard-000000.tar").write_bytes(b"spoilt")
        self.assertEqual(self.stages("out")["images"], (1, 0))
        self.assertEqual(self.bytes_of("out"), after)
        self.assertEqual(self.stages("out", "--seed", 5)["images"], (1, 0))

    def test_a_bad_shape_stops_only_what_needs_it(self):
        (self.folder / "shapes" / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n")
        done = self.run_pipeline("out", "--json", "report.json")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 3, done.stderr)
        for line, job in zip(sorted(lines[:2]), ("convex", "meaningful")):
            self.assertTrue(line.startswith(f"partwise: parts/bad.off/{job}: shapes/bad.off:"), line)
        self.assertEqual(lines[2], "partwise: c.json: 2 of 9 jobs failed, 1 more need what they make; mend what the lines above say and run it "
                                   "again, which goes on from here")
        self.assertTrue((self.folder / "out" / "parts" / "table.obj" / "convex" / "hulls.obj").exists())
        for name in ("report.json", "out/manifest.json", "out/images", "out/parts/bad.off/convex"):
            self.assertFalse((self.folder / name).exists(), name)

        self.write({**self.config, "bad_shapes": "leave_out"})
        done = self.run_pipeline("out", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 2)
        self.assertEqual([stage["failed"] for stage in json.loads(done.stdout)["stages"]], [2, 0, 0, 0])
        self.assertEqual([each["job"] for each in self.manifest("out")["left_out"]], ["parts/bad.off/convex", "parts/bad.off/meaningful"])
        left = self.bytes_of("out")

        self.write({**self.config, "except": ["shapes/bad.off"]})  # the same by hand
        self.assertEqual(self.stages("out")["images"], (0, 1))
        self.assertEqual(self.bytes_of("out"), left)

    def test_what_cannot_be_done(self):
        for config, words in (({**self.config, "colour": 1}, ["colour", "docs/pipeline.md"]),
                              ({**self.config, "shapes": ["gone/*.off"]}, ["shapes", "matches no file"]),
                              ({**self.config, "images": {**IMAGES, "views": 99}}, ["images.views"]),
                              ({}, ["asks for nothing"])):
            self.write(config)
            done = self.run_pipeline("out")
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            for word in ["c.json", *words]:
                self.assertIn(word, done.stderr)
            self.assertFalse((self.folder / "out").exists())
        self.write(self.config)
        done = self.run_pipeline("out", env={**os.environ, "RANK": "0", "WORLD_SIZE": "2"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("run it once", done.stderr)
        (self.folder / "file").write_text("")
        self.assertEqual(self.run_pipeline("file").returncode, 1)
        self.assertEqual(subprocess.run([PROGRAM, "pipeline"], capture_output=True).returncode, 2)

    @unittest.skipIf(HAS_LEARNING, "built with libtorch")
    def test_without_libtorch_photos_say_so(self):
        (self.folder / "ball.png").write_bytes(b"x")
        self.write({"photos": [{"photo": "ball.png", "normals": True}]})
        done = self.run_pipeline("out")
        self.assertEqual(done.returncode, 1)
        self.assertIn("photos/ball.png/normals: normals needs libtorch", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
