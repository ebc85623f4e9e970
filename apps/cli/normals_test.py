#!/usr/bin/env python3
"""partwise normals on a rendered ball, with the network that ships: axes in every format, where there are normals, and
what is refused. normals_test.py PARTWISE"""

import json
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import cli_test

PROGRAM = Path(sys.argv[1]).resolve()
SIZE = 96


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=cwd)


def png(rows, colour, depth=8):
    """A PNG of rows of bytes. `colour`: 0 grey, 2 RGB, 4 grey and alpha, 6 RGB and alpha."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    header = struct.pack(">IIBBBBB", len(rows[0]) * 8 // (channels * depth), len(rows), depth, colour, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows)))
            + chunk(b"IEND", b""))


class Normals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        folder = cls.folder = Path(cls.shared.name)
        done = run("material", "ball", "green-plastic", "--size", SIZE, "-o", "ball.png", "--quiet", cwd=folder)
        assert done.returncode == 0, done.stderr
        width, _, _, _, rows = cli_test.png_rows((folder / "ball.png").read_bytes())
        ball = cls.ball = [[tuple(row[4 * x:4 * x + 4]) for x in range(width)] for row in rows]
        (folder / "mask.png").write_bytes(png([[255 if pixel[3] > 127 else 0 for pixel in row] for row in ball], 0))
        clear, margin = (255, 255, 255, 0), 10  # the ball reaches to the border of its own picture
        wide = [clear] * (SIZE + 2 * margin)
        on_white = [wide] * margin + [[clear] * margin + row + [clear] * margin for row in ball] + [wide] * margin
        (folder / "plain.png").write_bytes(png([[value for r, g, b, a in row for value in ((r, g, b) if a > 127 else (255, 255, 255))]
                                                for row in on_white], 2))
        (folder / "grey.png").write_bytes(png([[value for r, g, b, a in row for value in (max(r, g, b), a)] for row in ball], 4))
        (folder / "deep.png").write_bytes(png([[value for pixel in row for value in pixel for value in (value, value)] for row in ball], 6, 16))
        (folder / "noise.png").write_bytes(png([[(37 * x * y + 91 * x) % 256 for x in range(3 * SIZE)] for y in range(SIZE)], 2))

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def normals(self, *arguments):
        return run("normals", *arguments, cwd=self.folder)

    def read(self, name):
        """Rows of vectors of a PNG; none where it is middle grey."""
        width, _, depth, _, rows = cli_test.png_rows((self.folder / name).read_bytes())
        largest, words = 2**depth - 1, {8: "B", 16: "H"}[depth]
        result = []
        for row in rows:
            codes = struct.unpack(f">{3 * width}{words}", bytes(row))
            vectors = [tuple(2 * code / largest - 1 for code in codes[3 * x:3 * x + 3]) for x in range(width)]
            result.append([vector if max(map(abs, vector)) > 0.01 else None for vector in vectors])
        return result

    def agreement(self, rows):
        """Mean cosine between normals and the ball's own. Where there are normals and where not is checked."""
        total, count = 0, 0
        seen = [(x, y) for y in range(SIZE) for x in range(SIZE) if self.ball[y][x][3] > 127]
        radius = (max(x for x, _ in seen) - min(x for x, _ in seen) + 1) / 2
        middle = [(max(each) + min(each)) / 2 for each in zip(*seen)]
        for y, row in enumerate(rows):
            for x, vector in enumerate(row):
                self.assertEqual(vector is not None, self.ball[y][x][3] > 127, (x, y))
                if vector is None:
                    continue
                self.assertAlmostEqual(sum(value * value for value in vector), 1, delta=0.02)
                right, up = (x - middle[0]) / radius, (middle[1] - y) / radius
                toward = max(0, 1 - right * right - up * up)**0.5
                total, count = total + right * vector[0] + up * vector[1] + toward * vector[2], count + 1
        return total / count

    def test_axes_of_a_ball_in_every_format(self):
        done = self.normals("ball.png", "-o", "a.png", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual((report["width"], report["height"], report["model"]), (SIZE, SIZE, "single"))
        self.assertEqual(report["pixels"], sum(pixel[3] > 127 for row in self.ball for pixel in row))
        sixteen = self.read("a.png")
        self.assertGreater(self.agreement(sixteen), 0.8)
        for side, where in (("left", lambda v: -v[0]), ("right", lambda v: v[0]), ("top", lambda v: v[1]), ("bottom", lambda v: -v[1])):
            x, y = {"left": (SIZE // 5, SIZE // 2), "right": (4 * SIZE // 5, SIZE // 2), "top": (SIZE // 2, SIZE // 5),
                    "bottom": (SIZE // 2, 4 * SIZE // 5)}[side]
            self.assertGreater(where(sixteen[y][x]), 0.1, side)
        self.assertGreater(sixteen[SIZE // 2][SIZE // 2][2], 0.7)
        self.assertEqual(self.normals("ball.png", "-o", "b.png", "--bits", 8, "--model", "single").returncode, 0)
        for row, coarse in zip(sixteen, self.read("b.png"), strict=True):
            for one, other in zip(row, coarse, strict=True):
                self.assertEqual(one is None, other is None)
                if one:
                    self.assertLess(max(abs(a - b) for a, b in zip(one, other, strict=True)), 2 / 255)
        self.assertEqual(self.normals("ball.png", "-o", "c.exr").returncode, 0)
        data = (self.folder / "c.exr").read_bytes()
        self.assertEqual(data[:4], b"v/1\x01")
        for channel in (b"X", b"Y", b"Z"):
            self.assertIn(channel + b"\0\x02\0\0\0", data)  # single precision

    def test_grey_sixteen_bits_masks_and_plain_backgrounds(self):
        self.assertEqual(self.normals("ball.png", "-o", "n.png").returncode, 0)
        reference = (self.folder / "n.png").read_bytes()
        for words in (["ball.png", "--mask", "mask.png"], ["deep.png"]):
            self.assertEqual(self.normals(*words, "-o", "m.png").returncode, 0, words)
            self.assertGreater(self.agreement(self.read("m.png")), 0.8, words)
        self.assertEqual((self.folder / "m.png").read_bytes(), reference)  # deep.png has the same values
        done = self.normals("grey.png", "-o", "g.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(self.agreement(self.read("g.png")), 0.7)
        done = self.normals("plain.png", "-o", "p.png", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        covered = sum(pixel[3] > 127 for row in self.ball for pixel in row)
        self.assertAlmostEqual(json.loads(done.stdout)["pixels"], covered, delta=0.1 * covered)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.assertEqual(self.normals("ball.png", "-o", f"t{threads}.png", "--threads", threads).returncode, 0)
        self.assertEqual((self.folder / "t1.png").read_bytes(), (self.folder / "t2.png").read_bytes())

    def test_what_is_refused(self):
        (self.folder / "text.png").write_text("no picture")
        shutil.copy(self.folder / "text.png", self.folder / "text.pt")
        small = [[255] * 10 for _ in range(10)]
        (self.folder / "small.png").write_bytes(png(small, 0))
        cases = [(["none.png", "-o", "d.png"], 1, "none.png"), (["text.png", "-o", "d.png"], 1, "text.png"),
                 (["noise.png", "-o", "d.png"], 1, "--mask"), (["ball.png", "--mask", "small.png", "-o", "d.png"], 1, "small.png"),
                 (["ball.png", "--weights", "text.pt", "-o", "d.png"], 1, "text.pt"), (["ball.png", "-o", "nowhere/d.png"], 1, "nowhere"),
                 (["ball.png", "-o", "d.jpg"], 2, ".exr"), (["ball.png", "-o", "ball.png"], 2, "same file"), (["ball.png"], 2, "-o"),
                 (["ball.png", "--model", "many", "-o", "d.png"], 2, "single"), (["ball.png", "--bits", "12", "-o", "d.png"], 2, "16")]
        for arguments, status, word in cases:
            done = self.normals(*arguments)
            self.assertEqual(done.returncode, status, (arguments, done.stderr))
            self.assertIn(word, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "d.png").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
