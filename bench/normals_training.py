#!/usr/bin/python3
"""Trains the networks that read normals off a picture, of both architectures, by the true normals alone and by what the
picture would look like as well. See bench/README.md.

    normals_training.py OUT [NETWORK...] [--furniture DIR] [--effort 1] [--processes 2]

Views of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture), with its parts, go to OUT/views, each
training to OUT/NETWORK, its weights to OUT/NETWORK/best.pt. What is done is skipped; what was stopped goes on.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from editing_training import LIGHTS  # noqa: E402
from harness import furniture, training  # noqa: E402

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
    "u_combined": {"architecture": "u", "start": "u_start", "terms": COMBINED} | LAST,  # this one ships as objects.pt
    "multi_branch_standalone": {"architecture": "multi_branch", "start": SHIPPED, "terms": STANDALONE} | LAST,
    "multi_branch_combined": {"architecture": "multi_branch", "start": SHIPPED, "terms": COMBINED} | LAST,
    "multi_branch_quarter": {"architecture": "multi_branch", "start": SHIPPED, "terms": {"normal": 1, "pixel": 5}} | LAST,
}


def configuration(options, which):
    return {"network": "normals", "architecture": which["architecture"], "views": ["views/training_parts", "views/cars_parts"],
            "validation_views": ["views/validation_parts"], "parts": 0.5, "materials": "training", "lights": LIGHTS, "batch": options.batch,
            "group": 8, "map_size": 32, "checkpoint_every": 100, "validate_every": 250, "seed": options.seed,
            "stages": [training.stage(options, which)]}


def main(words):
    options = training.parse(__doc__, NETWORKS, furniture.FOLDER, words)
    furniture.make_views(options, VIEWS)
    training.train_all(options, NETWORKS, configuration)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
