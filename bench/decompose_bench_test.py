"""The harness on small answers known beforehand; and from end to end with a program of a few lines in place of partwise,
which puts a box around every mesh: decompose_bench_test.py CHECKER RIDGE_NOISE PARTWISE [HACD]"""

import io
import json
import math
import stat
import sys
import tempfile
import textwrap
import unittest
from contextlib import redirect_stdout
from pathlib import Path

import decompose_bench
from harness import meshes, process, summary
from harness.decompose import Settings, decompose
from harness.dissertation import AVERAGE, TABLE_2_3

CHECKER = RIDGE_NOISE = PARTWISE = HACD = ""
CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
SIDES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
         (1, 5, 7), (1, 7, 3)]

BOXER = textwrap.dedent("""\
    #!/usr/bin/python3
    import json, math, sys
    sys.path.insert(0, {bench!r})
    from harness import meshes
    words = sys.argv[1:]
    option = {{words[k]: words[k + 1] for k in range(2, len(words) - 1)}}
    vertices, faces = meshes.read_off(words[1])
    if len(faces) == 1:
        sys.exit("words of complaint")
    ends = [(min(p[k] for p in vertices), max(p[k] for p in vertices)) for k in range(3)]
    corners = [(x, y, z) for x in ends[0] for y in ends[1] for z in ends[2]]
    with open(option["--labels"], "w") as out:
        out.write("0\\n" * len(faces))
    with open(option["--hulls"], "w") as out:
        out.write("o box\\n" + "".join("v %r %r %r\\n" % p for p in corners))
        out.write("".join("f %d %d %d\\n" % tuple(c + 1 for c in f) for f in {sides!r}))
    if "--glb" in option:
        with open(option["--glb"], "w") as out:
            out.write({scene})
    with open(option["--json"], "w") as out:
        json.dump({{"parts": 1, "tolerance": 0.1, "concavity": 0, "volume_ratio": {ratio}, "watertight": True,
                   "radius": math.sqrt(3) / 2, "seconds": {{}}}}, out)
    """)


class Meshes(unittest.TestCase):
    def test_rotation_keeps_distances_and_handedness(self):
        for seed in range(5):
            turned = meshes.rotated(CORNERS, seed)
            self.assertAlmostEqual(meshes.volume(turned, SIDES), 1, 12)
            self.assertAlmostEqual(math.dist(turned[0], turned[7]), math.sqrt(3), 12)
            self.assertNotAlmostEqual(turned[7][0], 1, 3)
        self.assertEqual(meshes.rotated(CORNERS, 3), meshes.rotated(CORNERS, 3))

    def test_thinned_out(self):
        kept = meshes.thinned_out(list(range(1000)), 0.45, seed=1)
        self.assertEqual(len(kept), 550)
        self.assertEqual(kept, sorted(set(kept)))

    def test_files_and_categories(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("2", "10", "281"):
                meshes.write_off(Path(folder) / f"{name}.off", CORNERS, SIDES)
            paths = meshes.find(folder)
            self.assertEqual([path.stem for path in paths], ["2", "10", "281"])
            self.assertEqual(meshes.read_off(paths[0]), (CORNERS, SIDES))
            self.assertEqual([meshes.princeton_category(path) for path in paths], ["human", "human", "armadillo"])
            self.assertEqual(len(meshes.first_of_each(paths, meshes.princeton_category)), 2)


class Facts(unittest.TestCase):
    def test_averages_follow_from_the_rows(self):
        """The table as printed is consistent to its rounding."""
        for block, digits in ((0, 0.1), (1, 1.0), (2, 0.01)):
            for column in range(3):
                mean = sum(row[block][column] for row in TABLE_2_3.values()) / len(TABLE_2_3)
                self.assertLess(abs(mean - AVERAGE[block][column]), digits, (block, column, mean))

    def test_categories_have_the_benchmarks_names(self):
        self.assertEqual(set(TABLE_2_3), set(meshes.PRINCETON) - {"(none)"})


class Targets(unittest.TestCase):
    LIMITS = {("valley", 0.1): {"parts": 8.0, "volume_ratio": 1.36, "cpu_seconds": 0.8, "cpu_seconds_max": 4.0},
              ("hull", 0.1): {"parts": 8.0, "volume_ratio": 1.25, "cpu_seconds": 1.2, "uncovered": 0.005,
                              "uncovered_max": 0.05, "exposure_max": 0.1},
              ("hull", 0.05): {"parts": 16.0, "volume_ratio": 1.11, "exposure_max": 0.05}}

    def missed(self, measure, tolerance, changed):
        best = dict.fromkeys(summary.totals([]), 0) | {"meshes": 3, "finished": 3} | changed
        reached = summary.targets(best, Settings(Path(), measure=measure, tolerance=tolerance), princeton=True)
        return sum(state is False for text, state in reached if not text.startswith("stretch"))

    def test_each_holds_at_its_limit_and_not_above(self):
        for (measure, tolerance), limits in self.LIMITS.items():
            for name, limit in (limits | {"hull_outside_max": 1e-9}).items():
                self.assertEqual(self.missed(measure, tolerance, {name: limit}), 0, (measure, name))
                self.assertEqual(self.missed(measure, tolerance, {name: limit * 1.01}), 1, (measure, name))
            self.assertEqual(self.missed(measure, tolerance, {"finished": 2}), 1)
            self.assertEqual(self.missed(measure, tolerance, {"broken_promises": 1}), 1)


class Process(unittest.TestCase):
    def test_cpu_time_is_counted_and_sleep_is_not(self):
        busy = process.run([sys.executable, "-c", "import time\nwhile time.process_time() < 0.3: pass"], 30)
        self.assertGreaterEqual(busy.cpu_seconds, 0.29)
        idle = process.run([sys.executable, "-S", "-c", "import time; time.sleep(0.5)"], 30)
        self.assertLess(idle.cpu_seconds, 0.4)

    def test_trouble(self):
        self.assertEqual(process.run([sys.executable, "-c", "while True: pass"], 0.3).trouble, "time limit")
        self.assertEqual(process.run([sys.executable, "-c", "exit('a line')"], 30).trouble, "a line")
        self.assertEqual(process.run([sys.executable, "-c", ""], 30).trouble, "")


def star(arm=3):
    """Six square arms of unit width about a unit cube, as unit squares cut in two."""
    cells = {(0, 0, 0)} | {tuple(sign * step if k == axis else 0 for k in range(3))
                           for axis in range(3) for sign in (-1, 1) for step in range(1, arm + 1)}
    number, faces = {}, []
    for cell in sorted(cells):
        for axis in range(3):
            for up in (0, 1):
                if tuple(cell[k] + (2 * up - 1) * (k == axis) for k in range(3)) in cells:
                    continue
                square = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = list(cell)
                    corner[axis] += up
                    corner[(axis + 1) % 3] += u
                    corner[(axis + 2) % 3] += v
                    square.append(number.setdefault(tuple(map(float, corner)), len(number)))
                a, b, c, d = square if up else square[::-1]
                faces += [(a, b, c), (a, c, d)]
    return list(number), faces


class RidgeNoise(unittest.TestCase):
    """The six arms of a star are its ridges."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.mesh = Path(holder.name) / "star.off"
        meshes.write_off(self.mesh, *star())

    def runs(self, *options):
        run = process.run([RIDGE_NOISE, self.mesh, "--tolerance", "0.08", *options], 60)
        self.assertEqual(run.trouble, "")
        report = json.loads(run.output)
        self.assertEqual((report["ridges"], report["compact"]), (6, 6))
        return report["noisy"]

    def test_the_star_is_closed(self):
        self.assertAlmostEqual(meshes.volume(*star()), 19, 12)

    def test_arms_stay_put_under_small_noise(self):
        for kind in ([], ["--along-normals"]):
            for run in self.runs("--amplitudes", "0", "0.01", "0.02", *kind):
                self.assertEqual((run["ridges"], run["stay"], run["stay_compact"], run["extra"]), (6, 6, 6, 0), run)

    def test_they_do_not_under_huge_noise(self):
        for run in self.runs("--amplitudes", "0.6"):
            self.assertLess(run["stay"], 6)
            self.assertEqual(run["stay"] + run["extra"], run["ridges"])
            self.assertEqual(run["stay"] + run["grew"] + run["shrank"] + run["gone"], 6)

    def test_copies_are_seeded(self):
        self.assertEqual(self.runs("--amplitudes", "0.3"), self.runs("--amplitudes", "0.3"))
        first, second, _ = self.runs("--amplitudes", "0.3")
        self.assertNotEqual(first | {"seed": 0}, second | {"seed": 0})

    def test_table(self):
        printed = io.StringIO()
        with redirect_stdout(printed):
            decompose_bench.main([str(self.mesh.parent), "--tolerance", "0.08", "--noise-program", RIDGE_NOISE,
                                  "--ridge-noise", "2"])
        row = next(line.split() for line in printed.getvalue().splitlines() if line.startswith("all"))
        self.assertEqual(row, ["all", "6", "6", *["|", "100.0", "100.0", "0.00"] * 4,
                               "|", "0.00", "0.00", "0.00", "|", "100.0", "100.0"])


class EndToEnd(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        (self.folder / "boxes").mkdir()
        meshes.write_off(self.folder / "boxes" / "cube.off", CORNERS, SIDES)

    def boxer(self, ratio, scene="'glTF'"):
        program = self.folder / "boxer"
        bench = str(Path(__file__).resolve().parent)
        program.write_text(BOXER.format(bench=bench, sides=SIDES, ratio=ratio, scene=scene))
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return program

    def bench(self, *options, ratio=1.0, scene="'glTF'"):
        printed = io.StringIO()
        with redirect_stdout(printed):
            decompose_bench.main([str(self.folder / "boxes"), "--program", str(self.boxer(ratio, scene)),
                                  "--checker", CHECKER, *options])
        return printed.getvalue()

    def test_table(self):
        printed = self.bench("--check")
        self.assertIn("finished 1 of 1 (holds)", printed)
        self.assertIn("meshes with a broken promise 0 = 0 (holds)", printed)
        self.assertNotIn("MISSED", printed)

    def test_untrue_ratio(self):
        printed = self.bench("--check", ratio=1.1)
        self.assertIn("cube: says volume ratio 1.1000, it is 1.0000", printed)
        self.assertIn("meshes with a broken promise 1 = 0 (MISSED)", printed)

    def test_trouble_is_named_and_counted(self):
        meshes.write_off(self.folder / "boxes" / "face.off", CORNERS, SIDES[:1])
        printed = self.bench()
        self.assertIn("face: words of complaint", printed)
        self.assertIn("finished 1 of 2 (MISSED)", printed)

    def test_experiments(self):
        self.assertIn("within 0 of the mesh as given", self.bench("--rotations", "3"))
        self.assertIn("the same bytes on 1 of 1", self.bench("--determinism"))
        self.assertIn("1.000", self.bench("--remove", "0.1"))

    def test_different_bytes_are_seen(self):
        printed = self.bench("--determinism", scene='option["--threads"]')
        self.assertIn("cube: different: parts", printed)
        self.assertIn("the same bytes on 0 of 1", printed)

    def test_rand_error_by_tolerance(self):
        people = self.folder / "seg" / "cube"
        people.mkdir(parents=True)
        meshes.write_off(self.folder / "boxes" / "unseen.off", CORNERS, SIDES)  # that nobody has segmented
        for k, last in enumerate((0, 1)):
            (people / f"cube_{k}.seg").write_text("0\n" * 11 + f"{last}\n")
        printed = self.bench("--fig-2-35", "--seg-dir", str(people.parent), "--tolerances", "0.1",
                             "--evaluator", PARTWISE)
        # One label: all pairs agree with the first, all but 11 of 66 with the second.
        row = next(line.split() for line in printed.splitlines() if line.startswith("boxes"))
        self.assertEqual(row[1:6], ["0.167"] + ["0.083"] * 4)
        self.assertIn("0 runs did not finish", printed)

    def test_peer(self):
        if not HACD:
            self.skipTest("built without Bullet's HACD")
        printed = self.bench("--hacd", "1", "--hacd-program", HACD)
        cube = next(line.split() for line in printed.splitlines() if line.startswith("cube") and "1.000" in line)
        self.assertEqual(cube[6:8], ["1", "1.000"])

    def test_exit_without_files(self):
        program = self.folder / "idle"
        program.write_text("#!/bin/sh\n")
        program.chmod(0o755)
        result = decompose(Settings(program), self.folder / "boxes" / "cube.off")
        self.assertEqual(result.trouble, "exit status 0 without labels.seg, hulls.obj, report.json")
        self.assertEqual(summary.totals([result])["finished"], 0)


if __name__ == "__main__":
    CHECKER = sys.argv.pop(1)
    RIDGE_NOISE = sys.argv.pop(1)
    PARTWISE = sys.argv.pop(1)
    HACD = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
    unittest.main()
