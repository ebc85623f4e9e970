"""The visibility benchmark on small answers known beforehand, and on shipped models: visibility_bench_test.py PARTWISE MODELS"""

import io
import itertools
import json
import math
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path

import visibility_bench
from harness import histograms, meshes, process, visibility
from harness.dissertation import SIZE_CLASSES

PARTWISE = MODELS = Path()
SIDES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
         (1, 5, 7), (1, 7, 3)]


def box(x, y, z):
    return [tuple(map(float, corner)) for corner in itertools.product((0, x), (0, y), (0, z))]


class Bench(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.box = self.folder / "box.off"
        meshes.write_off(self.box, box(6, 4, 2), SIDES)

    def tool(self, name, *words):
        run = process.run([PARTWISE.with_name(name), *words], 60)
        self.assertEqual(run.trouble, "")
        return json.loads(run.output) if run.output else None

    def bench(self, folder, *options):
        printed = io.StringIO()
        with redirect_stdout(printed):
            visibility_bench.main([str(folder), "--program", str(PARTWISE), "--tools", str(PARTWISE.parent), *options])
        return printed.getvalue()

    def row(self, printed, name):
        return next(line.split() for line in printed.splitlines() if line.startswith(name))


class Methods(Bench):
    def test_all_agree_on_a_convex_solid(self):
        report = self.tool("visibility_compare", self.box)
        self.assertEqual(report["vertices"], 8)
        for name in visibility.OTHERS:
            self.assertEqual(report["methods"][name]["regions_differ"], 0)
        self.assertEqual(report["methods"]["bfs"]["tests"], 8 * 7)  # every vertex by every other, once

    def test_filter_is_exact_on_a_shipped_model_and_others_are_caught(self):
        report = self.tool("visibility_compare", MODELS / "dog.obj")
        methods = report["methods"]
        self.assertEqual(methods["filter"], methods["filter"] | dict.fromkeys(
            ("regions_differ", "values_differ", "difference", "vertices_differ"), 0))
        for name in ("filter-printed", "bfs-plain"):
            self.assertGreater(methods[name]["values_differ"], 0.1 * report["vertices"])
            self.assertGreater(methods[name]["difference"], 0.001)
        for name in methods:
            self.assertEqual(methods[name]["tests"], self.tool(
                "partwise", "feature", MODELS / "dog.obj", "--kind", "cvf", "--method", name, "--json", "-")["visibility_tests"])

    def test_values_are_the_programs(self):
        def values(method):
            file = self.folder / method
            self.tool("partwise", "feature", MODELS / "dog.obj", "--kind", "cvf", "--method", method, "--values", file, "--quiet")
            return [float(line) for line in file.read_text().split()]
        self.assertEqual(values("filter"), values("bfs"))
        differences = [abs(a / b - 1) for a, b in zip(values("bfs-plain"), values("bfs"))]
        method = self.tool("visibility_compare", MODELS / "dog.obj")["methods"]["bfs-plain"]
        self.assertAlmostEqual(method["difference"], sum(differences) / len(differences), 9)
        self.assertEqual(method["values_differ"], sum(difference > 1e-12 for difference in differences))

    def test_totals(self):
        def report(vertices, bfs, ours, differ, difference):
            method = {"tests": ours, "regions_differ": differ, "values_differ": differ, "difference": difference}
            return {"vertices": vertices, "methods": {"bfs": {"tests": bfs}} | dict.fromkeys(visibility.OTHERS, method)}
        total = visibility.methods_totals([report(10, 100, 50, 1, 0.2), report(30, 900, 90, 3, 0.0)])
        self.assertAlmostEqual(total["filter"]["saved"], 1 - 140 / 1000)
        self.assertAlmostEqual(total["filter"]["saved_mean"], (0.5 + 0.9) / 2)
        self.assertAlmostEqual(total["bfs-plain"]["difference"], 0.05)
        self.assertEqual(total["bfs-plain"]["share_differ"], 0.1)
        self.assertEqual([visibility.size_class(n) for n in (4999, 5000, 10000, 10001)],
                         [SIZE_CLASSES[0], SIZE_CLASSES[1], SIZE_CLASSES[1], SIZE_CLASSES[2]])

    def test_table(self):
        printed = self.bench(MODELS, "--only", "dog", "--methods")
        self.assertIn("filter differs from bfs at 0 of 693 vertices (regions), 0 (values)", printed)
        self.assertEqual(self.row(printed, "under 5k")[2], "1")


class Times(Bench):
    def test_exponent_of_a_power_law(self):
        self.assertAlmostEqual(visibility.exponent([10, 20, 70], [3 * n**1.7 for n in (10, 20, 70)]), 1.7, 12)
        self.assertIsNone(visibility.exponent([10], [1]))

    def test_growth_of_a_box(self):
        printed = self.bench(self.folder, "--growth", "500", "1000")
        vertices = [int(line.split()[2]) for line in printed.splitlines() if line.startswith("box")]
        for size, found in zip((500, 1000), vertices, strict=True):
            self.assertLess(abs(found - size), 0.2 * size)

    def test_times(self):
        printed = self.bench(MODELS, "--only", "table", "--times")
        self.assertEqual(self.row(printed, "under 5k")[2:4], ["1", "776"])


class Variants(Bench):
    def test_noise_moves_every_vertex_by_less_than_its_amplitude(self):
        noisy = {}
        for seed in (1, 1, 2):
            self.tool("mesh_variant", self.box, self.folder / "noisy.off", "--noise", 0.01, "--seed", seed)
            vertices, faces = meshes.read_off(self.folder / "noisy.off")
            self.assertEqual(noisy.setdefault(seed, vertices), vertices)
            self.assertEqual(faces, SIDES)
            steps = [math.dist(a, b) / math.sqrt(14) for a, b in zip(vertices, box(6, 4, 2))]  # R is half the diagonal
            self.assertLessEqual(max(steps), 0.01)
            self.assertGreater(min(steps), 0)
        self.assertNotEqual(noisy[1], noisy[2])

    def test_finer_is_the_same_shape_within_its_waves(self):
        self.tool("mesh_variant", self.box, self.folder / "finer.off", "--vertices", 2000)
        vertices, faces = meshes.read_off(self.folder / "finer.off")
        self.assertLess(abs(len(vertices) - 2000), 200)
        self.assertLess(abs(meshes.volume(vertices, faces) / 48 - 1), 0.01)
        for p in vertices:
            self.assertLess(min(min(abs(c), abs(c - high)) for c, high in zip(p, (6, 4, 2))), 0.002 * math.sqrt(14) + 1e-9)


class Histograms(Bench):
    def test_areas_and_levels(self):
        areas = histograms.vertex_areas(box(6, 4, 2), SIDES)
        self.assertAlmostEqual(sum(areas), 88)
        bins = histograms.histogram([88.0, 44.0, 0.0] + [1e9] * 5, areas, "cvf")
        self.assertAlmostEqual(sum(bins), 1)
        self.assertAlmostEqual(bins[90], areas[1] / 88)  # half of the area: one octave of ten below the end
        self.assertAlmostEqual(bins[0], areas[2] / 88)
        self.assertAlmostEqual(bins[99], 1 - (areas[1] + areas[2]) / 88)

    def test_distance_is_in_octaves(self):
        areas = [1.0, 2.0, 3.0]
        a, b = (histograms.histogram([factor * value for value in (1.5, 2.5, 0.7)], areas, "cvf") for factor in (1, 0.25))
        self.assertAlmostEqual(histograms.earth_movers_distance(a, b), 2)
        self.assertAlmostEqual(histograms.earth_movers_distance(b, a), 2)
        self.assertEqual(histograms.earth_movers_distance(a, a), 0)

    def test_share_nearer(self):
        self.assertEqual(histograms.share_nearer([1, 2], [3, 4]), 1)
        self.assertEqual(histograms.share_nearer([3, 4], [1, 2]), 0)
        self.assertEqual(histograms.share_nearer([1, 3], [2, 3]), (2 + 0.5) / 4)
        self.assertIsNone(histograms.share_nearer([], [1]))

    def test_pairs(self):
        found = {Path(f"{n}.off"): {0: n, 0.01: -n} for n in (1, 2, 81)}  # two humans and an ant
        groups = histograms.pairs_of(found, meshes.princeton_category, [0.01])
        self.assertEqual(groups, {"noise 1 %": [(1, -1), (2, -2), (81, -81)], "pose: human": [(1, 2)],
                                  "other": [(1, 81), (2, 81)]})

    def test_scaled_meshes_are_alike_and_noise_is_not(self):
        self.tool("mesh_variant", MODELS / "table.obj", self.folder / "table.off")
        vertices, faces = meshes.read_off(self.folder / "table.off")
        scaled = self.folder / "scaled.off"
        meshes.write_off(scaled, [tuple(4 * c for c in p) for p in vertices], faces)
        settings = visibility.Settings(PARTWISE, PARTWISE.parent)
        clean, large, noisy = (histograms.histograms_of(settings, path, noise) for path, noise in (
            (self.folder / "table.off", 0), (scaled, 0), (scaled, 0.02)))
        for kind in histograms.KINDS:
            self.assertLess(histograms.earth_movers_distance(clean[kind], large[kind]), 0.01, kind)
            self.assertGreater(histograms.earth_movers_distance(clean[kind], noisy[kind]), 0.05, kind)

    def test_table(self):
        for name, size in (("a", 3), ("b", 1)):
            (self.folder / name).mkdir()
            meshes.write_off(self.folder / name / f"{name}.off", box(size, 1, 1), SIDES)
        printed = self.bench(self.folder, "--histograms", "--only", "a,b", "--amplitudes", "0.005")
        self.assertEqual(self.row(printed, "cvf-avg")[-1], "0.000")  # both are convex
        self.assertIn("pairs: noise 0.5 % 2, other 1", printed)


class Medial(Bench):
    """A box of 6 x 4 x 2: the middle of its axis is the rectangle of 4 x 2 at half its height, where balls have the radius 1."""

    def judged(self, points, *options):
        file = self.folder / "points.ply"
        file.write_text("ply\nend_header\n" + "".join("%r %r %r %r\n" % point for point in points))
        return self.tool("medial_check", self.box, file, "--samples", 20000, *options)

    def middle(self, height=1.0, radius=1.0):
        return [(1.05 + 0.1 * i, 1.05 + 0.1 * j, height, radius) for i in range(40) for j in range(20)]

    def test_points_of_the_axis(self):
        report = self.judged(self.middle(), "--least-angle", 150)  # without the sheets to the edges
        self.assertEqual(report["inside"], 1)
        for name in ("to_axis", "from_axis", "repeat"):
            self.assertLess(report[name]["p95"], 0.05, name)
        self.assertLess(report["radius_error"]["max"], 1e-9)

    def test_points_beside_the_axis_and_wrong_radii(self):
        report = self.judged(self.middle(height=0.5), "--least-angle", 150)
        self.assertAlmostEqual(report["to_axis"]["mean"], 0.5 / math.sqrt(14), 2)
        self.assertAlmostEqual(report["radius_error"]["mean"], 0.5 / math.sqrt(14), 9)
        self.assertEqual(self.judged(self.middle(height=-1))["inside"], 0)

    def test_what_is_left_out(self):
        half = [point for point in self.middle() if point[0] < 3]
        report = self.judged(half, "--least-angle", 150)
        self.assertLess(report["to_axis"]["p95"], 0.05)
        self.assertGreater(report["from_axis"]["p95"], 1.5 / math.sqrt(14))

    def test_the_sheets_to_the_edges_are_part_of_it(self):
        """Their two faces are a right angle apart, so that they are left out above 90 degrees."""
        self.assertGreater(self.judged(self.middle())["from_axis"]["p95"], 0.2)

    def test_the_programs_samples(self):
        printed = self.bench(self.folder, "--medial", "--only", "box", "--samples", "10000")
        row = [word for word in self.row(printed, "box") if word != "|"]
        self.assertLess(float(row[4]), 0.03)
        self.assertLess(float(row[6]), 0.06)
        self.assertEqual(row[-1], "1.000")


class Choice(Bench):
    def test_spread_over_categories_and_sizes(self):
        paths = []
        for category, count in (("a", 4), ("b", 1)):
            (self.folder / category).mkdir()
            for k in range(count):
                path = self.folder / category / f"{k}.off"
                path.write_text("#" * (10 - k))
                paths.append(path)
        chosen = meshes.spread(paths, 4, meshes.folder_category)
        self.assertEqual([(path.parent.name, path.stem) for path in chosen], [("a", "0"), ("a", "2"), ("b", "0")])
        self.assertEqual(meshes.spread(paths, 100, meshes.folder_category), paths)


if __name__ == "__main__":
    MODELS, PARTWISE = Path(sys.argv.pop(2)), Path(sys.argv.pop(1))
    unittest.main()
