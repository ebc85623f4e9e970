"""Replays a corpus of bad and odd files with the program: what can be used gives every output that was asked for, what
cannot gives exit 1 and one line that holds the expected words, and nothing takes long.

    corpus_test.py PROGRAM CORPUS_FOLDER Meshes|Surfaces|Outlines|Problems
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = ""
CORPUS = Path()


class Corpus:
    """What both have in common; `outputs` are options and the names of their files."""

    def test_every_file(self):
        cases = json.loads((CORPUS / "expected.json").read_text())
        self.assertGreaterEqual(len(cases), self.least)
        for case in cases:
            with self.subTest(file=case["file"]), tempfile.TemporaryDirectory(prefix="partwise-corpus-") as folder:
                self.replay(case, Path(folder))

    def replay(self, case, folder):
        arguments = [str(part) for option, name in self.outputs.items() for part in (option, folder / name)]
        result = subprocess.run(
            [PROGRAM, self.verb, CORPUS / case["file"], "--tolerance", "0.1", *arguments],
            capture_output=True, timeout=self.seconds, encoding="utf-8", errors="replace",
        )
        left = {path.name for path in folder.iterdir()}
        words = self.refusal(case)
        if words is None:
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(left, set(self.outputs.values()))
            self.check(case, folder, json.loads((folder / self.outputs["--json"]).read_text()))
        else:
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stdout, "")
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(words, result.stderr)
            self.assertIn(case["file"], result.stderr)
            self.assertEqual(left, set())


class Meshes(Corpus, unittest.TestCase):
    verb, least, seconds = "decompose", 40, 60
    outputs = {"--labels": "a.seg", "--hulls": "a.obj", "--json": "a.json"}

    def refusal(self, case):
        return None if case["decompose"] == "ok" else case["decompose"]

    def check(self, case, folder, report):
        labels = (folder / "a.seg").read_text().split()
        self.assertEqual(len(labels), report["faces"])
        self.assertEqual(len(set(labels)), report["parts"])


class Surfaces(unittest.TestCase):
    """What decompose can read, the verbs for surfaces can, and what it refuses they refuse."""

    verbs = (["feature", "--kind", "cvf-avg", "--values"], ["segment", "--feature", "sdf", "--labels"], ["medial", "--points"])

    def test_every_file(self):
        for case in json.loads((CORPUS / "expected.json").read_text()):
            for verb in self.verbs:
                with self.subTest(file=case["file"], verb=verb[0]), tempfile.TemporaryDirectory() as folder:
                    self.replay(case, verb, Path(folder) / "a.ply")

    def replay(self, case, verb, output):
        result = subprocess.run([PROGRAM, verb[0], CORPUS / case["file"], *verb[1:], output], capture_output=True,
                                timeout=60, encoding="utf-8", errors="replace")
        if case["decompose"] == "ok":
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertTrue(output.exists())
        else:
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(case["file"], result.stderr)
            self.assertFalse(output.exists())


class Outlines(Corpus, unittest.TestCase):
    verb, least, seconds = "outline", 60, 20
    outputs = {"--parts": "a.geojson", "--svg": "a.svg", "--skeleton": "b.svg", "--json": "a.json"}

    def refusal(self, case):
        return case.get("error")

    def check(self, case, folder, report):
        self.assertAlmostEqual(report["area"], case["area"], places=5)
        self.assertEqual(len(report["holes"]), case["holes"])
        self.assertEqual(report["repaired"], case.get("repaired"))
        self.assertLessEqual(report["concavity"], 0.1)
        self.assertEqual(len(json.loads((folder / "a.geojson").read_text())["features"]), report["parts"])


class Problems(unittest.TestCase):
    """What can be read is planned for, or one line says why not: no start and goal, no axis, nothing found in a second."""

    def test_every_file(self):
        cases = json.loads((CORPUS / "expected.json").read_text())
        self.assertGreaterEqual(len(cases), 100)
        for case in cases:
            with self.subTest(file=case["file"]), tempfile.TemporaryDirectory(prefix="partwise-corpus-") as folder:
                self.replay(case, Path(folder))

    def replay(self, case, folder):
        file, option = CORPUS / case["file"], {".robot": "--robot", ".query": "--queries"}.get(Path(case["file"]).suffix)
        problem = [file] if option is None else [CORPUS / "world.env", option, file]
        result = subprocess.run([PROGRAM, "plan", *problem, "--time", "1", "--path", folder / "a.txt", "--json", folder / "a.json"],
                                capture_output=True, timeout=60, encoding="utf-8", errors="replace")
        left = {path.name for path in folder.iterdir()}
        if result.returncode == 0:
            self.assertNotIn("error", case)
            self.assertEqual((result.stderr, left), ("", {"a.txt", "a.json"}))
        else:
            self.assertEqual((result.returncode, result.stdout, left), (1, "", set()), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(case.get("error", case["file"]), result.stderr)


if __name__ == "__main__":
    CORPUS = Path(sys.argv.pop(2))
    PROGRAM = sys.argv.pop(1)
    unittest.main()
