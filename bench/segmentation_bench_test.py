"""Segmentations of a box judged by people who are known, with the program itself: segmentation_bench_test.py PARTWISE"""

import io
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path

import segmentation_bench
from harness import meshes, segmentation
from harness.dissertation import TABLE_2_1, TABLE_2_1_AVERAGE
from harness.people import MEASURES, People

PARTWISE = ""
CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
SIDES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
         (1, 5, 7), (1, 7, 3)]


def rand_error(a, b):
    pairs = [(i, j) for i in range(len(a)) for j in range(i)]
    return sum((a[i] == a[j]) != (b[i] == b[j]) for i, j in pairs) / len(pairs)


class Bench(unittest.TestCase):
    """Box 1 with three people, box 2 with two, box 21 (a cup by its number) with one."""

    labels = {
        "1_0": [0] * 6 + [1] * 6,
        "1_1": [0] * 4 + [1] * 8,
        "1_2": [0] * 12,
        "1_10": [5, 5, 3, 3] * 3,
        "2_0": [0] * 6 + [1] * 6,
        "2_1": [1] * 6 + [0] * 6,
        "21_0": [0] * 12,
    }

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        for name in ("off", "seg", "mine"):
            (self.folder / name).mkdir()
        for number in (1, 2, 21):
            meshes.write_off(self.folder / "off" / f"{number}.off", CORNERS, SIDES)
        for name, labels in self.labels.items():
            (self.folder / "seg" / name.split("_")[0]).mkdir(exist_ok=True)
            self.write(self.folder / "seg" / name.split("_")[0] / f"{name}.seg", labels)
        self.people = People(self.folder / "seg", PARTWISE)
        self.mesh = self.folder / "off" / "1.off"

    def write(self, path, labels):
        path.write_text("".join(f"{label}\n" for label in labels))
        return path

    def bench(self, *options):
        printed = io.StringIO()
        with redirect_stdout(printed):
            segmentation_bench.main([str(self.folder / "off"), str(self.folder / "seg"), "--program", PARTWISE, *options])
        return printed.getvalue()

    def row(self, printed, name):
        return next(line.split() for line in printed.splitlines() if line.startswith(name))

    def against(self, labels, *names):
        errors = [rand_error(labels, self.labels[name]) for name in names]
        return sum(errors) / len(errors)

    def test_people_in_the_order_of_their_numbers(self):
        self.assertEqual([path.stem for path in self.people.files(self.mesh)], ["1_0", "1_1", "1_2", "1_10"])

    def test_mean_rand_errors_by_pairs(self):
        mine = [k // 5 for k in range(12)]
        file = self.write(self.folder / "mine" / "1.seg", mine)
        self.assertAlmostEqual(self.people.error(self.mesh, file), self.against(mine, "1_0", "1_1", "1_2", "1_10"), 12)
        first = self.people.first_against_others(self.mesh)
        self.assertAlmostEqual(first["rand_error"], self.against(self.labels["1_0"], "1_1", "1_2", "1_10"), 12)
        everyone = ["1_0", "1_1", "1_2", "1_10"]
        mean = sum(self.against(self.labels[name], *[other for other in everyone if other != name]) for name in everyone) / 4
        self.assertAlmostEqual(self.people.among_themselves(self.mesh), mean, 12)

    def test_too_few_people(self):
        lonely, unseen = self.folder / "off" / "21.off", self.folder / "off" / "3.off"
        self.assertIsNone(self.people.first_against_others(lonely))
        self.assertIsNone(self.people.among_themselves(lonely))
        self.assertIsNone(self.people.first_against_others(unseen))
        self.assertIsNone(self.people.error(unseen, "any"))

    def test_people_mode(self):
        printed = self.bench("--people", "--list")
        first = self.people.first_against_others(self.mesh)
        human = self.row(printed, "human")
        self.assertEqual(human[:3], ["human", "2", f"{first['rand_error'] / 2:.3f}"])  # the second mesh's people agree
        self.assertEqual(human[4], f"{first['hamming'] / 2:.3f}")
        self.assertEqual(human[-3:], ["0.18", "0.16", "0.14"])
        self.assertEqual(self.row(printed, "cup")[:4], ["cup", "0", "-", "-"])
        self.assertEqual(self.row(printed, "all")[:3], ["all", "2", human[2]])
        self.assertIn("21: too few people", printed)

    def test_labels_mode(self):
        self.write(self.folder / "mine" / "1.seg", self.labels["1_1"])
        self.write(self.folder / "mine" / "2.seg", [0] * 11)
        printed = self.bench("--labels", str(self.folder / "mine"), "--category-of", "folder")
        expected = self.against(self.labels["1_1"], "1_0", "1_1", "1_2", "1_10")
        self.assertEqual(self.row(printed, "off")[:3], ["off", "1", f"{expected:.3f}"])
        self.assertNotIn("SDF", printed)
        self.assertIn("11 labels for a mesh of 12 faces", printed)
        self.assertIn("21.seg", printed)  # is missing

    def test_undefined_discrepancies_are_left_out(self):
        results = [segmentation.Result(self.mesh, dict.fromkeys(MEASURES, value) | {"cut_discrepancy": discrepancy})
                   for value, discrepancy in ((0.25, None), (0.75, 0.5))]
        means = segmentation.means(results)
        self.assertEqual((means["rand_error"], means["cut_discrepancy"]), (0.5, 0.5))

    def test_table_2_1_is_consistent_and_complete(self):
        self.assertEqual(set(TABLE_2_1), set(meshes.PRINCETON) - {"(none)"})
        for column, average in enumerate(TABLE_2_1_AVERAGE):
            self.assertLess(abs(sum(row[column] for row in TABLE_2_1.values()) / len(TABLE_2_1) - average), 0.01)


if __name__ == "__main__":
    PARTWISE = sys.argv.pop(1)
    unittest.main()
