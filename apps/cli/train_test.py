#!/usr/bin/env python3
"""partwise train on a few views: what it writes, going on after being killed, several processes, bad configurations.
train_test.py PARTWISE"""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
MODELS = Path(__file__).resolve().parents[2] / "data" / "models"
STEPS = 6


def command(*arguments):
    return [PROGRAM, *map(str, arguments)]


def run(*arguments, **settings):
    return subprocess.run(command(*arguments), capture_output=True, text=True, timeout=600, **settings)


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Train(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.shared.name)
        views = {"shapes": [str(MODELS / "chair.off")], "materials": "training", "lights": ["studio"], "light_size": [16, 8],
                 "map_size": 8, "format": "png", "views": 1, "images": 4}
        (cls.folder / "views.json").write_text(json.dumps(views))
        done = run("dataset", cls.folder / "views.json", "-o", cls.folder / "views", "--quiet")
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def config(self, name="c.json", **changes):
        config = {"network": "editing", "views": ["views"], "materials": ["pvc", "blue-rubber", "nylon"], "lights": ["studio"],
                  "batch": 2, "group": 2, "map_size": 16, "layer_map": 16, "layer_light": 16, "normal_channels": 32,
                  "stages": [{"steps": STEPS, "learning_rate": 1e-3}], "report_every": 2, "checkpoint_every": 2,
                  "validate_every": 4, "validation_batches": 1}
        config.update(changes)
        path = self.folder / name
        path.write_text(json.dumps({key: value for key, value in config.items() if value is not None}))
        return path

    def log(self, output):
        """Without times, which differ."""
        lines = [json.loads(line) for line in (output / "log.jsonl").read_text().splitlines()]
        for line in lines:
            for group in line.values():
                if isinstance(group, dict):
                    group.pop("seconds", None)
        return lines

    def trained(self, name, config, *more):
        output = self.folder / name
        done = run("train", config, "-o", output, "--quiet", "--threads", 1, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return output

    def test_writes_what_it_promises(self):
        output = self.folder / "plain"
        done = run("train", self.config(), "-o", output, "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["step"], STEPS)
        self.assertGreater(report["loss"], 0)
        log = self.log(output)
        self.assertEqual([line["step"] for line in log if "training" in line], [2, 4, 6])
        self.assertEqual([line["step"] for line in log if "validation" in line], [4, 6])
        self.assertEqual(set(log[0]["training"]), {"loss", "normal", "material", "light", "pixel", "gradient", "learning_rate"})
        for name in ("best.pt", "checkpoint.pt", "config.json"):
            self.assertTrue((output / name).is_file(), name)
        self.assertEqual(len(list(output.glob("events.out.tfevents.*"))), 1)
        again = run("train", self.config(), "-o", output)
        self.assertEqual(again.returncode, 1)
        self.assertIn("--resume", again.stderr)
        other = run("train", self.config(), "-o", output, "--resume", "--seed", 3)
        self.assertEqual(other.returncode, 1)
        self.assertIn("another configuration", other.stderr)

    def normals(self, architecture, **changes):
        """A training of normals alone."""
        return self.config(f"{architecture}.json", network="normals", architecture=architecture, normal_channels=None, channels=32, parts=0.5,
                           stages=[{"steps": STEPS, "learning_rate": 1e-3, "pixel": 20}], **changes)

    def test_normals_alone(self):
        for architecture in ("u", "multi_branch"):
            output = self.trained(architecture, self.normals(architecture))
            log = self.log(output)
            self.assertEqual(set(log[0]["training"]), {"loss", "normal", "pixel", "gradient", "learning_rate"})
            self.trained(f"{architecture}_again", self.normals(architecture, start=f"{architecture}/best.pt"))
        refused = run("train", self.normals("u", start="multi_branch/best.pt"), "-o", self.folder / "bad")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("architecture", refused.stderr)

    def test_goes_on_after_being_killed(self):
        for name, config in (("editing", self.config()), ("normals", self.normals("u"))):
            with self.subTest(name):
                self.goes_on_after_being_killed(name, config)

    def goes_on_after_being_killed(self, name, config):
        whole = self.trained(f"{name}_whole", config)
        output = self.folder / f"{name}_killed"
        process = subprocess.Popen(command("train", config, "-o", output, "--quiet", "--threads", 1))
        deadline = time.monotonic() + 500
        while not (output / "checkpoint.pt").exists() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.trained(f"{name}_killed", config, "--resume")
        self.assertEqual(self.log(output), self.log(whole))

    def test_two_processes_learn_what_one_does(self):
        """Up to rounding, which Adam's first steps make much of: they are as long where a gradient is next to nothing."""
        config = self.config(dropout=0.3, report_every=1)
        one = self.trained("one", config)
        output, port = self.folder / "two", free_port()
        processes = []
        for rank in range(2):
            environment = {**os.environ, "RANK": str(rank), "WORLD_SIZE": "2", "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": str(port)}
            processes.append(subprocess.Popen(command("train", config, "-o", output, "--quiet", "--threads", 1), env=environment,
                                              stderr=subprocess.PIPE, text=True))
        for process in processes:
            _, message = process.communicate(timeout=600)
            self.assertEqual(process.returncode, 0, message)
        for alone, shared in zip(self.log(one), self.log(output), strict=True):
            self.assertEqual(alone.keys(), shared.keys())
            for group in ("training", "validation"):
                for name, value in alone.get(group, {}).items():
                    near = 1e-5 if alone["step"] == 1 else 1e-2
                    self.assertAlmostEqual(shared[group][name], value, delta=near * abs(value), msg=f"{alone['step']} {name}")

    def test_bad_configurations(self):
        cases = [({"network": "oracle"}, "network"), ({"stages": []}, "stages"), ({"stages": [{"steps": 0}]}, "stages[0].steps"),
                 ({"stages": [{"steps": 1, "speed": 2}]}, "speed"), ({"materials": ["granite"]}, "granite"), ({"lights": ["moon"]}, "moon"),
                 ({"views": ["nowhere"]}, "nowhere"), ({"size": 100}, "size"), ({"size": 160}, "160"), ({"colour": 1}, "colour"),
                 ({"views": None}, "views"), ({"given": ["material"]}, "given"), ({"start": "none.pt"}, "none.pt"),
                 ({"network": None}, "network"), ({"network": "normals", "normal_channels": None}, "architecture"),
                 ({"network": "normals", "architecture": "v"}, "multi_branch"), ({"network": "normals", "architecture": "u"}, "normal_channels"),
                 ({"network": "normals", "architecture": "u", "normal_channels": None, "channels": 24}, "channels"),
                 ({"network": "normals", "architecture": "u", "normal_channels": None, "readers": "none.pt"}, "none.pt")]
        for changes, word in cases:
            done = run("train", self.config("bad.json", **changes), "-o", self.folder / "bad")
            self.assertEqual(done.returncode, 1, (changes, done.stderr))
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / "bad").exists())
        (self.folder / "text.json").write_text("{")
        for arguments, status in ((["text.json", "-o", "bad"], 1), (["none.json", "-o", "bad"], 1), (["c.json"], 1), ([], 2)):
            done = run("train", *arguments, cwd=self.folder)
            self.assertEqual(done.returncode, status, (arguments, done.stderr))

    def test_a_configuration_is_checked_alone(self):
        done = run("train", self.config("sound.json", views=["nowhere"]), "--check", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = run("train", self.config("bad.json", stages=[{"steps": 0}]), "--check")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("stages[0].steps", done.stderr)
        self.assertFalse((self.folder / "nowhere").exists())

    def test_processes_that_cannot_share(self):
        environment = {**os.environ, "RANK": "0", "WORLD_SIZE": "3", "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": "1"}
        done = run("train", self.config(), "-o", self.folder / "three", env=environment)
        self.assertEqual(done.returncode, 1)
        self.assertIn("shared evenly", done.stderr)
        environment = {**os.environ, "RANK": "0", "WORLD_SIZE": "2"}
        environment.pop("MASTER_ADDR", None)
        done = run("train", self.config(), "-o", self.folder / "three", env=environment)
        self.assertEqual(done.returncode, 1)
        self.assertIn("MASTER_ADDR", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
