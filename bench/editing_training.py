#!/usr/bin/python3
"""Trains the networks of editing and their peers: the weights that ship, and those that the tables compare. See
bench/README.md.

    editing_training.py OUT [NETWORK...] [--furniture DIR] [--effort 1] [--start F.pt]

Views of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture) go to OUT/views, each training to
OUT/NETWORK, its weights to OUT/NETWORK/best.pt. What is done is skipped; what was stopped goes on.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import furniture, training  # noqa: E402

# Of which shapes, how many, and their parts.
VIEWS = {"training": ("training", 6000, "whole"), "cars": ("cars", 2000, "whole"), "validation": ("validation", 200, "whole"),
         "test": ("test", 600, "whole"), "test_parts": ("test", 600, "components")}

# Training meets neither the twenty test materials nor these: lobby, night, sunrise, venice.
LIGHTS = ["studio", "city", "park", "sky", "hall", "dawn", "esplanade", "forest", "warehouse", "apartment"]

LAYERS = {"normal": 1, "material": 1, "light": 0.1, "pixel": 0}
RENDERED = {"normal": 1, "material": 0.3, "light": 0.1, "pixel": 3, "perceptual": 0.5}
# Steps of 16 pictures, and what they minimise (docs/training.md); "start": of which network's weights.
NETWORKS = {
    "individual": {"network": "editing", "steps": 6000, "rates": (1e-3, 3e-4), "terms": LAYERS},
    "shaded": {"network": "editing", "start": "individual", "given": ["normals"], "steps": 4000, "rates": (1e-3, 3e-4),
               "terms": {"material": 0.3, "light": 0.1, "pixel": 3}},
    "joint": {"network": "editing", "start": "shaded", "steps": 6000, "rates": (5e-4, 2e-5), "terms": RENDERED},
    "separate": {"network": "editing", "start": "individual", "steps": 9000, "rates": (3e-4, 2e-5), "terms": LAYERS},
    "standalone": {"network": "editing", "given": ["normals", "light"], "steps": 3000, "rates": (1e-3, 5e-5),
                   "terms": {"material": 1, "pixel": 0}},
    "combined": {"network": "editing", "given": ["normals", "light"], "steps": 3000, "rates": (1e-3, 5e-5),
                 "terms": {"material": 0.05, "pixel": 3}},
    "encoder_decoder": {"network": "encoder_decoder", "steps": 6000, "rates": (1e-3, 2e-5), "terms": {"material": 1, "pixel": 10, "perceptual": 0.5}},
    "photos": {"network": "editing", "start": "joint", "materials": "all", "lights": "all", "steps": 2000, "rates": (1e-4, 1e-5), "terms": RENDERED},
}


def configuration(options, which):
    config = {"network": which["network"], "views": ["views/training", "views/cars"], "validation_views": ["views/validation"],
              "materials": which.get("materials", "training"), "lights": which.get("lights", LIGHTS), "batch": options.batch,
              "map_size": 48, "checkpoint_every": 100, "validate_every": 250, "seed": options.seed,
              "stages": [training.stage(options, which) | {"beta1": 0.9}]}
    return config | ({"given": which["given"]} if "given" in which else {})


def main(words):
    options = training.parse(__doc__, NETWORKS, furniture.FOLDER, words)
    furniture.make_views(options, VIEWS)
    training.train_all(options, NETWORKS, configuration)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
