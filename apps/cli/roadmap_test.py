#!/usr/bin/env python3
"""partwise roadmap, looked at through its files by distances of our own. roadmap_test.py PARTWISE"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
REPOSITORY = Path(__file__).resolve().parents[2]
TOWN = REPOSITORY / "data" / "city" / "kronstadt.geojson"
EARTH = 6371008.8


def footprints(path):
    """Rings in metres about the centre of the file's box, a list of them a footprint."""
    all_rings = [feature["geometry"]["coordinates"] for feature in json.loads(path.read_text())["features"]]
    corners = [corner for rings in all_rings for ring in rings for corner in ring]
    middle = [(min(c[k] for c in corners) + max(c[k] for c in corners)) / 2 for k in (0, 1)]
    scale = EARTH * math.pi / 180

    def projected(corner):
        return (scale * math.cos(math.radians(middle[1])) * (corner[0] - middle[0]), scale * (corner[1] - middle[1]))

    return [[[projected(corner) for corner in ring] for ring in rings] for rings in all_rings]


def distance(rings, x, y):
    """To the nearest point of the sides, and whether (x, y) is inside."""
    best, inside = math.inf, False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:], strict=False):
            length2 = (bx - ax) ** 2 + (by - ay) ** 2
            t = min(1, max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length2)) if length2 else 0
            best = min(best, math.hypot(ax + t * (bx - ax) - x, ay + t * (by - ay) - y))
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
    return best, inside


def box_obj(boxes):
    lines, offset = [], 0
    for x0, y0, z0, x1, y1, z1 in boxes:
        lines += [f"v {x} {y} {z}" for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
        for face in ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)):
            lines.append("f " + " ".join(str(corner + offset) for corner in face))
        offset += 8
    return "\n".join(lines) + "\n"


class Roadmap(unittest.TestCase):
    def setUp(self):
        self.shared = tempfile.TemporaryDirectory()
        self.addCleanup(self.shared.cleanup)
        self.folder = Path(self.shared.name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, "roadmap", *map(str, arguments)], capture_output=True, text=True, timeout=300, cwd=self.folder)

    def done(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def report(self, *arguments):
        return json.loads(self.done(*arguments, "--json", "-").stdout)

    def refused(self, status, *words, arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        if status == 1:
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.suffix in (".txt", ".svg", ".glb")], [])

    def rows(self, name):
        return [[float(word) for word in line.split()] for line in (self.folder / name).read_text().splitlines()]

    def test_samples_of_a_town_are_where_they_say(self):
        report = self.report(TOWN, "--samples", 300, "--samples-out", "a.txt", "--svg", "a.svg")
        for field in ("samples", "on_axis", "edges", "distance_queries", "seconds"):
            self.assertIn(field, report)
        self.assertEqual((report["samples"], report["on_axis"]), (300, 1))
        self.assertGreater(report["edges"], 600)
        town = footprints(TOWN)
        rows = self.rows("a.txt")
        self.assertEqual(len(rows), 300)
        for x, y, first, second in rows:
            found = [distance(rings, x, y) for rings in town]
            self.assertFalse(any(inside for _, inside in found))
            nearest = sorted(away for away, _ in found)
            self.assertAlmostEqual(first, nearest[0], delta=1e-6)
            self.assertTrue(any(abs(second - away) < 1e-6 for away in nearest[1:8]))
            self.assertLessEqual(second - first, 0.02 * first)
            self.assertLessEqual(nearest[1] - nearest[0], 0.02 * nearest[0] + 1e-6)
        self.assertIn("<svg", (self.folder / "a.svg").read_text())

    def test_the_limit_keeps_the_middle(self):
        self.assertEqual(self.report(TOWN, "--limit", 50, "--samples", 50)["obstacles"], 50)
        near = sorted(min(distance(rings, 0, 0)[0], 1e9) for rings in footprints(TOWN))
        self.done(TOWN, "--limit", 50, "--samples", 200, "--samples-out", "b.txt")
        for x, y, first, _ in self.rows("b.txt"):
            self.assertLess(math.hypot(x, y) - first, 3 * near[49] + 1)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.done(TOWN, "--limit", 100, "--samples", 500, "--samples-out", f"{threads}.txt", "--svg", f"{threads}.svg", "--threads", threads)
        for ending in ("txt", "svg"):
            self.assertEqual((self.folder / f"1.{ending}").read_bytes(), (self.folder / f"2.{ending}").read_bytes())
        self.done(TOWN, "--limit", 100, "--samples", 500, "--samples-out", "3.txt", "--seed", 7)
        self.assertNotEqual((self.folder / "1.txt").read_bytes(), (self.folder / "3.txt").read_bytes())

    def test_methods_and_steps(self):
        shares = {}
        for method in ("svma", "maprm-exact", "maprm"):
            report = self.report(TOWN, "--limit", 100, "--samples", 300, "--method", method)
            self.assertEqual(report["samples"], 300)
            shares[method] = report["on_axis"]
        self.assertEqual(shares["svma"], 1)
        self.assertGreater(shares["maprm-exact"], 0.9)
        self.assertGreater(shares["maprm-exact"], shares["maprm"])
        for step in ("svm", "clearance", "combined"):
            self.assertEqual(self.report(TOWN, "--limit", 100, "--samples", 100, "--step", step)["on_axis"], 1)

    def test_hollows_have_an_axis_where_parts_are_obstacles(self):
        outer = [[0, 0], [1e-3, 0], [1e-3, 1e-3], [7e-4, 1e-3], [7e-4, 2e-4], [3e-4, 2e-4], [3e-4, 1e-3], [0, 1e-3], [0, 0]]
        other = [[2e-3, 0], [3e-3, 0], [3e-3, 1e-3], [2e-3, 1e-3], [2e-3, 0]]
        (self.folder / "u.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}} for ring in (outer, other)]}))
        scale = EARTH * math.pi / 180

        def in_hollow(name):
            return sum(abs(x - (5e-4 - 1.5e-3) * scale) < 1e-4 * scale and -2e-4 * scale < y < 4e-4 * scale for x, y, *_ in self.rows(name))

        self.done("u.geojson", "--samples", 300, "--samples-out", "whole.txt")
        self.done("u.geojson", "--samples", 300, "--samples-out", "parts.txt", "--tolerance", 0.05)
        self.assertEqual(in_hollow("whole.txt"), 0)
        self.assertGreater(in_hollow("parts.txt"), 10)

    def test_a_mesh_in_space(self):
        (self.folder / "boxes.obj").write_text(box_obj([(0, 0, 0, 1, 4, 4), (3, 0, 0, 4, 4, 4)]))
        report = self.report("boxes.obj", "--samples", 300, "--samples-out", "c.txt", "--glb", "c.glb")
        self.assertEqual((report["obstacles"], report["on_axis"]), (2, 1))
        for x, _, _, first, second in self.rows("c.txt"):
            self.assertAlmostEqual(x, 2, delta=0.02 * first)
            self.assertGreaterEqual(second, first)
        self.assertEqual((self.folder / "c.glb").read_bytes()[:4], b"glTF")

    def test_what_cannot_be_done(self):
        (self.folder / "empty.geojson").write_text('{"type": "FeatureCollection", "features": []}')
        (self.folder / "bad.geojson").write_text('{"type": "FeatureCollection", "features"')
        (self.folder / "line.geojson").write_text('{"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [2, 2], [0, 0]]]}')
        (self.folder / "box.obj").write_text(box_obj([(0, 0, 0, 1, 1, 1)]))
        out = ["--samples-out", "x.txt"]
        self.refused(1, "empty.geojson", "footprints", arguments=["empty.geojson", *out])
        self.refused(1, "bad.geojson", "JSON", arguments=["bad.geojson", *out])
        self.refused(1, "line.geojson", "area", arguments=["line.geojson", *out])
        self.refused(1, "missing.geojson", arguments=["missing.geojson", *out])
        self.refused(1, "two", arguments=[TOWN, "--limit", 1, *out])
        self.refused(1, "two", arguments=["box.obj", *out])
        self.refused(2, "--limit", arguments=["box.obj", "--limit", 3])
        self.refused(2, "--svg", arguments=["box.obj", "--svg", "x.svg"])
        self.refused(2, "--glb", arguments=[TOWN, "--glb", "x.glb"])
        self.refused(2, "--epsilon", arguments=[TOWN, "--epsilon", "0"])
        self.refused(2, "svma", arguments=[TOWN, "--method", "rrt"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
