"""The peers of outline_bench.py on shapes whose fewest cuts are plain to see, and the bench itself on one of them.

    outline_bench_test.py OUTLINE_MNCD
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MNCD = Path(sys.argv.pop(1)).resolve()
BENCH = Path(__file__).resolve().parent / "outline_bench.py"

SHAPES = {  # rings, cuts, parts
    "square": ([[(0, 0), (9, 0), (9, 9), (0, 9)]], 0, 1),
    "l": ([[(0, 0), (9, 0), (9, 3), (3, 3), (3, 9), (0, 9)]], 1, 2),
    "t": ([[(4, 0), (6, 0), (6, 6), (10, 6), (10, 8), (0, 8), (0, 6), (4, 6)]], 1, 2),
    "plus": ([[(3, 0), (6, 0), (6, 3), (9, 3), (9, 6), (6, 6), (6, 9), (3, 9), (3, 6), (0, 6), (0, 3), (3, 3)]], 2, 3),
    "frame": ([[(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (3, 6), (6, 6), (6, 3)]], 4, 4),
    # A hole less than the tolerance wide forbids no pair.
    "pinhole": ([[(0, 0), (9, 0), (9, 9), (0, 9)], [(4.4, 4.4), (4.4, 4.6), (4.6, 4.6), (4.6, 4.4)]], 0, 1),
}


class OutlineBench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="outline-bench-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name, (rings, _, _) in SHAPES.items():
            coordinates = [ring + ring[:1] for ring in rings]
            (self.folder / f"{name}.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": coordinates}))

    def test_fewest_cuts(self):
        for name, (_, cuts, parts) in SHAPES.items():
            with self.subTest(shape=name):
                made = subprocess.run([MNCD, self.folder / f"{name}.geojson", self.folder / "parts.json", "--tolerance", "0.05"],
                                      capture_output=True, text=True, check=True)
                report = json.loads(made.stdout.splitlines()[-1])
                self.assertEqual((report["cuts"], report["parts"], report["finished"]), (cuts, parts, True))
                features = json.loads((self.folder / "parts.json").read_text())["features"]
                self.assertEqual(len(features), parts)

    def test_table(self):
        result = subprocess.run([sys.executable, BENCH, "--build", MNCD.parents[1], "--noise", "--mncd", "2", "--tolerance", "0.2",
                                 self.folder / "frame.geojson"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("ours", "peer", "mncd"):
            self.assertRegex(result.stdout, rf"(?m)^{name}: shapes 1, rand_index 0\.\d+")


if __name__ == "__main__":
    unittest.main()
