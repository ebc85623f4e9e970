#!/usr/bin/python3
"""The dissertation's Table 4.1 for trained networks, on views, materials and lights that they have not seen, with the
measures of the field beside it. See bench/README.md.

    normals_bench.py NETS [--count 500] [--record]

NETS is a folder of normals_training.py; of its networks, those that are there are judged, and the normals' network of
editing that ships beside them.
"""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import cell, table  # noqa: E402
from normals_training import NETWORKS, SHIPPED  # noqa: E402

PUBLISHED = {"standalone": (0.9105, 313.2058, 0.9441), "combined": (0.9050, 238.4619, 0.9625)}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("nets", type=Path, help="a folder of normals_training.py")
    add("--count", type=int, default=500, help="pictures of each kind")
    add("--map-size", type=int, default=64, help="of the reflectance maps that pictures are made with")
    add("--tool", type=Path, default=BIN / "normals_errors")
    add("--record", action="store_true", help="append the result to bench/history/normals.jsonl")
    return parser.parse_args(words)


def measured(options, names, parts):
    """Name to figures; all networks look at the same pictures."""
    files = [SHIPPED if name == "editing" else options.nets / name / "best.pt" for name in names]
    views = options.nets / "views" / ("test_parts" if parts else "test")
    done = expect([options.tool, views, "--weights", *files, "--count", options.count, "--map-size", options.map_size,
                   *(["--parts"] if parts else [])], 36000)
    return {name: json.loads(line) | {"weights": name} for name, line in zip(names, done.output.splitlines(), strict=True)}


def show(title, found):
    def gain(name):
        """How much less re-rendered error than by the true normals alone."""
        rival = found.get(name.replace("combined", "standalone"))
        return 1 - found[name]["l2"] / rival["l2"] if rival and name.endswith("_combined") else None

    def row(name, figures):
        every = figures["all"]
        return [name, *(cell(figures[key], form) for key, form in (("cosine", ".4f"), ("l2", ".1f"), ("ssim", ".4f"))), cell(gain(name), ".1%"),
                *(cell(figures[key], form) for key, form in (("l2_frame", ".1f"), ("ssim_frame", ".4f"))),
                *(cell(every[key], ".2f") for key in ("mean", "median", "rmse")), *(cell(share, ".3f") for share in every["below"]),
                *(cell(figures[key]["mean"], ".2f") for key in ("edges", "curved", "smooth"))]

    print(f"\n{title}")
    print(table(["", "cosine", "L2", "SSIM", "less L2", "L2 frame", "SSIM frame", "mean", "median", "rmse", "< 5", "< 7.5", "< 11.25", "< 22.5",
                 "< 30", "edges", "curved", "smooth"], [row(*each) for each in found.items()]))


def main(words):
    options = parse(words)
    names = ["editing", *(name for name in NETWORKS if (options.nets / name / "best.pt").exists())]
    tables = {"one material": measured(options, names, False), "a material for each part": measured(options, names, True)}
    for title, found in tables.items():
        show(title, found)
    print(f"\n{options.count} pictures; cosine, L2 and SSIM over the object, means over pictures, rendered with true material and light; "
          "angles in degrees, pixels pooled; edges, curved, smooth: mean angles there")
    for name, (cosine, error, ssim) in PUBLISHED.items():
        print(f"published, {name}: cosine {cosine}, L2 {error}, SSIM {ssim}")
    if options.record:
        print(f"recorded in {history.record('normals', {'count': options.count, 'tables': tables})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
