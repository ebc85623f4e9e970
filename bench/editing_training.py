#!/usr/bin/python3
"""Trains the networks of editing and their peers: the weights that ship, and those that the tables compare. See
bench/README.md.

    editing_training.py OUT [NETWORK...] [--furniture DIR] [--effort 1] [--start F.pt]

Views of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture) go to OUT/views, each training to
OUT/NETWORK, its weights to OUT/NETWORK/best.pt. What is done is skipped; what was stopped goes on.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness.process import BIN  # noqa: E402

ARCHIVES = {"zero": "BlendSwap-CC-0.sh3f", "by": "BlendSwap-CC-BY.sh3f", "kator": "KatorLegaz.sh3f", "scopia": "Scopia.sh3f",
            "people": "Reallusion.sh3f"}
# Kept for tests: cars, chairs, sofas, monitors, four each.
TEST = {"kator": ["VW-new-beetle", "office-chair", "mid-century-sofa", "apple-imac-1998"],
        "scopia": ["seat_leon", "peugeot-308", "van", "tubular_chair", "leather_sofa", "wall-flat-tv"],
        "zero": ["oakChair", "thonet", "couch", "sofa2", "led_tv"]}
VALIDATION = {"scopia": ["smart-car", "truck", "office_chair", "simple_sofa"], "zero": ["couch2", "winchesterSofa"], "by": ["couch3", "dafTruck"]}
ALSO_UNSEEN = {"by": ["sofa2"]}  # is called as one of the test shapes is

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
    "standalone": {"network": "editing", "start": "individual", "given": ["normals", "light"], "steps": 3000, "rates": (1e-3, 5e-5),
                   "terms": {"material": 1, "pixel": 0}},
    "combined": {"network": "editing", "start": "individual", "given": ["normals", "light"], "steps": 3000, "rates": (1e-3, 5e-5),
                 "terms": {"material": 0.3, "pixel": 3}},
    "encoder_decoder": {"network": "encoder_decoder", "steps": 6000, "rates": (1e-3, 2e-5), "terms": {"material": 1, "pixel": 10, "perceptual": 0.5}},
    "photos": {"network": "editing", "start": "joint", "materials": "all", "lights": "all", "steps": 2000, "rates": (1e-4, 1e-5), "terms": RENDERED},
}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("out", type=Path, help="the folder")
    add("networks", nargs="*", metavar="NETWORK", help=", ".join(NETWORKS) + "; left out: all")
    add("--furniture", type=Path, default=Path("/usr/share/sweethome3d/furniture"), help="folder of .sh3f archives")
    add("--effort", type=float, default=1, help="times as many steps as written here")
    add("--start", type=Path, help="weights that each starts from, instead of those of another one of OUT or random ones")
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


def run(*command):
    print(*command, flush=True)
    subprocess.run([str(word) for word in command], check=True)


def train_together(processes, *command):
    """Processes of one thread share each batch: two of them learn twice as fast as one of two threads."""
    print(*command, flush=True)
    words = [str(word) for word in command]
    where = os.environ | {"WORLD_SIZE": str(processes), "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": "29571", "OMP_NUM_THREADS": "1",
                          "OPENBLAS_NUM_THREADS": "1"}
    started = [subprocess.Popen(words, env=where | {"RANK": str(rank)}) for rank in range(processes)]
    if any([process.wait() for process in started]):
        sys.exit(f"{words[0]} failed")


def shapes(options, chosen):
    """`chosen`: what of each archive; the name of an archive to {"ids": ...} or {"except": ...}."""
    return [{"archive": str(options.furniture.resolve() / ARCHIVES[name])} | which for name, which in chosen.items()]


def kept_back(name):
    return [each for shapes_of in (TEST, VALIDATION, ALSO_UNSEEN) for each in shapes_of.get(name, [])]


def chosen_shapes():
    only = {which: {name: {"ids": ids} for name, ids in shapes_of.items()} for which, shapes_of in (("validation", VALIDATION), ("test", TEST))}
    return {"training": {name: {"except": kept_back(name)} if kept_back(name) else {} for name in ARCHIVES},
            "cars": {name: {"categories": ["Vehicles"], "except": kept_back(name)} for name in ("zero", "by", "kator", "scopia")}} | only


def make_views(options, sets):
    """`sets`: name to which of the chosen shapes, how many views, and what their parts are."""
    for name, (which, count, parts) in sets.items():
        config = {"shapes": shapes(options, chosen_shapes()[which]), "parts": parts, "materials": "training", "lights": ["studio"],
                  "light_size": [16, 8], "map_size": 16, "samples": 4, "format": "png", "views": 1,
                  "images": count, "images_per_shard": 500}
        folder = options.out / "views"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.json").write_text(json.dumps(config, indent=2))
        run(options.program, "dataset", folder / f"{name}.json", "-o", folder / name)


def steps_of(options, which):
    return max(1, round(options.effort * which["steps"]))


def configuration(options, name):
    which = NETWORKS[name]
    first, last = which["rates"]
    config = {"network": which["network"], "views": ["views/training", "views/cars"], "validation_views": ["views/validation"],
              "materials": which.get("materials", "training"), "lights": which.get("lights", LIGHTS), "batch": options.batch,
              "map_size": 48, "checkpoint_every": 100, "validate_every": 250, "seed": options.seed,
              "stages": [{"steps": steps_of(options, which), "learning_rate": first, "final_learning_rate": last, "beta1": 0.9} | which["terms"]]}
    if "given" in which:
        config["given"] = which["given"]
    if options.start:
        config["start"] = str(options.start.resolve())
    elif "start" in which:
        config["start"] = f"{which['start']}/best.pt"
    return config


def train(options, name):
    needed = NETWORKS[name].get("start")
    if needed and not options.start and not (options.out / needed / "best.pt").exists():
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
