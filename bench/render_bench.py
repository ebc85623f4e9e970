#!/usr/bin/python3
"""Measures the reflectance-map path of the renderer against the exact sum: errors, and both against a finer light; times. See
bench/README.md."""

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
MATERIALS = ["white-fabric", "pink-felt", "yellow-plastic", "blue-metallic-paint", "special-walnut-224", "nickel", "chrome"]


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("--mesh", type=Path, default=ROOT / "data" / "models" / "horse.ply")
    add("--lights", nargs="+", default=LIGHTS)
    add("--materials", nargs="+", default=MATERIALS)
    add("--size", type=int, default=128, help="pixels along a side")
    add("--height", type=int, default=64, help="rows of the light")
    add("--map-size", type=int, default=64)
    add("--reference", type=int, default=512, help="rows of the finer light")
    add("--program", type=Path, default=BIN / "render_error")
    add("--record", action="store_true", help="append the result to bench/history/render.jsonl")
    options = parser.parse_args(words)
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def measure(options):
    """A light at a time: a fine reference takes minutes for each."""
    results = []
    for light in options.lights:
        done = expect([options.program, options.mesh, "--lights", light, "--materials", *options.materials, "--size",
                       options.size, "--height", options.height, "--map-size", options.map_size, "--reference", options.reference],
                      7200)
        results += [json.loads(line) for line in done.output.splitlines()]
        print(f"{light}: done", file=sys.stderr, flush=True)
    return results


def by_material(results):
    """A row a material, means over the lights."""
    rows = {}
    for result in results:
        rows.setdefault(result["material"], []).append(result)
    keys = ("map", "map_reference", "exact_reference", "exact_seconds", "map_seconds", "exact_ns_a_pair", "map_ns_a_pair")
    return {name: {key: mean([each[key] for each in some]) for key in keys} for name, some in rows.items()}


def main(words):
    options = parse(words)
    results = measure(options)
    rows = by_material(results)
    first = results[0]
    print(f"{options.mesh.stem}: {first['pixels']:.0f} pixels; map of {first['normals']} normals; light {2 * options.height} x "
          f"{options.height}, reference {2 * options.reference} x {options.reference}; means over {', '.join(options.lights)}")
    header = ["material", "map to exact", "map to ref.", "exact to ref.", "exact s", "map s", "speed-up", "exact ns", "map ns"]
    print(table(header, [[name, *(f"{100 * row[key]:.2f} %" for key in ("map", "map_reference", "exact_reference")),
                          f"{row['exact_seconds']:.3f}", f"{row['map_seconds']:.3f}",
                          f"{row['exact_seconds'] / row['map_seconds']:.1f}", f"{row['exact_ns_a_pair']:.2f}",
                          f"{row['map_ns_a_pair']:.2f}"] for name, row in rows.items()]))
    if options.record:
        settings = {key: getattr(options, key) for key in ("lights", "size", "height", "map_size", "reference")}
        entry = {"mesh": options.mesh.stem, **settings, "pixels": first["pixels"], "normals": first["normals"], "materials": rows}
        print(f"recorded in {history.record('render', entry)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
