"""The judge of cages on a box, and the bench with the program itself: applications_bench_test.py PARTWISE"""

import io
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path

import applications_bench as bench
from harness import meshes

PARTWISE = ""
CORNERS = [(x, y, z) for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)]
BOX = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


class Judge(unittest.TestCase):
    def test_winding(self):
        self.assertAlmostEqual(bench.winding(CORNERS, BOX, (0.3, 0.6, 0.2)), 1, delta=1e-12)
        self.assertAlmostEqual(bench.winding(CORNERS, BOX, (1.3, 0.6, 0.2)), 0, delta=1e-12)
        self.assertAlmostEqual(bench.winding(CORNERS, BOX[:2], (0.5, 0.5, 0.5)), 1 / 6, delta=1e-12)

    def test_closed(self):
        self.assertTrue(bench.is_closed(BOX))
        self.assertFalse(bench.is_closed(BOX[1:]))
        self.assertFalse(bench.is_closed([BOX[0][::-1], *BOX[1:]]))

    def test_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            meshes.write_off(Path(folder) / "box.off", CORNERS, BOX)
            for words in ([], ["--repair", "0.3", "--gone", "0.1"]):
                with redirect_stdout(io.StringIO()) as out:
                    status = bench.main([folder, "--program", PARTWISE, *words])
                self.assertEqual(status, 0, out.getvalue())
                self.assertNotIn("MISSED", out.getvalue())
                self.assertIn("holds", out.getvalue())


if __name__ == "__main__":
    PARTWISE = sys.argv.pop()
    unittest.main()
