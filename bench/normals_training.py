#!/usr/bin/python3
"""Trains the networks that read normals off a picture, of both architectures, by the true normals alone and by what the
picture would look like as well. See bench/README.md.

    normals_training.py OUT [NETWORK...] [--furniture DIR] [--effort 1] [--processes 2]

Views of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture), with its parts, go to OUT/views, each
training to OUT/NETWORK, its weights to OUT/NETWORK/best.pt. What is done is skipped; what was stopped goes on.
"""

import argparse
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from editing_training import LIGHTS, make_views, train_together  # noqa: E402
from harness.process import BIN  # noqa: E402

SHIPPED = Path(__file__).resolve().parents[1] / "models" / "networks" / "editing.pt"
VIEWS = {"training_parts": ("training", 6000, "components"), "cars_parts": ("cars", 2000, "components"),
         "validation_parts": ("validation", 200, "components"), "test": ("test", 600, "whole"), "test_parts": ("test", 600, "components")}

STANDALONE = {"normal": 1, "pixel": 0}  # (4.1)
COMBINED = {"normal": 1, "pixel": 20}   # (4.2)
# Steps of 16 pictures, and what they minimise (docs/training.md). Those that are compared start from the same weights
# and have as many steps: of "start", a network of this list or a file.
LAST = {"steps": 3000, "rates": (3e-4, 2e-5)}
NETWORKS = {
    "u_start": {"architecture": "u", "steps": 5000, "rates": (1e-3, 3e-4), "terms": STANDALONE},
    "u_standalone": {"architecture": "u", "start": "u_start", "terms": STANDALONE} | LAST,
    "u_combined": {"architecture": "u", "start": "u_start", "terms": COMBINED} | LAST,
    "multi_branch_standalone": {"architecture": "multi_branch", "start": SHIPPED, "terms": STANDALONE} | LAST,
    "multi_branch_combined": {"architecture": "multi_branch", "start": SHIPPED, "terms": COMBINED} | LAST,
}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("out", type=Path, help="the folder")
    add("networks", nargs="*", metavar="NETWORK", help=", ".join(NETWORKS) + "; left out: all")
    add("--furniture", type=Path, default=Path("/usr/share/sweethome3d/furniture"), help="folder of .sh3f archives")
    add("--effort", type=float, default=1, help="times as many steps as written here")
    add("--batch", type=int, default=16, help="pictures a step")
    add("--processes", type=int, default=os.cpu_count(), help="that share each batch, a thread each; a divisor of it")
    add("--seed", type=int, default=0)
    add("--program", type=Path, default=BIN / "partwise")
    options = parser.parse_args(words)
    if unknown := set(options.networks) - set(NETWORKS):
        parser.error(f"{unknown.pop()} is none of {', '.join(NETWORKS)}")
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def configuration(options, name):
    which = NETWORKS[name]
    first, last = which["rates"]
    config = {"network": "normals", "architecture": which["architecture"], "views": ["views/training_parts", "views/cars_parts"],
              "validation_views": ["views/validation_parts"], "parts": 0.5, "materials": "training", "lights": LIGHTS, "batch": options.batch,
              "group": 8, "map_size": 32, "checkpoint_every": 100, "validate_every": 250, "seed": options.seed,
              "stages": [{"steps": max(1, round(options.effort * which["steps"])), "learning_rate": first, "final_learning_rate": last}
                         | which["terms"]]}
    start = which.get("start")
    if start:
        config["start"] = str(start) if isinstance(start, Path) else f"{start}/best.pt"
    return config


def train(options, name):
    needed = NETWORKS[name].get("start")
    if isinstance(needed, str) and not (options.out / needed / "best.pt").exists():
        train(options, needed)
    config = options.out / f"{name}.json"
    config.write_text(json.dumps(configuration(options, name), indent=2))
    train_together(options.processes, options.program, "train", config, "-o", options.out / name, "--resume", "--threads", 1)


def main(words):
    options = parse(words)
    make_views(options, VIEWS)
    for name in options.networks or NETWORKS:
        train(options, name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
