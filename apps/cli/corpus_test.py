"""Replays the corpus of bad and odd files with the program: what can be decomposed gives every output that was asked for,
what cannot gives exit 1 and one line that holds the expected words, and nothing takes long.

    corpus_test.py PROGRAM CORPUS_FOLDER
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = ""
CORPUS = Path()
SECONDS = 60


class Corpus(unittest.TestCase):
    def test_every_file(self):
        cases = json.loads((CORPUS / "expected.json").read_text())
        self.assertGreaterEqual(len(cases), 40)
        for case in cases:
            with self.subTest(file=case["file"]), tempfile.TemporaryDirectory(prefix="partwise-corpus-") as folder:
                self.replay(CORPUS / case["file"], case["decompose"], Path(folder))

    def replay(self, mesh, expected, folder):
        outputs = {option: folder / name for option, name in (("--labels", "a.seg"), ("--hulls", "a.obj"), ("--json", "a.json"))}
        arguments = [str(part) for pair in outputs.items() for part in pair]
        result = subprocess.run(
            [PROGRAM, "decompose", mesh, "--tolerance", "0.1", *arguments],
            capture_output=True, timeout=SECONDS, encoding="utf-8", errors="replace",
        )
        left = {path.name for path in folder.iterdir()}
        if expected == "ok":
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(left, {path.name for path in outputs.values()})
            report = json.loads(outputs["--json"].read_text())
            labels = outputs["--labels"].read_text().split()
            self.assertEqual(len(labels), report["faces"])
            self.assertEqual(len(set(labels)), report["parts"])
        else:
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stdout, "")
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(expected, result.stderr)
            self.assertIn(mesh.name, result.stderr)
            self.assertEqual(left, set())


if __name__ == "__main__":
    CORPUS = Path(sys.argv.pop(2))
    PROGRAM = sys.argv.pop(1)
    unittest.main()
