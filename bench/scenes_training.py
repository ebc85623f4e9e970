#!/usr/bin/python3
"""Makes rooms of furniture and trains networks that read normals off pictures of them, by what a depth sensor would
measure: by these normals alone, and by what the picture would look like as well. See bench/README.md.

    scenes_training.py OUT [NETWORK...] [--furniture DIR] [--effort 1] [--processes 2]

Rooms of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture) go to OUT/rooms, each training to
OUT/NETWORK, its weights to OUT/NETWORK/best.pt. What is done is skipped; what was stopped goes on.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from editing_training import LIGHTS  # noqa: E402
from harness import furniture, training  # noqa: E402

UNSEEN_LIGHTS = ["lobby", "night", "sunrise", "venice"]
# Name to which furniture, how many pictures, materials, lights and seed.
ROOMS = {"training": ("training", 2400, "training", LIGHTS, 1), "validation": ("validation", 64, "training", LIGHTS, 2),
         "test": ("test", 200, "test", UNSEEN_LIGHTS, 3)}

STANDALONE = {"normal": 1, "pixel": 0}                                 # (4.1)
COMBINED = {"normal": 1, "pixel": 20, "material": 0.1, "light": 0.1}  # (4.2)
# Steps of 8 pictures, and what they minimise (docs/training.md).
LAST = {"steps": 1500, "rates": (3e-4, 2e-5)}
NETWORKS = {
    "start": {"steps": 2500, "rates": (1e-3, 3e-4), "terms": STANDALONE},
    "standalone": {"start": "start", "terms": STANDALONE} | LAST,
    "combined": {"start": "start", "terms": COMBINED} | LAST,
    "given": {"start": "start", "terms": {"normal": 1, "pixel": 20}, "given": True} | LAST,
}


def make_rooms(options):
    folder = options.out / "rooms"
    folder.mkdir(parents=True, exist_ok=True)
    for name, (which, count, materials, lights, seed) in ROOMS.items():
        config = {"shapes": furniture.shapes(options, furniture.indoor_shapes(options)[which]), "materials": materials, "lights": lights,
                  "images": count, "map_size": 32, "seed": seed}
        (folder / f"{name}.json").write_text(json.dumps(config, indent=2))
        training.run(options.program, "rooms", folder / f"{name}.json", "-o", folder / name)


def configuration(options, which):
    return {"network": "scenes", "frames": "rooms/training", "validation_frames": "rooms/validation", "given": which.get("given", False),
            "batch": options.batch, "checkpoint_every": 100, "validate_every": 250, "seed": options.seed,
            "stages": [training.stage(options, which)]}


def main(words):
    options = training.parse(__doc__, NETWORKS, furniture.FOLDER, words, batch=8)
    make_rooms(options)
    training.train_all(options, NETWORKS, configuration)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
