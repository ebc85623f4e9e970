"""The program as a person or a script meets it: exit codes, messages, reports, and files that appear whole or not at all.

    cli_test.py PROGRAM [GROUP]
"""

import colorsys
import json
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

PROGRAM = ""
NOTCH = Path(__file__).resolve().parents[2] / "examples" / "notch.obj"
DATA = NOTCH.parents[1] / "data"


def glb_json(file):
    """The JSON of a binary glTF file."""
    data = file.read_bytes()
    return json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])


def png_rows(data):
    """Width, height, bits, colour type and the rows of a PNG, as bytes."""
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    step = depth // 8 * {0: 1, 2: 3, 6: 4}[colours]
    raw, stride, rows = zlib.decompress(packed), step * width, []
    for y in range(height):
        start = y * (stride + 1)
        above = rows[-1] if rows else bytes(stride)
        rows.append(unfilter(raw[start], bytearray(raw[start + 1:start + 1 + stride]), above, step))
    return width, height, depth, colours, rows


def unfilter(kind, row, above, step):
    def paeth(a, b, c):
        da, db, dc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
        return a if da <= db and da <= dc else b if db <= dc else c

    for i in range(len(row)) if kind else ():
        left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
        row[i] = row[i] + (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind] & 255
    return row


class Picture:
    """A PNG of 8 bits a channel with alpha, decoded."""

    def __init__(self, file):
        self.width, self.height, depth, colours, self.rows = png_rows(file.read_bytes())
        assert (depth, colours) == (8, 6), (depth, colours)

    def hues(self, rows=slice(None)):
        """How many opaque pixels of each hue in degrees; greys have none."""
        counts = [0] * 360
        for row in self.rows[rows]:
            for i in range(0, len(row), 4):
                if row[i + 3] == 255:
                    hue, saturation, _ = colorsys.rgb_to_hsv(row[i] / 255, row[i + 1] / 255, row[i + 2] / 255)
                    if saturation > 0.1:
                        counts[int(360 * hue) % 360] += 1
        return counts

    def box(self):
        """First and last column and row with an opaque pixel."""
        alpha = [row[3::4] for row in self.rows]
        rows = [y for y, row in enumerate(alpha) if 255 in row]
        columns = [x for x in range(self.width) if any(alpha[y][x] == 255 for y in rows)]
        return columns[0], columns[-1], rows[0], rows[-1]


def share_near(counts, hue, reach=12):
    """The share of the pixels whose hue is within `reach` degrees of `hue`."""
    return sum(counts[(hue + d) % 360] for d in range(-reach, reach + 1)) / sum(counts)


DARK_BLUE, YELLOW = 244, 62  # hues of the two ends of the scale of values


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="partwise-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, **options):
        return subprocess.run(
            [PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, timeout=60, **options
        )

    def decompose(self, *arguments, mesh=NOTCH, tolerance=0.1, **options):
        return self.run_program("decompose", mesh, "--tolerance", tolerance, *arguments, **options)

    def assert_done(self, result):
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def assert_refused(self, result, code, *words):
        """Nothing but one line on standard error, and no file left."""
        self.assertEqual(result.returncode, code, result)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.endswith("\n"))
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_framed(self, picture):
        """Clear at the corners, and what is drawn takes 0.86 of the width or of the height, in the middle."""
        self.assertEqual((picture.width, picture.height), (960, 800))
        for y in (0, -1):
            self.assertEqual((picture.rows[y][3], picture.rows[y][-1]), (0, 0))
        left, right, top, bottom = picture.box()
        margins = (left / 960, 1 - right / 960), (top / 800, 1 - bottom / 800)
        tight = min(margins)
        self.assertAlmostEqual(tight[0], 0.07, delta=0.01)
        self.assertAlmostEqual(tight[1], 0.07, delta=0.01)
        self.assertGreater(min(map(min, margins)), 0.06)

    def assert_files(self, *names):
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), sorted(names))


class Usage(CommandLine):
    def test_wrong_usage_is_one_line_and_2(self):
        mesh = str(NOTCH)
        whole = ["decompose", mesh, "--tolerance", "0.1"]
        cases = [
            ([], "verb"),
            (["--no-such-option"], "--no-such-option"),
            (["no-such-verb"], "no-such-verb"),
            (["decompose"], "MESH"),
            (["decompose", mesh], "--tolerance"),
            (["decompose", "--tolerance", "0.1"], "MESH"),
            (whole + ["--no-such-option"], "--no-such-option"),
            (whole + ["second.off"], "second.off"),
            (whole + ["--measure", "volume"], "--measure"),
            (whole + ["--measure"], "--measure"),
            (whole + ["--cup-repair"], "--cup-repair belongs to --measure valley; leave it out, hull cuts cups anyway"),
            (whole + ["--measure", "hull", "--cup-repair"], "--cup-repair"),
            (whole + ["--max-hulls", "0"], "--max-hulls"),
            (whole + ["--max-hulls", "two"], "--max-hulls"),
            (whole + ["--max-hulls", "99999999999999999999"], "--max-hulls"),
            (whole + ["--max-hull-vertices", "3"], "--max-hull-vertices"),
            (whole + ["--threads", "0"], "--threads"),
            (whole + ["--threads", "-1"], "--threads"),
            (whole + ["--seed", "-1"], "--seed"),
            (whole + ["--labels"], "--labels"),
            (whole + ["--labels", ""], "--labels"),
            (whole + ["--hulls", "hulls.xyz"], ".obj"),
            (whole + ["--glb", "parts.obj"], ".glb"),
            (whole + ["--urdf", "robot.xml"], ".urdf"),
            (whole + ["--mjcf", "robot.urdf"], ".xml"),
        ]
        cases += [
            (["decompose", mesh, "--tolerance", value], "--tolerance")
            for value in ("0", "-0.1", "nan", "inf", "1e999", "0.1x", "")
        ]
        for arguments, word in cases:
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_program(*arguments), 2, "partwise", word, "--help")
                self.assert_files()

    def test_two_names_for_one_file(self):
        (self.folder / "link.glb").symlink_to("same.glb")
        for second in ("same.glb", "./same.glb", "../" + self.folder.name + "/same.glb", self.folder / "same.glb"):
            with self.subTest(second=second):
                result = self.decompose("--hulls", "same.glb", "--glb", second)
                self.assert_refused(result, 2, "--hulls", "--glb", "same file")
        result = self.decompose("--json", "same", "--labels", "same")
        self.assert_refused(result, 2, "--json", "--labels", "same file")
        self.assert_files("link.glb")

    def test_an_input_is_not_written_over(self):
        mesh = self.folder / "mesh.obj"
        mesh.write_bytes(NOTCH.read_bytes())
        (self.folder / "link.obj").symlink_to("mesh.obj")
        for option, name in (("--hulls", "mesh.obj"), ("--hulls", "link.obj"), ("--json", "mesh.obj")):
            self.assert_refused(self.decompose(option, name, mesh=mesh), 2, "MESH", option)
        self.assertEqual(mesh.read_bytes(), NOTCH.read_bytes())

    def test_help_teaches_with_an_example(self):
        result = self.run_program("--help")
        self.assert_done(result)
        self.assertIn("decompose", result.stdout)
        result = self.run_program("decompose", "--help")
        self.assert_done(result)
        self.assertIn("Example:\n  partwise decompose ", result.stdout)
        for option in (
            "--tolerance --absolute --measure --cup-repair --max-hulls --max-hull-vertices --labels --hulls --glb --urdf "
            "--mjcf --threads --seed --quiet --json --help"
        ).split():
            self.assertIn(option, result.stdout)

    def test_version(self):
        result = self.run_program("--version")
        self.assert_done(result)
        self.assertRegex(
            result.stdout, r"^partwise \d+\.\d+\.\d+\n\w+, \w+ \d+[^\n]*\nembree 3[^,\n]*, (no OMPL|OMPL 1.*), (no libtorch|libtorch [12].*)\n$"
        )


class Results(CommandLine):
    fields = "parts tolerance concavity volume_ratio watertight radius measure cut_inside seconds files".split()

    def test_every_output_is_there(self):
        outputs = dict(labels="a.seg", hulls="a.obj", glb="a.glb", urdf="a.urdf", mjcf="a.xml")
        arguments = [part for name, file in outputs.items() for part in ("--" + name, file)]
        result = self.decompose(*arguments, "--json", "a.json")
        self.assert_done(result)
        self.assertIn("a.seg", result.stdout)
        report = json.loads((self.folder / "a.json").read_text())
        for field in self.fields:
            self.assertIn(field, report)
        self.assertEqual(report["files"], outputs)
        for stage in ("read", "write", "total"):
            self.assertGreaterEqual(report["seconds"][stage], 0)
        self.assertLessEqual(report["concavity"], report["tolerance"])
        self.assertTrue(report["watertight"])
        self.assertAlmostEqual(report["radius"], 3**0.5 / 2, places=9)

        labels = [int(line) for line in (self.folder / "a.seg").read_text().split()]
        self.assertEqual(len(labels), 28)
        self.assertEqual(sorted(set(labels)), list(range(report["parts"])))
        lines = (self.folder / "a.obj").read_text().splitlines()
        self.assertEqual(sum(line.startswith("o ") for line in lines), report["parts"])
        self.assertEqual((self.folder / "a.glb").read_bytes()[:4], b"glTF")
        for name in ("a.urdf", "a.xml"):
            text = (self.folder / name).read_text()
            meshes = re.findall(r'"([^"]*\.obj)"', text)
            self.assertGreaterEqual(len(meshes), report["parts"])
            for mesh in meshes:
                self.assertTrue((self.folder / mesh).is_file() or (self.folder / "a_hulls" / mesh).is_file(), mesh)
        self.assert_files("a.json", "a_hulls", *outputs.values())

    def test_json_on_standard_output_is_all_there_is(self):
        result = self.decompose("--json", "-")
        self.assert_done(result)
        self.assertEqual(json.loads(result.stdout)["measure"], "hull")
        for repair in [], ["--cup-repair"]:
            result = self.decompose("--measure", "valley", *repair, "--json", "-")
            self.assert_done(result)
            self.assertEqual(json.loads(result.stdout)["measure"], "valley")
        self.assert_files()

    def test_an_open_mesh_has_no_ratio(self):
        (self.folder / "open.off").write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n")
        result = self.decompose("--json", "-", mesh="open.off", tolerance=0.8)
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertFalse(report["watertight"])
        self.assertIsNone(report["volume_ratio"])

    def test_quiet_and_loud(self):
        self.assertEqual(self.decompose("--quiet").stdout, "")
        result = self.decompose()
        self.assert_done(result)
        self.assertRegex(result.stdout, r"notch\.obj: \d+ parts?, concavity")
        self.assertLessEqual(result.stdout.count("\n"), 2)

    def test_absolute_is_in_model_units(self):
        result = self.decompose("--absolute", "--json", "-", tolerance=0.05)
        self.assert_done(result)
        self.assertEqual(json.loads(result.stdout)["tolerance"], 0.05)

    def test_the_same_bytes_for_any_threads(self):
        files = []
        for threads in (1, 2):
            name = f"{threads}.glb"
            self.assert_done(self.decompose("--threads", threads, "--seed", threads, "--glb", name))
            files.append((self.folder / name).read_bytes())
        self.assertEqual(*files)


class Render(CommandLine):
    """A unit square in two halves, seen from the front."""

    def setUp(self):
        super().setUp()
        (self.folder / "square.off").write_text("OFF\n4 2 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n3 0 1 2\n3 0 2 3\n")
        (self.folder / "halves.seg").write_text("0\n1\n")
        self.write_scene()

    def scene(self):
        return {"meshes": [{"file": "square.off", "labels": "halves.seg", "material": [{"albedo": [0.5, 0.5, 0.5]}, "chrome"]}],
                "light": {"name": "sky", "height": 16}, "camera": {"azimuth": 0, "elevation": 0}, "size": [40, 30], "samples": 1}

    def write_scene(self, scene=None):
        (self.folder / "scene.json").write_text(json.dumps(scene or self.scene()))
        self.files = sorted(path.name for path in self.folder.iterdir())

    def render(self, *arguments):
        return self.run_program("render", "scene.json", *arguments)

    def test_every_output_is_there(self):
        outputs = {"--exr": "a.exr", "--png": "a.png", "--normals": "n.png", "--depth": "d.exr", "--mask": "m.png",
                   "--parts": "p.png"}
        result = self.render("--json", "-", *(part for pair in outputs.items() for part in pair))
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["images"], report["parts"], report["width"], report["height"]), (1, 2, 40, 30))
        self.assertGreater(report["images_per_second"], 0)
        self.assertAlmostEqual(report["foreground"], 0.45, delta=0.06)
        self.assert_files(*self.files, *outputs.values())
        self.assertEqual(png_rows((self.folder / "a.png").read_bytes())[:4], (40, 30, 8, 2))
        self.assertEqual(png_rows((self.folder / "m.png").read_bytes())[:4], (40, 30, 8, 0))
        for name, colours in (("n.png", 2), ("p.png", 0)):
            self.assertEqual(png_rows((self.folder / name).read_bytes())[:4], (40, 30, 16, colours))

    def test_the_same_bytes_for_any_number_of_threads(self):
        made = []
        for threads in (1, 2, 4):
            self.assert_done(self.render("--exr", "a.exr", "--quiet", "--threads", threads))
            made.append((self.folder / "a.exr").read_bytes())
        self.assertEqual(made[0], made[1])
        self.assertEqual(made[0], made[2])

    def test_the_two_paths_agree_and_shadows_need_the_exact_one(self):
        for fields in ({"path": "exact"}, {"path": "reflectance_map", "map_size": 32}, {"shadows": True}):
            self.write_scene(self.scene() | fields)
            self.assert_done(self.render("--exr", "a.exr", "--quiet"))
        self.write_scene(self.scene() | {"path": "reflectance_map", "shadows": True})
        self.assert_refused(self.render(), 1, "scene.json", "shadows", "exact")

    def test_a_wrong_field_is_named(self):
        def changed(change):
            scene = self.scene()
            change(scene)
            return scene
        cases = (
            (lambda s: s.pop("meshes"), "meshes is missing"),
            (lambda s: s.update(meshes=[]), "meshes is no list"),
            (lambda s: s["meshes"][0].pop("file"), "meshes[0].file is missing"),
            (lambda s: s["meshes"][0].update(file=""), "meshes[0].file is no text"),
            (lambda s: s["meshes"][0].update(file="none.off"), "none.off: does not exist"),
            (lambda s: s["meshes"][0].update(material=[]), "meshes[0].material is an empty list"),
            (lambda s: s["meshes"][0].update(material=3), "meshes[0].material is neither"),
            (lambda s: s["meshes"][0].update(material=["chrome", {"albedo": [1, 2, 3]}]), "meshes[0].material[1].albedo"),
            (lambda s: s["meshes"][0].update(material="unobtainium"), "unobtainium"),
            (lambda s: s["meshes"][0].update(components=True), "meshes[0].components and labels"),
            (lambda s: s["meshes"][0].update(crease=181), "meshes[0].crease is not a number from 0 to 180"),
            (lambda s: s.pop("light"), "light is missing"),
            (lambda s: s.update(light={}), "light.name and file"),
            (lambda s: s["light"].update(name="moon"), "moon"),
            (lambda s: s["light"].update(height=0), "light.height is not a number from 1"),
            (lambda s: s["light"].update(height=1.5), "light.height is not a whole number"),
            (lambda s: s["light"].update(turns_with="wind"), "light.turns_with is none of"),
            (lambda s: s["camera"].update(elevation="high"), "camera.elevation is not a number"),
            (lambda s: s["camera"].update(field_of_view=20), "camera.field_of_view means nothing"),
            (lambda s: s["camera"].update(zoom=2), "camera.zoom is not a field"),
            (lambda s: s.update(camera=[]), "camera is not an object"),
            (lambda s: s.update(size=[0, 3]), "size is not two whole numbers"),
            (lambda s: s.update(samples=0), "samples is not a number from 1"),
            (lambda s: s.update(shadows="yes"), "shadows is neither true nor false"),
            (lambda s: s.update(path="photon_map"), "path is none of"),
        )
        for change, words in cases:
            with self.subTest(words):
                self.write_scene(changed(change))
                self.assert_refused(self.render("--png", "a.png"), 1, words)
                self.assert_files(*self.files)
        (self.folder / "halves.seg").write_text("0\n")
        self.write_scene()
        self.assert_refused(self.render(), 1, "meshes[0].labels has 1 lines for 2 faces")
        for text in ("", "{", "[]", "3"):
            (self.folder / "scene.json").write_text(text)
            self.assert_refused(self.render(), 1, "scene.json")

    def test_the_example_renders(self):
        example = NOTCH.parent / "scene.json"
        result = self.run_program("render", example, "--normals", "n.exr", "--json", "-")
        self.assert_done(result)
        self.assertGreater(json.loads(result.stdout)["foreground"], 0.3)


class Evaluate(CommandLine):
    fields = "rand_error cut_discrepancy hamming hamming_missing hamming_false consistency_global consistency_local".split()

    def setUp(self):
        """A strip of four unit squares, each cut in two; labels by square."""
        super().setUp()
        lines = ["OFF", "10 8 0"] + [f"{x} {y} 0" for x in range(5) for y in range(2)]
        for a in range(0, 8, 2):
            lines += [f"3 {a} {a + 2} {a + 3}", f"3 {a} {a + 3} {a + 1}"]
        (self.folder / "strip.off").write_text("\n".join(lines) + "\n")
        for name, squares in (("left", "0111"), ("half", "0011"), ("named", "7755"), ("whole", "0000"), ("four", "0123")):
            (self.folder / f"{name}.seg").write_text("".join(f"{label}\n" * 2 for label in squares))
        self.files = sorted(path.name for path in self.folder.iterdir())

    def evaluate(self, *arguments):
        return self.run_program("evaluate", "strip.off", *arguments)

    def measured(self, *segmentations):
        result = self.evaluate(*segmentations, "--json", "-")
        self.assert_done(result)
        self.assert_files(*self.files)
        return json.loads(result.stdout)

    def test_equal_segmentations_are_at_0(self):
        for pair in (("half.seg", "half.seg"), ("half.seg", "named.seg"), ("whole.seg", "whole.seg")):
            report = self.measured(*pair)
            self.assertEqual([report[field] for field in self.fields], [0] * 7)

    def test_one_border_moved_by_a_square(self):
        report = self.measured("left.seg", "half.seg")
        self.assertEqual(list(report), self.fields + ["references", "by_reference", "seconds", "reads"])
        self.assertEqual(report["references"], 1)
        self.assertAlmostEqual(report["rand_error"], 2 * 6 / 28, 12)
        for field in ("hamming", "hamming_missing", "hamming_false"):
            self.assertAlmostEqual(report[field], 0.25, 12)
        # Shares outside, by square: 0, 2/3, 1/3, 1/3 and 1/2, 1/2, 0, 0.
        self.assertAlmostEqual(report["consistency_global"], 1 / 4, 12)
        self.assertAlmostEqual(report["consistency_local"], 1 / 8, 12)
        centroids = [(x + a / 3, b / 3) for x in range(4) for a, b in ((2, 1), (1, 2))]
        radius = sum(((x - 2) ** 2 + (y - 0.5) ** 2) ** 0.5 for x, y in centroids) / 8
        self.assertAlmostEqual(report["cut_discrepancy"], 1 / radius, 12)
        for stage in ("read", "compare", "total"):
            self.assertGreaterEqual(report["seconds"][stage], 0)

    def test_means_over_references(self):
        report = self.measured("half.seg", "left.seg", "half.seg", "four.seg")
        alone = [self.measured("half.seg", name) for name in ("left.seg", "half.seg", "four.seg")]
        self.assertEqual(report["references"], 3)
        self.assertEqual([each.pop("reference") for each in report["by_reference"]], ["left.seg", "half.seg", "four.seg"])
        self.assertEqual(report["by_reference"], [{field: one[field] for field in self.fields} for one in alone])
        for field in self.fields:
            self.assertAlmostEqual(report[field], sum(one[field] for one in alone) / 3, 12)
        self.assertGreater(report["by_reference"][2]["hamming_false"], 0)
        self.assertEqual(report["by_reference"][2]["hamming_missing"], 0)

    def test_a_discrepancy_of_no_cuts_is_null(self):
        report = self.measured("half.seg", "whole.seg", "left.seg")
        self.assertIsNone(report["by_reference"][0]["cut_discrepancy"])
        self.assertEqual(report["cut_discrepancy"], report["by_reference"][1]["cut_discrepancy"])
        self.assertIsNone(self.measured("half.seg", "whole.seg")["cut_discrepancy"])
        self.assertIn("cut discrepancy undefined", self.evaluate("half.seg", "whole.seg").stdout)

    def test_summary_and_report(self):
        result = self.evaluate("left.seg", "half.seg", "four.seg", "--json", "a.json", "--threads", "1", "--seed", "3")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"^left\.seg against 2 references: Rand error 0\.\d+, .*\n$")
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["references"], 2)
        self.assertEqual(self.evaluate("left.seg", "half.seg", "--quiet").stdout, "")

    def test_labels_that_do_not_fit(self):
        (self.folder / "short.seg").write_text("0\n1\n")
        (self.folder / "words.seg").write_text("0\nleg\n")
        for pair in (("short.seg", "half.seg"), ("half.seg", "half.seg", "short.seg")):
            result = self.evaluate(*pair, "--json", "a.json")
            self.assert_refused(result, 1, "short.seg: 2 labels for a mesh of 8 faces; give one label a face")
        self.assert_refused(self.evaluate("half.seg", "words.seg"), 1, "words.seg:2")
        self.assert_refused(self.evaluate("half.seg", "none.seg"), 1, "none.seg")
        (self.folder / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        (self.folder / "one.seg").write_text("0\n")
        result = self.run_program("evaluate", "flat.off", "one.seg", "one.seg")
        self.assert_refused(result, 1, "flat.off: its area is 0; give a mesh")
        self.assertFalse((self.folder / "a.json").exists())

    def test_wrong_usage(self):
        for arguments, word in (([], "SEGMENTATION"), (["half.seg"], "REFERENCE"), (["half.seg", "half.seg", "--k"], "--k"),
                                (["half.seg", "left.seg", "--json", "left.seg"], "same file")):
            self.assert_refused(self.evaluate(*arguments), 2, word, "--help")
        self.assert_files(*self.files)

    def test_help_teaches_with_an_example(self):
        result = self.run_program("evaluate", "--help")
        self.assert_done(result)
        self.assertIn("Example:\n", result.stdout)
        for word in ("MESH", "SEGMENTATION", "REFERENCE", "rand_error", "hamming_missing", "null", "by_reference"):
            self.assertIn(word, result.stdout)


class Feature(CommandLine):
    """On two cubes, the smaller on the larger, sharing part of a face's plane but no vertex: two components."""

    sides = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
             (1, 5, 7), (1, 7, 3)]

    def setUp(self):
        super().setUp()
        lines = ["OFF", "16 24 0"]
        for low, high in ((0, 2), (4, 5)):
            lines += [f"{x} {y} {z}" for x in (low, high) for y in (low, high) for z in (low, high)]
        lines += [f"3 {a + k} {b + k} {c + k}" for k in (0, 8) for a, b, c in self.sides]
        (self.folder / "cubes.off").write_text("\n".join(lines) + "\n")

    def feature(self, *arguments):
        return self.run_program("feature", "cubes.off", *arguments)

    def test_each_cube_sees_its_own_area(self):
        for kind in ("cvf", "cvf-avg", "cvf-strong", "cvf-weak"):
            result = self.feature("--kind", kind, "--values", "v.txt", "--glb", "v.glb", "--json", "-")
            self.assert_done(result)
            values = [float(line) for line in (self.folder / "v.txt").read_text().splitlines()]
            for value, area in zip(values, [24] * 8 + [6] * 8, strict=True):
                self.assertAlmostEqual(value, area, 9)
            report = json.loads(result.stdout)
            self.assertEqual((report["min"], report["max"]), (min(values), max(values)))
            self.assertEqual(report["kind"], kind)
            self.assertEqual("method" in report, kind != "cvf-weak")
            self.assertEqual(report["files"], {"values": "v.txt", "glb": "v.glb"})
            self.assertEqual(len(glb_json(self.folder / "v.glb")["meshes"]), 2)

    def test_a_picture_reaches_from_dark_blue_to_yellow(self):
        result = self.feature("--kind", "cvf", "--png", "v.png", "--json", "-")
        self.assert_done(result)
        self.assertEqual(json.loads(result.stdout)["files"], {"png": "v.png"})
        picture = Picture(self.folder / "v.png")
        self.assert_framed(picture)
        # The small cube sees least and is above the large one; nothing lies between their values.
        _, _, top, bottom = picture.box()
        for rows, colour in ((slice(top, top + 200), DARK_BLUE), (slice(bottom - 200, bottom), YELLOW)):
            self.assertGreater(share_near(picture.hues(rows), colour), 0.98)

    def test_a_picture_does_not_depend_on_the_place(self):
        """Nor on threads, nor on vertices without a face."""
        self.assert_done(self.feature("--kind", "cvf", "--png", "near.png", "--threads", "1"))
        lines = (self.folder / "cubes.off").read_text().splitlines()
        far = [" ".join(str(int(c) + 2**40) for c in line.split()) for line in lines[2:18]]
        (self.folder / "far.off").write_text("\n".join(["OFF", "17 24 0", *far, "0 0 0", *lines[18:]]) + "\n")
        self.assert_done(self.run_program("feature", "far.off", "--kind", "cvf", "--png", "far.png", "--threads", "2"))
        self.assertEqual((self.folder / "near.png").read_bytes(), (self.folder / "far.png").read_bytes())

    def test_shape_diameter(self):
        self.assert_done(self.feature("--kind", "sdf", "--values", "v.txt"))
        values = [float(line) for line in (self.folder / "v.txt").read_text().splitlines()]
        self.assertEqual(len(values), 16)
        self.assertTrue(all(1 < value < 4 for value in values[:8]) and all(0.5 < value < 2 for value in values[8:]), values)

    def test_filter_asks_less_than_search(self):
        tests = [json.loads(self.feature("--kind", "cvf", "--method", method, "--json", "-").stdout)["visibility_tests"]
                 for method in ("filter", "bfs")]
        self.assertLess(tests[0], tests[1])
        self.assertEqual(tests[1], 2 * 8 * 7)

    def test_wrong_usage(self):
        for arguments, word in ((["--kind", "height"], "--kind"), ([], "--kind"), (["--kind", "cvf", "--method", "x"], "--method"),
                                (["--kind", "cvf-weak", "--method", "bfs"], "--method"), (["--kind", "sdf", "--method", "bfs"], "--method"),
                                (["--kind", "cvf", "--weak-threshold", "0.2"], "--weak-threshold"),
                                (["--kind", "cvf-weak", "--weak-threshold", "0"], "--weak-threshold"),
                                (["--kind", "cvf", "--smooth", "-1"], "--smooth"),
                                (["--kind", "cvf", "--png", "v.jpg"], ".png"),
                                (["--kind", "cvf", "--values", "cubes.off"], "same file")):
            self.assert_refused(self.feature(*arguments), 2, word, "--help")
        self.assert_files("cubes.off")

    def test_a_mesh_without_area(self):
        (self.folder / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        result = self.run_program("feature", "flat.off", "--kind", "cvf", "--values", "v.txt")
        self.assert_refused(result, 1, "flat.off: no face has an area; give a mesh")
        self.assert_files("cubes.off", "flat.off")


class Medial(CommandLine):
    def test_points_are_written(self):
        result = self.run_program("medial", NOTCH, "--points", "axis.ply", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        header, points = (self.folder / "axis.ply").read_text().split("end_header\n")
        self.assertIn(f"element vertex {report['samples']}\n", header)
        rows = [[float(word) for word in line.split()] for line in points.splitlines()]
        self.assertEqual(len(rows), report["samples"])
        self.assertGreater(len(rows), 100)
        self.assertTrue(all(row[3] > 0 for row in rows))

    def test_a_picture_of_the_points(self):
        for threads in (1, 2):
            self.assert_done(self.run_program("medial", NOTCH, "--png", f"{threads}.png", "--threads", threads))
        self.assertEqual((self.folder / "1.png").read_bytes(), (self.folder / "2.png").read_bytes())
        picture = Picture(self.folder / "1.png")
        self.assert_framed(picture)
        hues = picture.hues()
        for end in (DARK_BLUE, YELLOW):
            self.assertGreater(share_near(hues, end), 0.003)
        beads = sum(row[3::4].count(255) for row in picture.rows) / (960 * 800)
        self.assertTrue(0.005 < beads < 0.5, beads)  # beads, not a surface

    def test_a_picture_of_no_points(self):
        (self.folder / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.assert_done(self.run_program("medial", "flat.off", "--png", "a.png"))
        picture = Picture(self.folder / "a.png")
        self.assertEqual((picture.width, picture.height), (960, 800))
        self.assertFalse(any(any(row) for row in picture.rows))

    def test_wrong_usage(self):
        self.assert_refused(self.run_program("medial", NOTCH, "--points", "axis.txt"), 2, ".ply")
        self.assert_refused(self.run_program("medial", NOTCH, "--png", "axis.ply"), 2, ".png")
        self.assert_refused(self.run_program("medial", NOTCH, "--spacing", "0"), 2, "--spacing")
        self.assert_refused(self.run_program("medial", NOTCH, "--spacing", "0.001"), 1, "spacing", "0.005")
        self.assert_refused(self.run_program("medial", NOTCH, "--least-angle", "200"), 1, "least_angle")
        self.assert_files()


class Applications(CommandLine):
    """cage, deform, repair, unfold."""

    HORSE = DATA / "models" / "horse.ply"

    def vertices(self, name):
        lines = (self.folder / name).read_text().splitlines()
        return [tuple(map(float, line.split()[1:4])) for line in lines if line.startswith("v ")]

    def write_moves(self, *handles):
        (self.folder / "moves.json").write_text(json.dumps({"handles": handles}))

    def test_a_cage_encloses_and_has_few_faces(self):
        for threads in (1, 2):
            result = self.run_program("cage", self.HORSE, "-o", f"{threads}.obj", "--json", "-", "--threads", threads)
            self.assert_done(result)
        self.assertEqual((self.folder / "1.obj").read_bytes(), (self.folder / "2.obj").read_bytes())
        report = json.loads(result.stdout)
        self.assertLessEqual(report["faces"], 300)
        self.assertTrue(report["encloses"] and report["watertight"])
        self.assertGreater(report["parts"], 1)

    def test_a_cage_deforms(self):
        self.assert_done(self.run_program("cage", NOTCH, "-o", "cage.obj", "--png", "cage.png"))
        Picture(self.folder / "cage.png")
        self.write_moves()
        self.assert_done(self.run_program("deform", NOTCH, "cage.obj", "moves.json", "-o", "still.obj"))
        self.write_moves({"all": True, "scale": [1, 2, 0.5], "about": [0, 0, 0], "move": [1, 0, 0]})
        result = self.run_program("deform", NOTCH, "cage.obj", "moves.json", "-o", "affine.obj", "--cage", "moved.obj",
                                  "--coordinates", "mean-value", "--json", "-")
        self.assert_done(result)
        self.assertLess(json.loads(result.stdout)["identity_error"], 1e-12)
        for still, moved in zip(self.vertices("still.obj"), self.vertices("affine.obj"), strict=True):
            for a, b in zip((still[0] + 1, 2 * still[1], still[2] / 2), moved):
                self.assertAlmostEqual(a, b, delta=1e-9)
        self.assertEqual(len(self.vertices("cage.obj")), len(self.vertices("moved.obj")))

    def test_what_deform_refuses(self):
        self.assert_done(self.run_program("cage", NOTCH, "-o", "cage.obj"))
        self.write_moves({"vertices": [100000], "move": [0, 0, 1]})
        before = sorted(p.name for p in self.folder.iterdir())
        deform = ["deform", NOTCH, "cage.obj", "moves.json", "-o", "a.obj"]
        self.assert_refused(self.run_program(*deform), 1, "moves.json", "handles[0].vertices", "100000")
        self.write_moves()
        self.assert_refused(self.run_program("deform", "cage.obj", NOTCH, "moves.json", "-o", "a.obj"), 1, "cage.obj",
                            "is not inside")
        self.assert_refused(self.run_program(*deform, "--coordinates", "harmonic"), 2, "--coordinates", "green")
        self.assert_refused(self.run_program(*deform[:3], "-o", "a.obj"), 2, "MOVES")
        self.assert_refused(self.run_program(*deform[:5], "cage.obj"), 2, "same file")
        (self.folder / "open.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.assert_refused(self.run_program("deform", NOTCH, "open.off", "moves.json", "-o", "a.obj"), 1, "open.off",
                            "is not closed")
        self.assert_files(*before, "open.off")

    def test_a_broken_mesh_is_repaired(self):
        lines = NOTCH.read_text().splitlines()
        faces = [line for line in lines if line.startswith("f ")]
        gone = set(faces[::9])
        (self.folder / "broken.obj").write_text("\n".join(line for line in lines if line not in gone))
        result = self.run_program("repair", "broken.obj", "-o", "whole.obj", "--tolerance", "0.3",
                                  "--reference", NOTCH, "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertTrue(report["watertight"])
        self.assertLess(report["reach"], 0.5)
        for field in ("added", "lost", "volume_added", "volume_lost"):
            self.assertIn(field, report)
        again = self.run_program("decompose", "whole.obj", "--tolerance", "0.2", "--json", "-")
        self.assertTrue(json.loads(again.stdout)["watertight"])
        self.assert_refused(self.run_program("repair", NOTCH, "-o", "b.obj", "--reference", "broken.obj"), 1,
                            "broken.obj", "not watertight")
        self.assert_refused(self.run_program("repair", NOTCH, "-o", "b.obj", "--tolerance", "0.001"), 1, "tolerance")

    def test_nets_are_drawn(self):
        result = self.run_program("unfold", self.HORSE, "-o", "a.svg", "--pdf", "a.pdf", "--hulls", "a.obj", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual(report["overlaps"], 0)
        self.assertGreaterEqual(report["nets"], report["parts"])
        self.assertLess(report["refolding_error"], 1e-6)
        svg = (self.folder / "a.svg").read_text()
        self.assertEqual(svg.count("<rect "), report["pages"])
        self.assertEqual(len(re.findall(r">part \d+<", svg)), report["nets"])
        pdf = (self.folder / "a.pdf").read_bytes()
        self.assertTrue(pdf.startswith(b"%PDF-1.4\n") and pdf.endswith(b"%%EOF\n"))
        self.assertIn(b"/Count %d " % report["pages"], pdf)
        self.assert_files("a.svg", "a.pdf", "a.obj")
        self.assert_refused(self.run_program("unfold", NOTCH, "-o", "b.pdf"), 2, ".svg")
        self.assert_refused(self.run_program("unfold", NOTCH, "-o", "b.svg", "--scale", "1e6"), 1, "scale", "page")


class Outline(CommandLine):
    """The verbs for shapes in the plane."""

    shapes = NOTCH.parents[1] / "data" / "outlines"

    def outline(self, *arguments, shape="hole3.poly", tolerance=0.05):
        return self.run_program("outline", self.shapes / shape, "--tolerance", tolerance, *arguments)

    def test_every_output_is_there(self):
        outputs = dict(parts="a.geojson", svg="a.svg", skeleton="b.svg")
        arguments = [part for name, file in outputs.items() for part in ("--" + name, file)]
        result = self.outline(*arguments, "--json", "a.json")
        self.assert_done(result)
        report = json.loads((self.folder / "a.json").read_text())
        for field in "parts cuts holes_kept holes_noise concavity unresolved radius seconds".split():
            self.assertIn(field, report)
        self.assertEqual(report["files"], outputs)
        self.assertEqual(report["holes_kept"] + report["holes_noise"], 3)
        self.assertLessEqual(report["concavity"], 0.05)
        parts = json.loads((self.folder / "a.geojson").read_text())["features"]
        self.assertEqual(len(parts), report["parts"])

        def twice_area(ring):
            return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:]))

        total = sum(twice_area(ring) for part in parts for ring in part["geometry"]["coordinates"]) / 2
        self.assertAlmostEqual(total / report["area"], 1, places=12)
        for name in ("a.svg", "b.svg"):
            self.assertTrue((self.folder / name).read_text().startswith("<svg"))

    def test_same_bytes_again(self):
        for name in ("a", "b"):
            self.assert_done(self.outline("--parts", name + ".geojson", "--threads", 1 if name == "a" else 2, shape="neuron.poly"))
        self.assertEqual((self.folder / "a.geojson").read_bytes(), (self.folder / "b.geojson").read_bytes())

    def test_malformed_number_is_named_and_read_leniently(self):
        self.assert_refused(self.outline(shape="bird.poly"), 1, "bird.poly:47", "-6.64248.788605")
        self.assert_done(self.outline("--lenient", shape="bird.poly"))

    def test_fewer_parts_than_acd2d_at_its_tolerance(self):
        # 0.1 of acd2d's radius, which is 1.03 times the enclosing circle's here.
        for shape, ratio, parts in (("mammoth.poly", 1.03, 10), ("hole3.poly", 1.18, 17), ("neuron.poly", 1.14, 41)):
            result = self.outline("--json", "-", shape=shape, tolerance=0.1 * ratio)
            self.assertLessEqual(json.loads(result.stdout)["parts"], parts)

    def test_faults_are_repaired_or_refused(self):
        bow = self.folder / "bow.wkt"
        bow.write_text("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")
        repaired = self.run_program("outline", bow, "--tolerance", 0.1, "--json", "-")
        self.assertIn("(2, 2)", json.loads(repaired.stdout)["repaired"])
        self.assert_refused(self.run_program("outline", bow, "--tolerance", 0.1, "--strict"), 1, "bow.wkt", "(2, 2)")

    def test_wrong_usage(self):
        self.assert_refused(self.run_program("outline", "a.poly"), 2, "--tolerance")
        self.assert_refused(self.outline("--parts", "a.obj"), 2, ".geojson")
        self.assert_refused(self.run_program("outline", "a.xyz", "--tolerance", 0.1), 1, "a.xyz")
        self.assert_refused(self.run_program("compare2d", "a.geojson"), 2, "B")

    def test_compare(self):
        self.assert_done(self.outline("--parts", "a.geojson"))
        self.assert_done(self.outline("--parts", "b.geojson", tolerance=0.3))
        report = json.loads(self.run_program("compare2d", "a.geojson", "a.geojson", "--json", "-").stdout)
        self.assertEqual((report["rand_index"], report["cluster_coverage"]), (1, 1))
        report = json.loads(self.run_program("compare2d", "a.geojson", "b.geojson", "a.geojson", "--json", "-").stdout)
        self.assertLess(report["rand_index_each"][0], 1)
        self.assertEqual(report["rand_index_each"][1], 1)

    def test_compare_with_label_images(self):
        def png(name, colours):
            rows = b"".join(b"\0" + b"".join(bytes(colours[letter]) for letter in row) for row in ["aaab", "aaab", ".ccb"])
            def chunk(kind, data):
                return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
            header = struct.pack(">IIBBBBB", 4, 3, 8, 2, 0, 0, 0)
            (self.folder / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                             chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

        png("mine.png", {"a": (255, 0, 0), "b": (0, 255, 0), "c": (0, 0, 255), ".": (0, 0, 0)})
        png("two.png", {"a": (9, 9, 9), "b": (9, 9, 9), "c": (0, 0, 255), ".": (0, 0, 0)})
        boxes = [[(0, 0), (3, 0), (3, 2), (1, 2), (0, 2)], [(3, 0), (4, 0), (4, 3), (3, 3), (3, 2)], [(1, 2), (3, 2), (3, 3), (1, 3)]]
        (self.folder / "same.geojson").write_text(json.dumps({"type": "MultiPolygon", "coordinates": [[box] for box in boxes]}))
        report = json.loads(self.run_program("compare2d", "mine.png", "same.geojson", "--json", "-").stdout)
        self.assertEqual((report["rand_index"], report["cluster_coverage"]), (1, 1))
        report = json.loads(self.run_program("compare2d", "mine.png", "two.png", "--json", "-").stdout)
        # The 6 pixels of a and the 3 of b, of 11, are apart in mine and together in the other.
        self.assertAlmostEqual(report["rand_index"], 1 - 2 * 6 / 11 * 3 / 11, delta=0.01)
        (self.folder / "text.png").write_text("no picture")
        self.assert_refused(self.run_program("compare2d", "text.png", "mine.png"), 1, "text.png", "PNG")


class Segment(CommandLine):
    def setUp(self):
        """Two cubes of side 4 and a thin bar from one to the other, as quads of side 1."""
        super().setUp()
        solid = {(x, y, z) for x in range(4) for y in range(4) for z in range(4)}
        solid |= {(x + 10, y, z) for x, y, z in solid} | {(x, 1, 1) for x in range(4, 10)}
        points, faces, self.parts = {}, [], []
        for cell in sorted(solid):
            for axis in range(3):
                for up in (0, 1):
                    beside = tuple(c + (2 * up - 1) * (k == axis) for k, c in enumerate(cell))
                    if beside in solid:
                        continue
                    corners = []
                    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)) if up else ((0, 0), (0, 1), (1, 1), (1, 0)):
                        corner = list(cell)
                        corner[axis] += up
                        corner[(axis + 1) % 3] += u
                        corner[(axis + 2) % 3] += v
                        corners.append(points.setdefault(tuple(corner), len(points)))
                    faces.append(corners)
                    self.parts += [0 if cell[0] < 4 else 1 if cell[0] < 10 else 2] * 2
        lines = ["OFF", f"{len(points)} {len(faces)} 0"]
        lines += [f"{x} {y} {z}" for x, y, z in points] + ["4 " + " ".join(map(str, face)) for face in faces]
        (self.folder / "bar.off").write_text("\n".join(lines) + "\n")

    def segment(self, *arguments):
        return self.run_program("segment", "bar.off", "--feature", "sdf", *arguments)

    def test_every_output_is_there(self):
        result = self.segment("--clusters", "2", "--labels", "a.seg", "--glb", "a.glb", "--json", "a.json")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"^bar\.off: 3 parts by sdf \(2 clusters, smoothness [0-9.]+\)\nwrote a.seg, a.glb\n$")
        self.assert_files("bar.off", "a.seg", "a.glb", "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(list(report), "parts clusters smoothness borders feature faces input files seconds reads".split())
        self.assertEqual((report["parts"], report["clusters"], report["feature"]), (3, 2, "sdf"))
        self.assertEqual(report["faces"], len(self.parts))
        for stage in ("read", "feature", "cluster", "write", "total"):
            self.assertGreaterEqual(report["seconds"][stage], 0)
        labels = (self.folder / "a.seg").read_text().split()
        self.assertEqual(len(labels), len(self.parts))
        wrong = sum(int(label) != part for label, part in zip(labels, self.parts))
        self.assertLess(wrong, 0.05 * len(labels))

    def test_a_picture_has_a_hue_a_part(self):
        for threads in (1, 2):
            self.assert_done(self.segment("--clusters", "2", "--png", f"{threads}.png", "--threads", threads))
        self.assertEqual((self.folder / "1.png").read_bytes(), (self.folder / "2.png").read_bytes())
        picture = Picture(self.folder / "1.png")
        self.assert_framed(picture)
        peaks, hues = [], picture.hues()
        while max(hues) > 300:  # a hue and its shades, then the next
            peaks.append(hues.index(max(hues)))
            for near in range(peaks[-1] - 12, peaks[-1] + 13):
                hues[near % 360] = 0
        self.assertEqual(len(peaks), 3, peaks)

    def test_every_feature(self):
        for kind in ("cvf", "cvf-avg", "cvf-strong", "cvf-weak", "sdf"):
            report = json.loads(self.run_program("segment", "bar.off", "--feature", kind, "--json", "-").stdout)
            self.assertEqual(report["feature"], kind)
            self.assertGreater(report["parts"], 1, kind)

    def test_the_two_numbers_decide(self):
        report = json.loads(self.segment("--clusters", "1", "--json", "-").stdout)
        self.assertEqual(report["parts"], 1)
        report = json.loads(self.segment("--smoothness", "1e6", "--json", "-").stdout)
        self.assertEqual((report["parts"], report["smoothness"]), (1, 1e6))

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in ("1", "3"):
            self.assert_done(self.segment("--labels", f"{threads}.seg", "--threads", threads))
        self.assertEqual((self.folder / "1.seg").read_bytes(), (self.folder / "3.seg").read_bytes())

    def test_what_cannot_be_done(self):
        (self.folder / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        result = self.run_program("segment", "flat.off", "--feature", "sdf", "--labels", "a.seg")
        self.assert_refused(result, 1, "flat.off: no face has an area")
        cases = [
            ((), "--feature"),
            (("--feature", "hue"), "sdf"),
            (("--feature", "sdf", "--clusters", "0"), "--clusters"),
            (("--feature", "sdf", "--smoothness", "-1"), "--smoothness"),
            (("--feature", "sdf", "--glb", "a.off"), ".glb"),
            (("--feature", "sdf", "--png", "a.svg"), ".png"),
        ]
        for arguments, word in cases:
            self.assert_refused(self.run_program("segment", "bar.off", *arguments), 2, word, "--help")
        self.assert_files("bar.off", "flat.off")

    def test_help_teaches_with_an_example(self):
        result = self.run_program("segment", "--help")
        self.assert_done(result)
        for word in ("Example:\n", "--feature", "--clusters", "--smoothness", "--labels", "--glb", "--png"):
            self.assertIn(word, result.stdout)


class Retrieve(CommandLine):
    """A folder of two dumb-bells of cubes, one of them twice as large, and a box."""

    def setUp(self):
        super().setUp()
        self.database = self.folder / "database"
        (self.database / "more").mkdir(parents=True)
        for name, mesh in (("bells.off", self.bells()), ("more/large.off", self.bells(2)), ("box.off", self.grid(
                {(x, y, z) for x in range(4) for y in range(4) for z in range(4)}))):
            (self.database / name).write_text(mesh)

    def bells(self, scale=1):
        cube = {(x, y, z) for x in range(4) for y in range(4) for z in range(4)}
        return self.grid(cube | {(x + 10, y, z) for x, y, z in cube} | {(x, 1, 1) for x in range(4, 10)}, scale)

    def grid(self, cells, scale=1):
        """The surface of unit cells, as OFF."""
        vertices, faces = {}, []
        corner = lambda *p: vertices.setdefault(p, len(vertices))  # noqa: E731
        for cell in sorted(cells):
            for axis in range(3):
                for side in (0, 1):
                    beyond = list(cell)
                    beyond[axis] += 2 * side - 1
                    if tuple(beyond) in cells:
                        continue
                    quad = []
                    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        point = list(cell)
                        point[axis] += side
                        point[(axis + 1) % 3] += u
                        point[(axis + 2) % 3] += v
                        quad.append(corner(*point))
                    a, b, c, d = quad if side else quad[::-1]
                    faces += [(a, b, c), (a, c, d)]
        lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
        lines += [" ".join(str(scale * x) for x in p) for p in vertices]
        lines += ["3 %d %d %d" % face for face in faces]
        return "\n".join(lines) + "\n"

    def retrieve(self, part, *arguments, query="database/bells.off"):
        return self.run_program("retrieve", query, part, "database", *arguments)

    def found(self, part, *arguments, **options):
        result = self.retrieve(part, *arguments, "--json", "-", **options)
        self.assert_done(result)
        return json.loads(result.stdout)

    def test_finds_itself_and_its_like(self):
        self.assert_done(self.run_program("segment", "database/bells.off", "--feature", "cvf-avg", "--labels", "bells.seg"))
        labels = (self.folder / "bells.seg").read_text().split()
        parts = len(set(labels))
        self.assertGreater(parts, 1)
        report = self.found(parts - 1, "--top", 3)
        self.assertEqual((report["meshes"], report["indexed"], report["skipped"]), (3, 3, []))
        first, second, _ = report["matches"]
        self.assertEqual(list(first), ["file", "part", "similarity", "faces"])
        self.assertEqual({first["file"], second["file"]} & {"box.off"}, set())
        self.assertEqual(first["similarity"], 1)
        self.assertIn(parts - 1, [m["part"] for m in report["matches"] if m["similarity"] > 0.999])
        self.assertEqual(first["faces"], labels.count(str(first["part"])))
        self.assertGreaterEqual(report["seconds"]["total"], 0)
        others = self.found(parts - 1, "--others")
        self.assertEqual(others["indexed"], 0)
        self.assertEqual(others["matches"][0]["file"], "more/large.off")
        self.assertNotIn("bells.off", [m["file"] for m in others["matches"]])
        self.assertGreater(others["matches"][0]["similarity"], 0.999)
        similarities = [m["similarity"] for m in others["matches"]]
        self.assertEqual(similarities, sorted(similarities, reverse=True))
        self.assertLessEqual(len(similarities), 9)

    def test_index_is_kept_and_renewed(self):
        self.assertEqual(self.found(0)["indexed"], 3)
        kept = {p.name: p.read_bytes() for p in (self.database / ".partwise").rglob("*.json")}
        self.assertEqual(sorted(kept), ["bells.off.parts.json", "box.off.parts.json", "large.off.parts.json"])
        self.assertEqual(self.found(0)["indexed"], 0)
        (self.database / "box.off").write_text(self.grid({(x, 0, 0) for x in range(5)}))
        (self.database / "new.off").write_text("OFF\n")
        report = self.found(0)
        self.assertEqual(report["indexed"], 1)
        self.assertEqual([each["file"] for each in report["skipped"]], ["new.off"])
        other = self.found(0, "--index", "kept", "--threads", 1)
        self.assertEqual((other["indexed"], other["matches"]), (3, report["matches"]))
        self.assertEqual((self.folder / "kept" / "bells.off.parts.json").read_bytes(), kept["bells.off.parts.json"])

    def test_a_query_from_outside_and_a_picture(self):
        (self.folder / "mine.off").write_text(self.bells(3))
        result = self.retrieve(0, "--glb", "row.glb", query="mine.off")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"mine\.off: parts like part 0 in 3 meshes, 3 of them indexed now")
        self.assertEqual((self.folder / "row.glb").read_bytes()[:4], b"glTF")
        self.assertIn(b"match_1_part", (self.folder / "row.glb").read_bytes())

    def test_what_cannot_be_done(self):
        self.assert_refused(self.retrieve(99), 1, "no part 99", "0 (", "%")
        self.assert_refused(self.run_program("retrieve", NOTCH, 0, "missing"), 1, "missing")
        (self.folder / "empty").mkdir()
        self.assert_refused(self.run_program("retrieve", NOTCH, 0, "empty"), 1, "no mesh")
        self.assert_refused(self.retrieve(0, query="none.off"), 1, "none.off")
        for words in (["-1"], ["leg"], [0, "--top", 0], [0, "--glb", "a.obj"]):
            self.assert_refused(self.retrieve(*words), 2, "--help")

    def test_help_teaches_with_an_example(self):
        result = self.run_program("retrieve", "--help")
        self.assert_done(result)
        for word in ("QUERY", "PART", "DATABASE_DIR", "--top", "--others", "--index", "--glb", "Example:\n"):
            self.assertIn(word, result.stdout)


class Material(CommandLine):
    def write_table(self, name, values):
        """A MERL table of one value a channel, as the eye sees it."""
        count = 90 * 90 * 180
        with (self.folder / name).open("wb") as out:
            out.write(struct.pack("<3i", 90, 90, 180))
            for value, scale in zip(values, (1, 1.15, 1.66)):
                out.write(struct.pack("<d", 1500 * value / scale) * count)

    def test_list_names_a_hundred(self):
        result = self.run_program("material", "list", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual(len(report["materials"]), 100)
        self.assertIn("chrome", report["materials"])
        plain = self.run_program("material", "list")
        self.assertEqual(plain.stdout.split(), report["materials"])

    def test_fit_of_a_flat_table_is_flat(self):
        self.write_table("matte.binary", (0.2, 0.1, 0.05))
        for threads in (1, 2):
            result = self.run_program("material", "fit", "matte.binary", "-o", f"{threads}.json", "--threads", threads, "--json", "-")
            self.assert_done(result)
            report = json.loads(result.stdout)
            self.assertLess(report["log_rmse"], 0.02)
            self.assertEqual(report["files"], {"o": f"{threads}.json"})
        material = json.loads((self.folder / "1.json").read_text())
        self.assertEqual(material["name"], "matte")
        self.assertEqual([len(material[channel]) for channel in ("red", "green", "blue")], [3, 3, 3])
        self.assertEqual((self.folder / "1.json").read_bytes(), (self.folder / "2.json").read_bytes())

    def test_what_cannot_be_fitted_is_one_line(self):
        (self.folder / "short.binary").write_bytes(bytes(5))
        (self.folder / "text.h5").write_text("text")
        for name, word in (("short.binary", "too short"), ("text.h5", "no HDF5"), ("none.h5", "does not exist"), ("a.png", ".binary and .h5")):
            self.assert_refused(self.run_program("material", "fit", name, "-o", "out.json"), 1, name, word)
        for wrong in ([], ["fit"], ["fit", "short.binary"], ["polish"], ["fit", "short.binary", "-o", "out.png"]):
            self.assert_refused(self.run_program("material", *wrong), 2, "material --help")
        self.assert_files("short.binary", "text.h5")

    def ball(self, name, *arguments, output="ball.png"):
        return self.run_program("material", "ball", name, "-o", output, "--size", 48, *arguments)

    def test_a_ball_is_round_and_stands_on_clear_ground(self):
        result = self.ball("red-fabric", "--json", "-")
        self.assert_done(result)
        report = json.loads(result.stdout)
        self.assertEqual((report["name"], report["light"], report["width"], report["height"]), ("red-fabric", "venice", 48, 48))
        self.assertEqual(report["files"], {"o": "ball.png"})
        self.assertEqual(sorted(report["seconds"]), ["read", "render", "total", "write"])
        picture = Picture(self.folder / "ball.png")
        self.assertEqual((picture.width, picture.height), (48, 48))
        pixels = [[row[4 * x:4 * x + 4] for x in range(48)] for row in picture.rows]
        for corner in (pixels[0][0], pixels[0][47], pixels[47][0], pixels[47][47]):
            self.assertEqual(corner[3], 0)
        alpha = [pixel[3] / 255 for row in pixels for pixel in row]
        self.assertAlmostEqual(sum(alpha) / 48 ** 2, 3.14159 / 4, delta=0.003)
        self.assertTrue(any(0.1 < each < 0.9 for each in alpha))  # no stairs at its rim
        red, green, blue = (sum(pixel[k] for row in pixels for pixel in row) for k in range(3))
        self.assertGreater(red, 1.5 * max(green, blue))

    def test_balls_of_files_under_lights_of_files(self):
        chrome, studio = DATA.parent / "models" / "materials" / "chrome.json", DATA / "lights" / "studio.exr"
        made = []
        for name, light in (("chrome", "studio"), (chrome, studio)):
            for threads in (1, 3):
                self.assert_done(self.ball(name, "--light", light, "--threads", threads))
                made.append((self.folder / "ball.png").read_bytes())
        self.assertEqual(len(set(made)), 1)
        self.assert_done(self.ball("chrome", output="ball.exr"))
        self.assertEqual((self.folder / "ball.exr").read_bytes()[:4], b"v/1\x01")
        self.write_table("matte.binary", (0.9, 0.1, 0.05))
        self.assert_done(self.run_program("material", "ball", "matte.binary", "-o", "ball.png", "--size", 8))
        self.assert_refused(self.ball("chrome", "--light", "ball.exr", output="ball.exr"), 2, "ball.exr")

    def test_a_ball_of_what_is_not_there_is_one_line(self):
        self.assert_refused(self.ball("chrom"), 1, "chrom", "did you mean chrome, chrome-steel?", "material list")
        self.assert_refused(self.ball("fabric"), 1, "did you mean", "-fabric")
        self.assert_refused(self.ball("unobtainium"), 1, "none of those that ship; partwise material list names all")
        self.assert_refused(self.ball("none.json"), 1, "none.json", "does not exist")
        self.assert_refused(self.ball("chrome", "--light", "moon"), 1, "moon", "studio")
        self.assert_refused(self.ball("chrome", "--light", "none.exr"), 1, "none.exr")
        for wrong in (["--size", 0], ["--size", "big"], ["--light", ""]):
            self.assert_refused(self.ball("chrome", *wrong), 2, "material --help")
        self.assert_refused(self.ball("chrome", output="ball.gif"), 2, ".png")
        self.assert_refused(self.run_program("material", "ball", "chrome"), 2, "-o")
        self.assert_files()

    def test_a_table_of_nothing_is_refused(self):
        self.write_table("black.binary", (-1, -1, -1))
        self.assert_refused(self.run_program("material", "fit", "black.binary", "-o", "out.json"), 1, "nothing was measured")


class Outputs(CommandLine):
    def test_bad_places_are_told_before_the_work(self):
        (self.folder / "a_folder").mkdir()
        for place, words in (
            ("none/a.seg", "no folder"),
            ("a_folder", "is a folder"),
            (NOTCH / "a.seg", "no folder"),
        ):
            for option in ("--labels", "--json"):
                # The mesh is missing too: what is said first was looked at first.
                result = self.decompose(option, place, mesh="none.off")
                self.assert_refused(result, 1, words)
        self.assert_files("a_folder")

    def test_a_protected_folder(self):
        # Not even root may make files here.
        self.assert_refused(self.decompose("--labels", "/proc/a.seg"), 1, "/proc/a.seg", "cannot be written")
        self.assert_refused(self.decompose("--labels", "/proc/a.seg", "--hulls", "a.obj"), 1, "/proc/a.seg")
        self.assert_files()

    def test_a_full_disk_leaves_nothing(self):
        (self.folder / "a.obj").write_text("precious")
        result = self.decompose("--labels", "/dev/full", "--hulls", "a.obj", "--glb", "a.glb", "--json", "a.json")
        self.assert_refused(result, 1, "/dev/full", "No space left")
        self.assert_files("a.obj")
        self.assertEqual((self.folder / "a.obj").read_text(), "precious")
        self.assertTrue(Path("/dev/full").is_char_device())

    def test_a_report_that_cannot_be_printed_is_a_failure(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run(
                [PROGRAM, "decompose", NOTCH, "--tolerance", "0.1", "--json", "-"],
                stdout=full, stderr=subprocess.PIPE, text=True, timeout=60,
            )
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_an_output_that_another_one_brings_along(self):
        (self.folder / "a_hulls").mkdir()
        result = self.decompose("--urdf", "a.urdf", "--hulls", "a_hulls/hull_000.obj")
        self.assert_refused(result, 1, "a_hulls/hull_000.obj", "another output")
        self.assert_files("a_hulls")

    def test_devices_and_links(self):
        result = self.decompose("--quiet", "--labels", "/dev/stdout")
        self.assert_done(result)
        self.assertEqual(len(result.stdout.split()), 28)
        (self.folder / "link.seg").symlink_to("real.seg")
        self.assert_done(self.decompose("--labels", "link.seg"))
        self.assert_files("link.seg", "real.seg")

    def test_old_files_are_replaced_only_by_a_success(self):
        (self.folder / "a.seg").write_text("precious")
        self.assert_refused(self.decompose("--labels", "a.seg", mesh="none.off"), 1, "none.off")
        self.assertEqual((self.folder / "a.seg").read_text(), "precious")
        self.assert_done(self.decompose("--labels", "a.seg"))
        self.assertEqual(len((self.folder / "a.seg").read_text().split()), 28)
        self.assert_files("a.seg")

    def test_inputs_that_cannot_be_read(self):
        (self.folder / "mesh.xyz").write_text("0 0 0\n")
        (self.folder / "empty.off").write_text("")
        (self.folder / "two\nlines.off").write_text("OFF\n1 2\n")
        for mesh in ("none.off", "mesh.xyz", "empty.off", "two\nlines.off", self.folder):
            with self.subTest(mesh=mesh):
                self.assert_refused(self.decompose("--labels", "a.seg", mesh=mesh), 1)
        self.assert_files("mesh.xyz", "empty.off", "two\nlines.off")


class Stopping(CommandLine):
    def big_mesh(self):
        """A bumpy sheet that takes seconds, not milliseconds."""
        side = 400
        lines = ["OFF", f"{side * side} {2 * (side - 1) ** 2} 0"]
        lines += [f"{x} {y} {9 * ((x // 20 + y // 20) % 2) + (x * y) % 3}" for y in range(side) for x in range(side)]
        for y in range(side - 1):
            for x in range(side - 1):
                a = y * side + x
                lines += [f"3 {a} {a + 1} {a + side}", f"3 {a + 1} {a + side + 1} {a + side}"]
        path = self.folder / "sheet.off"
        path.write_text("\n".join(lines) + "\n")
        return path

    def wait_for_handler(self, process, number):
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            status = Path(f"/proc/{process.pid}/status").read_text()
            caught = int(status.split("SigCgt:")[1].split()[0], 16)
            if caught >> (number - 1) & 1:
                return
            time.sleep(0.001)
        self.fail("the program does not catch the signal")

    def test_ctrl_c_stops_cleanly(self):
        mesh = self.big_mesh()
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen(
                [PROGRAM, "decompose", mesh, "--tolerance", "0.01", "--labels", self.folder / "a.seg"],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            )
            self.wait_for_handler(process, number)
            process.send_signal(number)
            output, message = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + number, message)
            self.assertEqual(output, "")
            self.assertEqual(message, "partwise: stopped on request; nothing was written\n")
            self.assert_files("sheet.off")

    def test_progress_is_for_terminals(self):
        for arguments, expected in (([], True), (["--quiet"], False)):
            try:
                terminal, end = pty.openpty()
            except OSError as error:  # a bare root has no terminals to give
                self.skipTest(str(error))
            process = subprocess.Popen(
                [PROGRAM, "decompose", NOTCH, "--tolerance", "0.1", *arguments],
                stdout=subprocess.DEVNULL, stderr=end,
            )
            os.close(end)
            shown = b""
            try:
                while chunk := os.read(terminal, 4096):
                    shown += chunk
            except OSError:
                pass  # the other end is closed and everything is read
            os.close(terminal)
            self.assertEqual(process.wait(timeout=60), 0)
            self.assertEqual(b"%" in shown, expected)
            if expected:
                self.assertTrue(shown.endswith(b"\r\x1b[K"), "the line is wiped at the end")


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
