#!/usr/bin/python3
"""Measures `partwise dataset`: images a second, CPU time an image and the largest memory, for a number of images and for four
times as many, by size of light and by views of a combination. See bench/README.md."""

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import table  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
TARGETS = {"128x64, 1 views": 6, "32x16, 1 views": 40}  # images a second on two cores, each with its own light and materials


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("--config", type=Path, default=ROOT / "examples" / "dataset.json", help="what is changed and made")
    add("--images", type=int, default=100, help="of the first run; the second makes four times as many")
    add("--lights", nargs="+", default=["128x64", "32x16"], metavar="WxH", help="sizes of the light")
    add("--views", nargs="+", type=int, default=[1, 5], help="of a combination of shape, materials and light")
    add("--threads", type=int, default=2, help="of the program")
    add("--program", type=Path, default=BIN / "partwise")
    add("--record", action="store_true", help="append the result to bench/history/dataset.jsonl")
    options = parser.parse_args(words)
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def configuration(options, light, views, images):
    """Files are named from the configuration's folder: absolute, it can be written elsewhere."""
    config = json.loads(options.config.read_text())
    config["shapes"] = [str((options.config.parent / shape).resolve()) for shape in config["shapes"]]
    return config | {"light_size": [int(side) for side in light.split("x")], "views": views, "images": images,
                     "images_per_shard": max(images // 4, 1)}


def measure(options, light, views, images):
    with tempfile.TemporaryDirectory(prefix="dataset-bench-") as folder:
        config, out = Path(folder) / "dataset.json", Path(folder) / "out"
        config.write_text(json.dumps(configuration(options, light, views, images)))
        done = expect([options.program, "dataset", config, "-o", out, "--threads", options.threads, "--json", "-"], 3600)
        bytes_written = sum(path.stat().st_size for path in out.glob("*.tar"))
    made = json.loads(done.output)["images"]
    return {"images": made, "images_per_second": made / done.wall_seconds, "cpu_ms": 1000 * done.cpu_seconds / made,
            "memory_mb": done.memory_mb, "kb_an_image": bytes_written / made / 1000}


def main(words):
    options = parse(words)
    results = {f"{light}, {views} views": [measure(options, light, views, images)
                                           for images in (options.images, 4 * options.images)]
               for light in options.lights for views in options.views}
    print(table(["light", "images", "a second", "CPU ms an image", "MB at most", "kB an image"],
                [[name, str(run["images"]), f"{run['images_per_second']:.1f}", f"{run['cpu_ms']:.1f}",
                  f"{run['memory_mb']:.0f}", f"{run['kb_an_image']:.0f}"] for name, runs in results.items() for run in runs]))
    print(f"whole program, {options.threads} threads; every image has all its entries")
    holds = True
    for name, least in TARGETS.items():
        if name in results:
            rate = min(run["images_per_second"] for run in results[name])
            holds = holds and rate >= least
            print(f"{'holds' if rate >= least else 'MISSED'}: {name}: at least {least} images a second: {rate:.1f}")
    if options.record:
        settings = {"config": options.config.name, "threads": options.threads}
        print(f"recorded in {history.record('dataset', settings | {'runs': results})}")
    return 0 if holds else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
