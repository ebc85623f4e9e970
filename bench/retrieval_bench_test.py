"""Names of parts on solids whose limbs are known, and the bench with the program itself: retrieval_bench_test.py PARTWISE"""

import io
import json
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from unittest import mock

import label_parts
import retrieval_bench
from harness import meshes

PARTWISE = ""


def surface(cells):
    """Of unit cells: vertices, triangles, and the cell of each triangle."""
    corners, faces, owner = {}, [], []
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                beyond = tuple(c + (2 * side - 1) * (k == axis) for k, c in enumerate(cell))
                if beyond in cells:
                    continue
                quad = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))[::1 if side else -1]:
                    point = list(cell)
                    point[axis] += side
                    point[(axis + 1) % 3] += u
                    point[(axis + 2) % 3] += v
                    quad.append(corners.setdefault(tuple(map(float, point)), len(corners)))
                a, b, c, d = quad
                faces += [(a, b, c), (a, c, d)]
                owner += [cell, cell]
    return list(corners), faces, owner


BODY = {(x, y, z) for x in range(8) for y in range(8) for z in range(8)}
LEGS = {(x, y, z) for x in (0, 1, 6, 7) for z in (0, 1, 6, 7) for y in range(-9, 0)}


class Labels(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        vertices, faces, self.owner = surface(BODY | LEGS)
        (self.folder / "seg").mkdir()
        self.is_leg = [cell[1] < 0 for cell in self.owner]
        for name, scale in (("101", 1), ("141", 2)):  # a chair and a table by their numbers
            meshes.write_off(self.folder / f"{name}.off", [tuple(scale * x for x in v) for v in vertices], faces)
            (self.folder / "seg" / name).mkdir()
            for person in range(3):
                # Each leg has two segments; the third person cut nothing off.
                labels = [0 if not leg or person == 2 else 1 + (cell[0] > 3) + 2 * (cell[2] > 3) + 4 * (cell[1] < -4)
                          for leg, cell in zip(self.is_leg, self.owner)]
                (self.folder / "seg" / name / f"{name}_{person}.seg").write_text("\n".join(map(str, labels)) + "\n")

    def test_tips_are_the_ends_of_the_legs(self):
        mesh = label_parts.Mesh(self.folder / "101.off")
        longest = label_parts.tips(mesh.lists, label_parts.from_centre(mesh.lists))[:4]
        self.assertEqual({mesh.vertices[v][1] for _, v in longest}, {-9.0})
        self.assertEqual(len({tuple(x > 4 for x in mesh.vertices[v][::2]) for _, v in longest}), 4)

    def test_legs_are_what_most_people_cut_off(self):
        for name in ("101", "141"):
            kinds = label_parts.face_kinds(self.folder / f"{name}.off", self.folder / "seg")
            self.assertEqual([kind == "leg" for kind in kinds], self.is_leg, name)
            (self.folder / "seg" / name / f"{name}_3.seg").write_text("0\n" * len(kinds))
            kinds = label_parts.face_kinds(self.folder / f"{name}.off", self.folder / "seg")
            self.assertEqual(set(kinds), {"-"})  # two of four are not most

    def test_bench_finds_legs_of_the_other_mesh(self):
        kinds = self.folder / "kinds"
        label_parts.main([str(self.folder), str(self.folder / "seg"), str(kinds)])
        queries, printed = self.folder / "queries.json", io.StringIO()
        with mock.patch.object(retrieval_bench, "QUERIES", queries), redirect_stdout(printed):
            retrieval_bench.main([str(self.folder), str(kinds), str(self.folder / "index"), "--program", PARTWISE,
                                  "--choose"])
        parts = retrieval_bench.Parts(self.folder / "101.off", kinds, self.folder / "index")
        legs = sum(kind == "leg" for kind in parts.kinds.values())
        self.assertEqual(legs, 4)
        self.assertEqual([(q["mesh"], q["kind"]) for q in json.loads(queries.read_text())],
                         [("101.off", "leg"), ("141.off", "leg")])
        self.assertIn("2 meshes, 2 indexed now", printed.getvalue())
        self.assertIn("other meshes: 4.00 of 9 in the mean, 0 of 2", printed.getvalue())
        self.assertIn("left out: 7.00 of 9 in the mean, 2 of 2", printed.getvalue())


if __name__ == "__main__":
    PARTWISE = sys.argv.pop(1)
    unittest.main()
