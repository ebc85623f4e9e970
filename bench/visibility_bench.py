#!/usr/bin/python3
"""Measures `partwise feature` and `partwise medial` on a folder of meshes: methods beside each other, times and how they grow,
noise and pose, points of the medial axis. See bench/README.md."""

import argparse
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import histograms, history, medial, meshes, visibility  # noqa: E402
from harness.process import BIN  # noqa: E402


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("folder", type=Path, help="meshes, in it or below")
    add("--program", type=Path, default=BIN / "partwise", help="the program to measure")
    add("--tools", type=Path, default=BIN, help="folder of visibility_compare, mesh_variant and medial_check")
    add("--threads", type=int, default=2, help="of the program")
    add("--jobs", type=int, default=1, help="meshes at a time")
    add("--time-limit", type=float, default=600, help="wall seconds a run")
    add("--category-of", choices=["psb", "folder"], default="folder", help="Princeton's numbers, or the folder a mesh is in")
    add("--only", help="first-of-category, or names without ending, separated by commas")
    add("--spread", type=int, metavar="N", help="about N meshes spread over categories and sizes [all]")
    add("--record", action="store_true", help="append the result to bench/history/visibility.jsonl")
    mode = parser.add_argument_group("what is measured, one of these").add_mutually_exclusive_group(required=True)
    add = mode.add_argument
    add("--methods", action="store_true", help="whether filter finds what bfs finds, and by how many tests")
    add("--times", action="store_true", help="seconds and memory")
    add("--growth", type=int, nargs="+", metavar="N", help="seconds on subdivided copies of about N vertices")
    add("--histograms", action="store_true", help="distances under noise, in other poses, between shapes")
    add("--medial", action="store_true", help="points of the medial axis against the judge's")
    add = parser.add_argument
    add("--amplitudes", type=float, nargs="*", default=histograms.AMPLITUDES, help="of --histograms, shares of R")
    add("--kinds", nargs="+", choices=histograms.KINDS, default=histograms.KINDS, help="of --histograms")
    add("--smooth", type=int, default=0, help="of --histograms, rounds of smoothing before values are taken")
    add("--samples", type=int, default=200000, help="of --medial, that the judge draws")
    options = parser.parse_args(words)
    for program in (options.program, *(options.tools / name for name in ("visibility_compare", "mesh_variant", "medial_check"))):
        if not os.access(program, os.X_OK):
            parser.error(f"{program} is not there: build it, or name another")
    return options


def measured(options, settings, paths, category, jobs):
    """What was measured, in a word for the history, and the figures."""
    if options.methods:
        return "methods", visibility.methods(settings, paths, category, jobs)
    if options.times:
        return "times", visibility.times(settings, paths, category, jobs)
    if options.growth:
        return "growth", visibility.growth(settings, paths, options.growth, category, jobs)
    if options.histograms:
        return "histograms", histograms.noise_and_pose(settings, paths, category, tuple(options.amplitudes), options.smooth, options.kinds, jobs)
    return "medial", medial.medial(settings, paths, category, options.samples, jobs)


def main(words):
    options = parse(words)
    category = meshes.princeton_category if options.category_of == "psb" else meshes.folder_category
    paths = meshes.chosen(options.folder, options.only, category)
    if options.spread:
        paths = meshes.spread(paths, options.spread, category)
    if not paths:
        sys.exit(f"visibility_bench: no meshes chosen in {options.folder}")
    settings = visibility.Settings(options.program, options.tools, options.threads, options.time_limit)
    with ThreadPoolExecutor(options.jobs) as pool:
        mode, figures = measured(options, settings, paths, category, pool.map)
    if options.record:
        print(f"recorded in {history.record('visibility', {'mode': mode, 'meshes': len(paths)} | figures)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
