"""decompose_check on decompositions whose answers are known in closed form: decompose_check_test.py PROGRAM"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = ""


def prism(polygon, height):
    """A closed prism over a counter-clockwise polygon that is star-shaped around its first corner; triangles."""
    n = len(polygon)
    vertices = [(x, y, z) for z in (0.0, height) for x, y in polygon]
    faces = []
    for i in range(1, n - 1):
        faces += [(0, i + 1, i), (n, n + i, n + i + 1)]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j), (i, n + j, n + i)]
    return vertices, faces


def box(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    vertices, faces = prism([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], z1 - z0)
    return [(x, y, z + z0) for x, y, z in vertices], faces


# Two arms, 2 long, 1 wide, 1 high, with one notch at (1, 1); the smallest sphere has its centre there.
L_SHAPE = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 1.0)
L_RADIUS = 1.5
L_HULL = prism([(0, 0), (2, 0), (2, 1), (1, 2), (0, 2)], 1.0)
L_ARMS = [box((0, 0, 0), (2, 1, 1)), box((0, 0, 0), (1, 2, 1))]
L_LABELS = [0 if max(L_SHAPE[0][corner][1] for corner in face) <= 1 else 1 for face in L_SHAPE[1]]
CUBE = box((0, 0, 0), (1, 1, 1))
CUBE_RADIUS = math.sqrt(3) / 2


def check(mesh, labels, hulls, *options):
    """Writes the files, runs the judge; its report and exit status."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        vertices, faces = mesh
        lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
        lines += ["%r %r %r" % tuple(map(float, v)) for v in vertices]
        lines += ["3 %d %d %d" % f for f in faces]
        (folder / "mesh.off").write_text("\n".join(lines) + "\n")
        (folder / "labels.seg").write_text("".join(f"{label}\n" for label in labels))
        lines, first = [], 1
        for number, (hull_vertices, hull_faces) in enumerate(hulls):
            lines.append(f"o part_{number}")
            lines += ["v %r %r %r" % tuple(map(float, v)) for v in hull_vertices]
            lines += ["f %d %d %d" % tuple(first + c for c in f) for f in hull_faces]
            first += len(hull_vertices)
        (folder / "hulls.obj").write_text("\n".join(lines) + "\n")
        run = subprocess.run([PROGRAM, folder / "mesh.off", folder / "labels.seg", folder / "hulls.obj", *options],
                             capture_output=True, text=True)
        return (json.loads(run.stdout) if run.stdout else run.stderr), run.returncode


def joined(*meshes):
    vertices, faces = [], []
    for mesh_vertices, mesh_faces in meshes:
        faces += [tuple(len(vertices) + corner for corner in face) for face in mesh_faces]
        vertices += mesh_vertices
    return vertices, faces


def inverted(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]


class Closed(unittest.TestCase):
    def test_cube_in_its_hull(self):
        report, status = check(CUBE, [0] * 12, [CUBE], "--tolerance", "0.1")
        self.assertEqual((status, report["failures"], report["parts"]), (0, [], 1))
        self.assertAlmostEqual(report["radius"], CUBE_RADIUS, 12)
        self.assertAlmostEqual(report["min_hull_volume"], CUBE_RADIUS**-3, 12)
        self.assertAlmostEqual(report["exposure_strict"], 0, 12)
        self.assertLess(report["exposure_strict_bound"], 2e-2)
        self.assertAlmostEqual(report["volume_ratio"], 1, 9)
        self.assertAlmostEqual(report["interior_uncovered"], 0, 9)
        self.assertTrue(report["exposure_certified"])

    def test_l_in_one_hull(self):
        """The deepest point of the notch's hypotenuse is its middle, 1/2 from both walls."""
        report, status = check(L_SHAPE, [0] * 20, [L_HULL], "--tolerance", "0.1")
        self.assertEqual(status, 3)
        self.assertEqual(len(report["failures"]), 1)
        self.assertAlmostEqual(report["radius"], L_RADIUS, 12)
        for name in ("exposure", "exposure_strict"):
            self.assertLessEqual(report[name], 0.5 / L_RADIUS + 1e-12)
            self.assertGreater(report[name], 0.5 / L_RADIUS - 2.1e-3)
            self.assertGreaterEqual(report[name], report[name + "_sampled"])
            self.assertGreaterEqual(report[name + "_bound"], 0.5 / L_RADIUS)
        self.assertLess(abs(report["volume_ratio"] - 7 / 6), 4 * report["volume_ratio_error"] + 1e-9)
        self.assertLess(report["volume_ratio_error"], 2e-3)
        self.assertAlmostEqual(report["volume_mesh"], 3, 12)

    def test_tolerance_decides(self):
        """At 0.3335 R the same hull is within tolerance, and certified although that is closer than the search's gap."""
        report, status = check(L_SHAPE, [0] * 20, [L_HULL], "--tolerance", "0.3335")
        self.assertEqual((status, report["exposure_certified"]), (0, True))

    def test_l_in_two_boxes(self):
        report, status = check(L_SHAPE, L_LABELS, L_ARMS, "--tolerance", "0.01")
        self.assertEqual((status, report["failures"], report["parts"]), (0, [], 2))
        self.assertLess(report["exposure_strict_bound"], 2e-2)
        self.assertAlmostEqual(report["volume_ratio"], 1, 9)

    def test_swapped_hulls(self):
        report, status = check(L_SHAPE, L_LABELS, L_ARMS[::-1])
        self.assertEqual((status, report["labels_match_hulls"]), (3, False))
        self.assertAlmostEqual(report["hull_outside"], 1 / L_RADIUS, 12)
        self.assertAlmostEqual(report["outside_all_hulls"], 0, 12)

    def test_coinciding_hulls_do_not_excuse_each_other(self):
        report, _ = check(L_SHAPE, L_LABELS, [L_HULL, L_HULL])
        self.assertGreater(report["exposure"], 0.48 / L_RADIUS)
        self.assertGreaterEqual(report["exposure_bound"], 0.5 / L_RADIUS)

    def test_cavity(self):
        """A cube with a hollow: its middle is 1 from the wall, but strictly inside a second hull it is not exposed."""
        outer, inner = box((0, 0, 0), (4, 4, 4)), inverted(box((1, 1, 1), (3, 3, 3)))
        report, _ = check(joined(outer, inner), [0] * 12 + [1] * 12, [outer, outer])
        radius = 2 * math.sqrt(3)
        self.assertAlmostEqual(report["volume_mesh"], 56, 12)
        self.assertLess(abs(report["volume_solid"] - 56), 1)
        self.assertLess(abs(report["volume_ratio"] - 64 / 56), 4 * report["volume_ratio_error"])
        self.assertLess(abs(report["exposure_strict"] - 1 / radius), 2.1e-3)
        self.assertAlmostEqual(report["exposure"], 0, 9)

    def test_overlapping_components_count_once(self):
        boxes = [box((0, 0, 0), (1, 1, 1)), box((0.5, 0, 0), (1.5, 1, 1))]
        report, status = check(joined(*boxes), [0] * 12 + [1] * 12, boxes, "--tolerance", "0.01")
        self.assertEqual((status, report["failures"]), (0, []))
        self.assertAlmostEqual(report["volume_ratio"], 1, 9)
        self.assertLess(abs(report["volume_solid"] - 1.5), 0.02)

    def test_half_covered(self):
        report, status = check(CUBE, [0] * 12, [box((0, 0, 0), (0.5, 1, 1))])
        self.assertEqual(status, 3)
        self.assertAlmostEqual(report["hull_outside"], 0.5 / CUBE_RADIUS, 12)
        self.assertLess(abs(report["interior_uncovered"] - 0.5), 4 * report["interior_uncovered_error"])
        self.assertLess(abs(report["volume_ratio"] - 0.5), 4 * report["volume_ratio_error"])
        self.assertLess(report["interior_uncovered_error"], 2e-3)


class Open(unittest.TestCase):
    def test_cube_without_lid(self):
        """Nothing is inside an open mesh: the middle of the lid is half an edge from the walls."""
        vertices, faces = CUBE
        report, status = check((vertices, faces[:1] + faces[2:3] + faces[4:]), [0] * 10, [CUBE])
        self.assertEqual((status, report["closed"]), (0, False))
        self.assertLess(abs(report["exposure"] - 0.5 / CUBE_RADIUS), 2.1e-3)
        self.assertIsNone(report["volume_ratio"])
        self.assertIsNone(report["interior_uncovered"])
        self.assertLess(abs(report["volume_union"] - 1), 4 * report["volume_union_error"])


class Broken(unittest.TestCase):
    def test_hull_that_misses_a_vertex(self):
        """Without (1, 1, 1) the cube's hull ends at x + y + z = 2."""
        vertices, faces = CUBE
        last = vertices.index((1, 1, 1))
        cut = [face for face in faces if last not in face]
        edges = {(a, b) for face in cut for a, b in zip(face, face[1:] + face[:1])}
        rim = {b: a for a, b in edges if (b, a) not in edges}
        corner = min(rim)
        walk = [corner]
        while rim[walk[-1]] != corner:
            walk.append(rim[walk[-1]])
        cut += [(walk[0], walk[i], walk[i + 1]) for i in range(1, len(walk) - 1)]
        report, status = check(CUBE, [0] * 12, [(vertices[:last] + vertices[last + 1:],
                                                 [tuple(c - (c > last) for c in face) for face in cut])])
        self.assertEqual(status, 3)
        self.assertTrue(report["hulls_closed"])
        self.assertAlmostEqual(report["hull_outside"], 1 / math.sqrt(3) / CUBE_RADIUS, 12)

    def test_not_convex(self):
        report, status = check(L_SHAPE, [0] * 20, [L_SHAPE])
        self.assertEqual((status, report["hulls_convex"], report["hulls_closed"]), (3, False, True))

    def test_not_closed(self):
        report, status = check(CUBE, [0] * 12, [(CUBE[0], CUBE[1][:-1])])
        self.assertEqual((status, report["hulls_closed"]), (3, False))

    def test_inside_out(self):
        report, status = check(CUBE, [0] * 12, [inverted(CUBE)])
        self.assertEqual((status, report["hulls_convex"]), (3, False))

    def test_flat(self):
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        report, status = check(CUBE, [0] * 12, [(square, [(0, 2, 1), (0, 3, 2), (0, 1, 2), (0, 2, 3)])])
        self.assertEqual((status, report["min_hull_volume"]), (3, 0))

    def test_disconnected_part(self):
        two = joined(CUBE, box((3, 0, 0), (4, 1, 1)))
        report, _ = check(two, [0] * 24, [box((0, 0, 0), (4, 1, 1))])
        self.assertFalse(report["parts_connected"])

    def test_labels(self):
        for labels in ([0] * 11, [1] * 12, [0] * 6 + [2] * 6, [-1] + [0] * 11):
            report, status = check(CUBE, labels, [CUBE])
            self.assertEqual((status, report["labels_complete"]), (3, False))

    def test_more_hulls_than_parts(self):
        report, status = check(CUBE, [0] * 12, [CUBE, CUBE])
        self.assertIn("there is not one hull a part", report["failures"])

    def test_unreadable(self):
        message, status = check((CUBE[0], [(0, 1, 8)]), [0], [CUBE])
        self.assertEqual(status, 1)
        self.assertIn("mesh.off:11", message)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
