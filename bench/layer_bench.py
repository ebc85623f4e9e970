#!/usr/bin/python3
"""Measures the differentiable rendering layer: its two forms against plain tensors with autograd, in time, and the map form
against the exact one, in images and gradients, by kind of material. See bench/README.md."""

import argparse
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import mean, table  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
LIGHTS = ["studio", "city", "sky", "lobby", "night"]
CLASSES = {
    "matte": ["white-fabric", "pink-felt", "red-fabric"],
    "glossy": ["yellow-plastic", "blue-metallic-paint", "special-walnut-224"],
    "metal": ["nickel", "chrome", "aluminium"],
}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("--mesh", type=Path, default=ROOT / "data" / "models" / "horse.ply")
    add("--lights", nargs="+", default=LIGHTS)
    add("--size", type=int, default=128, help="pixels along a side")
    add("--height", type=int, default=64, help="rows of the light")
    add("--map-sizes", type=int, nargs="+", default=[32, 64])
    add("--chunks", type=int, nargs="+", default=[16, 64], help="pixels that plain tensors take at a time")
    add("--threads", type=int, default=1, help="of the layer and of plain tensors; seconds are CPU seconds")
    add("--program", type=Path, default=BIN / "layer_compare")
    add("--times-only", action="store_true", help="leave out the errors")
    add("--record", action="store_true", help="append the result to bench/history/layer.jsonl")
    options = parser.parse_args(words)
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def measure(options, lights, materials, *more):
    done = expect([options.program, options.mesh, "--lights", *lights, "--materials", *materials, "--size", options.size,
                   "--height", options.height, "--map-sizes", *options.map_sizes, "--threads", options.threads, *more], 3600)
    return json.loads(done.output)


def times(options):
    """Seconds of each form by kind of material: the first of the kind, under the first light."""
    return {name: measure(options, options.lights[:1], some[:1], "--plain", "--chunks", *options.chunks)
            for name, some in CLASSES.items()}


def errors(options):
    """Means over lights and a kind's materials, by map size."""
    result = {}
    for name, some in CLASSES.items():
        found = measure(options, options.lights, some, "--repeat", 1)["errors"]
        result[name] = {str(size): {key: mean([each["maps"][str(size)][key] for each in found])
                                    for key in ("image", "of_normals", "of_material", "of_light")}
                        for size in options.map_sizes}
    return result


def print_times(results):
    rows = []
    for name, result in results.items():
        seconds = result["seconds"]
        for form in [key for key in seconds if key not in ("plain chunks", "gradient_difference")]:
            entry = seconds[form]
            rows.append([name, form, *(f"{1000 * entry[key]:.1f}" for key in ("forward", "backward", "both")),
                         f"{seconds['plain']['both'] / entry['both']:.1f}"])
    print(table(["material", "form", "forward ms", "backward ms", "both ms", "plain / form"], rows))


def main(words):
    options = parse(words)
    results = times(options)
    first = next(iter(results.values()))
    print(f"{options.mesh.stem}: {first['pixels']} pixels of {options.size} x {options.size}, light {2 * options.height} x "
          f"{options.height}; gradients to normals, material and light; CPU time")
    print_times(results)
    best_map = f"map {max(options.map_sizes)}"
    ratios = {form: {name: result["seconds"]["plain"]["both"] / result["seconds"][form]["both"] for name, result in results.items()}
              for form in ("exact", best_map)}
    for form, some in ratios.items():
        least = min(some.values())
        print(f"{form}: at least {least:.1f} times as fast as plain tensors; 10 times {'holds' if least >= 10 else 'fails'}, "
              f"20 times {'holds' if least >= 20 else 'fails'}")
    entry = {"mesh": options.mesh.stem, "size": options.size, "height": options.height, "threads": options.threads, "pixels": first["pixels"],
             "seconds": {name: result["seconds"] for name, result in results.items()}, "speed_up": ratios}
    if not options.times_only:
        entry["errors"] = errors(options)
        print(f"map form from exact form, means over {', '.join(options.lights)}")
        print(table(["material", "map", "image", "to normals", "to material", "to light"],
                    [[name, size, *(f"{100 * value:.2f} %" for value in found.values())]
                     for name, sizes in entry["errors"].items() for size, found in sizes.items()]))
    if options.record:
        print(f"recorded in {history.record('layer', entry)}")
    return 0 if all(min(some.values()) >= 10 for some in ratios.values()) else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
