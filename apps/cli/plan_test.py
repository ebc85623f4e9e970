#!/usr/bin/env python3
"""partwise plan, looked at through its files. plan_test.py PARTWISE HAS_OMPL"""

import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
HAS_OMPL = sys.argv[2] == "1"


def rectangle(x0, y0, x1, y1):
    return {"polygon": [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]}


# Two halves of a wall with a gap of 1, and a block beyond.
WALLS = [(-10, -1, 1.5, 1), (2.5, -1, 10, 1), (-4, 5, 4, 6)]
POINT = {"space": "plane", "obstacles": [rectangle(*each) for each in WALLS], "bounds": {"low": [-10, -10], "high": [10, 10]},
         "queries": [{"start": [-5, -5], "goal": [-3, 8]}, {"start": [-5, -5], "goal": [0, 0]}]}
VAN = {**POINT, "space": "se2", "robot": [rectangle(-1, -0.2, 1, 0.2)], "queries": [{"start": [-5, -5, 0], "goal": [-3, 8, 0]}]}


def distance(x, y):
    return min(math.hypot(max(x0 - x, 0, x - x1), max(y0 - y, 0, y - y1)) for x0, y0, x1, y1 in WALLS)


def read_log(text):
    """OMPL's benchmark log, read as ompl_benchmark_statistics.py reads it: the names of properties, and a row a run."""
    lines = iter(text.splitlines())

    def count():
        return int(next(lines).split()[0])

    line = next(lines)
    assert line.startswith("OMPL version") or line.startswith("Experiment"), line
    for _ in range(2):  # the settings, the machine
        while not next(lines).startswith("|>>>"):
            pass
    for _ in range(5):  # seed, seconds, MB, runs, seconds in all
        float(next(lines).split()[0])
    for _ in range(count()):  # enumerations
        next(lines)
    assert count() == 1  # planners
    name = next(lines)
    for _ in range(count()):  # of the planner
        next(lines)
    properties = [next(lines).rsplit(" ", 1)[0] for _ in range(count())]
    rows = [[float(cell) if cell else None for cell in next(lines).split("; ")[:-1]] for _ in range(count())]
    return name, [dict(zip(properties, row, strict=True)) for row in rows]


class Plan(unittest.TestCase):
    def setUp(self):
        shared = tempfile.TemporaryDirectory()
        self.addCleanup(shared.cleanup)
        self.folder = Path(shared.name)
        self.write("point.json", POINT)
        self.write("van.json", VAN)

    def write(self, name, problem):
        (self.folder / name).write_text(json.dumps(problem))

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=280, cwd=self.folder)

    def report(self, *arguments):
        result = self.run_program("plan", *arguments, "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refused(self, status, *words, arguments):
        result = self.run_program("plan", *arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.suffix in (".txt", ".glb", ".log")], [])

    def rows(self, name):
        return [[float(word) for word in line.split()] for line in (self.folder / name).read_text().splitlines()]

    def test_a_path_of_a_point_is_where_it_says(self):
        for planner in ("svma", "maprm", "umaprm"):
            report = self.report("point.json", "--planner", planner, "--path", "a.txt", "--glb", "a.glb")
            self.assertTrue(report["solved"])
            rows = self.rows("a.txt")
            self.assertEqual((rows[0][:2], rows[-1][:2]), ([-5, -5], [-3, 8]))
            length, least, total = 0, math.inf, 0
            for (x0, y0, c0), (x1, y1, _) in zip(rows, rows[1:], strict=False):
                self.assertAlmostEqual(c0, distance(x0, y0), delta=1e-9)
                step = math.hypot(x1 - x0, y1 - y0)
                seen = [distance(x0 + (x1 - x0) * k / 1000, y0 + (y1 - y0) * k / 1000) for k in range(1001)]
                length, least, total = length + step, min(least, *seen), total + step * sum(seen) / len(seen)
            self.assertAlmostEqual(report["length"], length, delta=1e-9 * length)
            self.assertAlmostEqual(report["clearance_min"], least, delta=0.011 * least)
            self.assertAlmostEqual(report["clearance_mean"], total / length, delta=0.03 * total / length)
            self.assertGreaterEqual(report["clearance_min"], 0.9 * report["found_clearance_min"] * 0.99)
            self.assertLessEqual(report["length"], report["found_length"] * (1 + 1e-9))
            self.assertGreater(report["seconds_plan"], 0)
            self.assertEqual((self.folder / "a.glb").read_bytes()[:4], b"glTF")
        self.assertGreater(self.report("point.json")["clearance_min"], 0.4)  # half the gap is 0.5

    def test_a_body_turns_to_pass(self):
        report = self.report("van.json", "--path", "b.txt", "--glb", "b.glb")
        self.assertGreater(report["clearance_min"], 0.05)
        self.assertGreater(max(abs(row[2]) for row in self.rows("b.txt")), 0.5)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.report("van.json", "--path", f"{threads}.txt", "--threads", threads)
        self.assertEqual((self.folder / "1.txt").read_bytes(), (self.folder / "2.txt").read_bytes())
        self.report("van.json", "--path", "raw.txt", "--raw")
        self.assertNotEqual((self.folder / "1.txt").read_bytes(), (self.folder / "raw.txt").read_bytes())

    def test_roadmaps_of_problems(self):
        for name, picture in (("point.json", "c.svg"), ("van.json", "c.glb")):
            result = self.run_program("roadmap", name, "--samples", 100, "--samples-out", "c.txt", f"--{picture[-3:]}", picture, "--json", "-")
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads(result.stdout)
            self.assertEqual((report["samples"], report["on_axis"], len(self.rows("c.txt"))), (100, 1, 100))
            self.assertTrue((self.folder / picture).exists())

    @unittest.skipUnless(HAS_OMPL, "built without OMPL")
    def test_planners_of_ompl_and_their_log(self):
        for sampler in ("uniform", "svma"):
            report = self.report("point.json", "--planner", "prm", "--sampler", sampler)
            self.assertTrue(report["solved"])
        report = self.report("point.json", "--runs", 3, "--log", "d.log", "--time", 20, "--path", "d.txt")
        self.assertEqual((report["runs"], report["runs_solved"], report["solved"]), (3, 3, True))
        name, runs = read_log((self.folder / "d.log").read_text())
        self.assertIn("SVMA", name)
        self.assertEqual(len(runs), 3)
        for run in runs:
            self.assertEqual(run["solved"], 1)
            self.assertGreater(run["path minimum clearance"], 0.4)
            self.assertGreaterEqual(run["kept minimum clearance"], 0.89 * run["path minimum clearance"])
            self.assertLessEqual(run["kept length"], run["path length"] * (1 + 1e-9))

    # OMPL decomposes a random matrix of its own where positions have three coordinates.
    @unittest.skipUnless(HAS_OMPL, "built without OMPL")
    def test_ompl_in_space(self):
        slabs = [{**rectangle(-4, 2 * i - 2.5, 4, 2 * i - 1.5), "height": 4} for i in range(3)]
        self.write("space.json", {"space": "se3", "obstacles": slabs, "robot": [{**rectangle(-0.1, -0.1, 0.1, 0.1), "height": 0.2}],
                                  "bounds": {"low": [-4, -4, -1], "high": [4, 4, 5]},
                                  "queries": [{"start": [0, -1, 1, 1, 0, 0, 0], "goal": [0, 1, 1, 1, 0, 0, 0]}]})
        for planner in ("prm", "svma"):
            self.report("space.json", "--planner", planner, "--runs", 2, "--time", 10, "--log", "space.log")
            self.assertEqual([run["solved"] for run in read_log((self.folder / "space.log").read_text())[1]], [1, 1])

    # Debian's libraries allocate Eigen's matrices another way than we do: a program must not lend them its functions.
    @unittest.skipUnless(shutil.which("nm"), "no nm")
    def test_libraries_keep_their_own_eigen(self):
        shown = subprocess.run(["nm", "-D", "--defined-only", PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertIn(" ", shown)
        self.assertEqual([line for line in shown.splitlines() if re.search(r" _ZN?[A-Z]*K?5Eigen", line)], [])

    @unittest.skipIf(HAS_OMPL, "built with OMPL")
    def test_without_ompl_what_needs_it_says_so(self):
        self.refused(1, "OMPL", "libompl-dev", arguments=["point.json", "--planner", "prm"])
        self.refused(1, "OMPL", "libompl-dev", arguments=["point.json", "--log", "x.log"])

    def test_what_cannot_be_done(self):
        out = ["--path", "x.txt"]
        self.refused(1, "goal of query 2", arguments=["point.json", "--query", 2, *out])
        self.refused(2, "--query", arguments=["point.json", "--query", 3, *out])
        self.write("closed.json", {**POINT, "obstacles": [rectangle(-10, -1, 10, 1), rectangle(-4, 5, 4, 6)]})
        self.refused(1, "no path", "--time", arguments=["closed.json", "--time", "0.5", *out])
        self.write("nowhere.json", {key: value for key, value in POINT.items() if key != "queries"})
        self.refused(1, "nowhere.json", "start", arguments=["nowhere.json", *out])
        self.write("one.json", {**POINT, "obstacles": [rectangle(*WALLS[2])]})
        self.refused(1, "one.json", "two", arguments=["one.json", *out])
        self.write("empty.json", {**POINT, "obstacles": []})
        self.refused(1, "empty.json", arguments=["empty.json", *out])
        self.refused(1, "missing.cfg", arguments=["missing.cfg", *out])
        self.refused(1, "ending", arguments=["point.xyz", *out])
        self.refused(2, "svma", arguments=["point.json", "--planner", "rrt"])
        self.refused(2, "--sampler", arguments=["point.json", "--sampler", "bridge"])
        self.refused(2, "--time", arguments=["point.json", "--time", "0"])
        self.refused(2, "--runs", arguments=["point.json", "--runs", "3"])
        self.refused(2, "--path", arguments=["point.json", "--path", "x.csv"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
