#!/usr/bin/python3
"""Cages, nets and repaired meshes of a folder of meshes. See bench/README.md.

    applications_bench.py FOLDER [--category-of psb] [--only first-of-category] [--repair 0.1 0.05] [--record]
"""

import argparse
import json
import math
import sys
import tempfile
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, meshes  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import table  # noqa: E402

LIMIT = 3600  # seconds a program


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", type=Path, help="of meshes (.off, closed, triangles)")
    add("--category-of", choices=["psb", "folder"], default="folder", help="where --only first-of-category looks")
    add("--only", help="names, or first-of-category")
    add("--repair", type=float, nargs="*", default=[], metavar="TOLERANCE", help="instead: repair without a share of the faces")
    add("--gone", type=float, default=0.45, help="that share")
    add("--program", type=Path, default=BIN / "partwise")
    add("--record", action="store_true", help="append the result to bench/history/applications.jsonl")
    return parser.parse_args(words)


def reported(options, *words):
    done = expect([options.program, *words, "--json", "-", "--quiet"], LIMIT)
    return json.loads(done.output)


def read_obj(path):
    words = [line.split() for line in path.read_text().splitlines()]
    return ([tuple(map(float, line[1:4])) for line in words if line[:1] == ["v"]],
            [tuple(int(word.split("/")[0]) - 1 for word in line[1:4]) for line in words if line[:1] == ["f"]])


def is_closed(faces):
    """Every edge has two faces, which take it in opposite directions."""
    edges = Counter((face[k], face[(k + 1) % 3]) for face in faces for k in range(3))
    return all(count == 1 and edges[end, start] == 1 for (start, end), count in edges.items())


def winding(vertices, faces, point):
    """By solid angles (van Oosterom, Strackee 1983)."""
    around = [(x - point[0], y - point[1], z - point[2]) for x, y, z in vertices]
    lengths = [math.sqrt(x * x + y * y + z * z) for x, y, z in around]

    def dot(a, b):
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

    total = 0
    for i, j, k in faces:
        a, b, c = around[i], around[j], around[k]
        volume = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
        total += math.atan2(volume, lengths[i] * lengths[j] * lengths[k] + dot(a, b) * lengths[k] + dot(b, c) * lengths[i] + dot(c, a) * lengths[j])
    return total / (2 * math.pi)


def cages_and_nets(options, paths, folder):
    rows, found = [], {}
    for path in paths:
        cage = reported(options, "cage", path, "-o", folder / "cage.obj")
        nets = reported(options, "unfold", path, "-o", folder / "nets.svg")
        around = read_obj(folder / "cage.obj")
        off_by = max(abs(winding(*around, vertex) - 1) for vertex in meshes.read_off(path)[0])
        found[path.stem] = {"faces": len(around[1]), "closed": is_closed(around[1]), "winding_off_by": off_by, "expansion": cage["expansion"],
                            "cage_seconds": cage["seconds"]["cage"], "parts": nets["parts"], "nets": nets["nets"],
                            "overlaps": nets["overlaps"], "refolding_error": nets["refolding_error"],
                            "glued": nets["glued"], "without_tab": nets["without_tab"]}
        each = found[path.stem]
        rows.append([path.stem, str(each["faces"]), f"{each['expansion']:g}", f"{each['cage_seconds']:.2f}", f"{each['winding_off_by']:.0e}", f"{each['nets']} of {each['parts']}",
                     str(each["overlaps"]), f"{each['refolding_error']:.1e}", f"{each['without_tab']} of {each['glued']}"])
    print(table(["mesh", "cage's faces", "expansion", "seconds", "winding off by", "nets of parts", "overlaps", "refolding", "without tab"], rows))
    every = found.values()
    verdicts = {"every cage is closed, has at most 300 faces, and winds once about every vertex of its mesh":
                all(each["closed"] and each["faces"] <= 300 and each["winding_off_by"] < 1e-6 for each in every),
                "no net overlaps itself, and all refold within 1e-6": all(each["overlaps"] == 0 and each["refolding_error"] <= 1e-6 for each in every)}
    return found, verdicts


def repairs(options, paths, folder):
    rows, found, verdicts = [], {}, {}
    for path in paths:
        vertices, faces = meshes.read_off(path)
        broken = folder / "broken.off"
        meshes.write_off(broken, vertices, meshes.thinned_out(faces, options.gone, seed=1))
        for tolerance in options.repair:
            each = reported(options, "repair", broken, "-o", folder / "whole.obj", "--tolerance", tolerance, "--reference", path)
            found[f"{path.stem} {tolerance:g}"] = {name: each[name] for name in
                                                   ("parts", "watertight", "reach", "added", "lost", "volume_added", "volume_lost")}
            rows.append([path.stem, f"{tolerance:g}", str(each["parts"]), *(f"{each[name]:.3f}" for name in ("reach", "added", "lost")),
                         f"+{each['volume_added']:.0%}", f"-{each['volume_lost']:.1%}"])
            verdicts[f"{path.stem} at {tolerance:g}: added and lost within the tolerance"] = max(each["added"], each["lost"]) <= tolerance
    print(table(["mesh", "tolerance", "parts", "reach", "added", "lost", "volume", ""], rows))
    print(f"{options.gone:.0%} of the faces gone")
    return found, verdicts


def main(words):
    options = parse(words)
    category = meshes.princeton_category if options.category_of == "psb" else meshes.folder_category
    paths = meshes.chosen(options.folder, options.only, category)
    with tempfile.TemporaryDirectory() as folder:
        found, verdicts = (repairs if options.repair else cages_and_nets)(options, paths, Path(folder))
    for verdict, holds in verdicts.items():
        print(f"{'holds' if holds else 'MISSED'}: {verdict}")
    if options.record:
        print(f"recorded in {history.record('applications', {'mode': 'repair' if options.repair else 'cages and nets', 'meshes': found})}")
    return 0 if all(verdicts.values()) else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
