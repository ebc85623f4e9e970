"""Replays the corpus of bad and odd shapes with the program: what can be decomposed gives every output that was asked for,
what cannot gives exit 1 and one line that holds the expected words, and nothing takes long.

    outline_corpus_test.py PROGRAM CORPUS_FOLDER
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = ""
CORPUS = Path()
SECONDS = 20


class OutlineCorpus(unittest.TestCase):
    def test_every_file(self):
        cases = json.loads((CORPUS / "expected.json").read_text())
        self.assertGreaterEqual(len(cases), 60)
        for case in cases:
            with self.subTest(file=case["file"]), tempfile.TemporaryDirectory(prefix="partwise-corpus-") as folder:
                self.replay(CORPUS / case["file"], case, Path(folder))

    def replay(self, shape, case, folder):
        names = {"--parts": "a.geojson", "--svg": "a.svg", "--skeleton": "b.svg", "--json": "a.json"}
        arguments = [str(part) for option, name in names.items() for part in (option, folder / name)]
        result = subprocess.run(
            [PROGRAM, "outline", shape, "--tolerance", "0.1", *arguments],
            capture_output=True, timeout=SECONDS, encoding="utf-8", errors="replace",
        )
        left = {path.name for path in folder.iterdir()}
        if "error" not in case:
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(left, set(names.values()))
            report = json.loads((folder / "a.json").read_text())
            self.assertAlmostEqual(report["area"], case["area"], places=5)
            self.assertEqual(len(report["holes"]), case["holes"])
            self.assertEqual(report["repaired"], case.get("repaired"))
            self.assertLessEqual(report["concavity"], 0.1)
            parts = json.loads((folder / "a.geojson").read_text())["features"]
            self.assertEqual(len(parts), report["parts"])
        else:
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stdout, "")
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(case["error"], result.stderr)
            self.assertIn(shape.name, result.stderr)
            self.assertEqual(left, set())


if __name__ == "__main__":
    CORPUS = Path(sys.argv.pop(2))
    PROGRAM = sys.argv.pop(1)
    unittest.main()
