#!/usr/bin/python3
"""How well networks that were trained on noisy normals read exact ones off rooms that they have not seen, and how good
those are that they were trained on. See bench/README.md.

    scenes_bench.py NETS [--count 200] [--record]

NETS is a folder of scenes_training.py; of its networks, those that are there are judged.
"""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import cell, table  # noqa: E402
from scenes_training import NETWORKS  # noqa: E402

REGIONS = ("edges", "curved", "smooth", "right", "wrong", "missing")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("nets", type=Path, help="a folder of scenes_training.py")
    add("--count", type=int, default=200, help="rooms")
    add("--tool", type=Path, default=BIN / "scenes_errors")
    add("--record", action="store_true", help="append the result to bench/history/scenes.jsonl")
    return parser.parse_args(words)


def measured(options):
    """Name to figures; the sensor first. All look at the same rooms."""
    names = [name for name in NETWORKS if (options.nets / name / "best.pt").exists()]
    weights = [word for name in names for word in ("--weights", options.nets / name / "best.pt")]
    done = expect([options.tool, options.nets / "rooms" / "test", *weights, "--count", options.count], 36000)
    return {name: json.loads(line) | {"weights": name} for name, line in zip(["sensor", *names], done.output.splitlines(), strict=True)}


def row(name, figures):
    every = figures["all"]
    return [name, *(cell(every[key], ".2f") for key in ("mean", "median", "rmse")), *(cell(share, ".3f") for share in every["below"]),
            cell(every["cosine"], ".4f"), *(cell(figures[key]["mean"], ".2f") for key in REGIONS), cell(figures["l2"], ".1f"),
            cell(figures["ssim"], ".4f")]


def main(words):
    options = parse(words)
    found = measured(options)
    print(table(["", "mean", "median", "rmse", "< 5", "< 7.5", "< 11.25", "< 22.5", "< 30", "cosine", *REGIONS, "L2", "SSIM"],
                [row(*each) for each in found.items()]))
    sensor = found["sensor"]
    shares = {key: sensor[key]["pixels"] / sensor["all"]["pixels"] for key in REGIONS}
    print(f"\n{options.count} rooms; angles in degrees, against exact normals, pixels pooled; one that is missing counts as 90. Mean angles by region; "
          "shares of the pixels: " + ", ".join(f"{key} {share:.1%}" for key, share in shares.items()))
    if options.record:
        print(f"recorded in {history.record('scenes', {'count': options.count, 'found': found})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
