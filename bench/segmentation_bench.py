#!/usr/bin/python3
"""Measures segmentations of a folder of meshes against people's, by the measures of the Princeton benchmark: a table by
category. See bench/README.md."""

import argparse
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, meshes, segmentation  # noqa: E402
from harness.people import People  # noqa: E402
from harness.process import BIN  # noqa: E402


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("folder", type=Path, help="meshes, in it or below")
    add("seg_dir", type=Path, help="segmentations by people, NAME/NAME_k.seg")
    add("--program", type=Path, default=BIN / "partwise", help="the program that measures")
    add("--jobs", type=int, default=1, help="meshes at a time")
    add("--category-of", choices=["psb", "folder"], default="psb", help="Princeton's numbers, or the folder a mesh is in")
    add("--only", help="first-of-category, or names without ending, separated by commas")
    add("--record", action="store_true", help="append the result to bench/history/segmentation.jsonl")
    add("--list", action="store_true", help="a line a mesh as well")
    mode = parser.add_argument_group("what is judged, one of these").add_mutually_exclusive_group(required=True)
    add = mode.add_argument
    add("--people", action="store_true", help="the first of the people, by the others")
    add("--labels", type=Path, metavar="DIR", help="DIR/NAME.seg, by all people")
    options = parser.parse_args(words)
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def chosen_mode(options, people):
    """What is judged, as the history keeps it, and the function from a mesh to its measures."""
    if options.people:
        return {"mode": "people"}, people.first_against_others
    measures_of = lambda mesh: people.measures(mesh, options.labels / f"{mesh.stem}.seg")
    return {"mode": "labels", "labels": options.labels.name}, measures_of


def main(words):
    options = parse(words)
    category = meshes.princeton_category if options.category_of == "psb" else meshes.folder_category
    paths = meshes.chosen(options.folder, options.only, category)
    if not paths:
        sys.exit(f"segmentation_bench: no meshes chosen in {options.folder}")
    judged, measures_of = chosen_mode(options, People(options.seg_dir, options.program))
    results = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for result in pool.map(lambda path: segmentation.judged(path, measures_of), paths):
            results.append(result)
            if options.list and result.measures:
                print(result.mesh.stem, *(f"{key} {value:.4f}" for key, value in result.measures.items()
                                          if value is not None), flush=True)
    print(segmentation.by_category(results, category, dissertation=options.category_of == "psb"))
    for result in results:
        if result.trouble:
            print(result.trouble)
    if options.record:
        print(f"recorded in {history.record('segmentation', judged | segmentation.means(results))}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
