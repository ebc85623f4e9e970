#!/usr/bin/python3
"""Measures `partwise decompose` on a folder of meshes: a table by category, the targets that hold, and experiments beyond
the table. See bench/README.md."""

import argparse
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import experiments, history, meshes, ridge_noise, summary  # noqa: E402
from harness.decompose import Settings, decompose  # noqa: E402
from harness.people import People  # noqa: E402
from harness.process import BIN  # noqa: E402


def share(word):
    """A number from 0 to 1, as an argument."""
    if not 0 <= float(word) <= 1:
        raise argparse.ArgumentTypeError(f"{word} is not from 0 to 1")
    return float(word)


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    add = parser.add_argument
    add("folder", type=Path, help="meshes, in it or below")
    add("--program", type=Path, default=BIN / "partwise", help="the program to measure")
    add("--checker", type=Path, default=BIN / "decompose_check", help="the judge")
    add("--hacd-program", type=Path, default=BIN / "hacd_peer", help="the peer")
    add("--noise-program", type=Path, default=BIN / "ridge_noise", help="that --ridge-noise asks")
    add("--evaluator", type=Path, default=BIN / "partwise", help="whose verb evaluate gives the Rand error")
    add("--measure", choices=["hull", "valley"], default="hull")
    add("--tolerance", type=float, default=0.1, help="share of the bounding-sphere radius")
    add("--max-hull-vertices", type=int, default=0, help="0: no limit")
    add("--cup-repair", action="store_true", help="of valley")
    add("--threads", type=int, default=1, help="of the program")
    add("--jobs", type=int, default=1, help="meshes at a time")
    add("--time-limit", type=float, default=120, help="wall seconds a run")
    add("--check", action="store_true", help="judge every result by its files")
    add("--samples", type=int, default=20000, help="points the judge draws a mesh, at least")
    add("--category-of", choices=["psb", "folder"], default="folder", help="Princeton's numbers, or the folder a mesh is in")
    add("--only", help="first-of-category, or names without ending, separated by commas")
    add("--seg-dir", type=Path, help="segmentations by people, NAME/NAME_k.seg: adds the Rand error")
    add("--record", action="store_true", help="append the result to bench/history/decompose.jsonl")
    add("--list", action="store_true", help="a line a mesh as well")
    mode = parser.add_argument_group("experiments, each instead of the table")
    add = mode.add_argument
    add("--rotations", type=int, metavar="N", help="parts under N random rotations")
    add("--determinism", action="store_true", help="bytes for 1 and 2 threads and a second run")
    add("--remove", type=share, nargs="+", metavar="SHARE", help="without a share of the faces")
    add("--fig-2-35", action="store_true", help="Rand error by tolerance (needs --seg-dir)")
    add("--tolerances", type=float, nargs="+", default=[0.04, 0.05, 0.06, 0.07, 0.08, 0.12, 0.15, 0.2],
        help="that --fig-2-35 chooses from, with 0.09 and 0.1")
    add("--ridge-noise", type=int, metavar="N", help="convex ridges that stay put in N noisy copies")
    add("--along-normals", action="store_true", help="the vertices of those copies, else in a ball")
    add("--hacd", type=int, metavar="N", help="after the table: Bullet's HACD on N of the meshes")
    add("--hacd-faces", type=int, default=2000, help="that HACD's input is simplified to")
    options = parser.parse_args(words)
    if options.fig_2_35 and not options.seg_dir:
        parser.error("--fig-2-35 needs --seg-dir")
    needed = [options.noise_program if options.ridge_noise else options.program]
    if options.check or options.remove or options.hacd:
        needed.append(options.checker)
    if options.hacd:
        needed.append(options.hacd_program)
    if options.seg_dir:
        needed.append(options.evaluator)
    for program in needed:
        if not os.access(program, os.X_OK):
            parser.error(f"{program} is not there: build it, or name another")
    return options


def run_table(options, settings, paths, category, people, jobs):
    results = []
    for result in jobs(lambda path: decompose(settings, path, people), paths):
        results.append(result)
        if options.list:
            figures = f"{result.parts} parts, ratio {result.ratio}, {result.cpu_seconds:.2f} s" if result.parts else ""
            print(f"{result.mesh.stem}: {figures}{result.trouble}", flush=True)
        elif sys.stderr.isatty():
            print(f"\r{len(results)} of {len(paths)}", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty() and not options.list:
        print("\r", end="", file=sys.stderr)
    print(summary.by_category(results, category, dissertation=options.category_of == "psb"))
    for result in results:
        for trouble in [result.trouble] * bool(result.trouble) + result.failures:
            print(f"{result.mesh.stem}: {trouble}")
    total = summary.totals(results)
    if options.check:
        print(f"hulls stick out by {total['exposure_max']} R at most, by no more than {total['exposure_bound_max']} R"
              f" (strictly, with what lies in other hulls: {total['exposure_strict_max']} R);"
              f" within tolerance for certain: {total['certified']} of {total['meshes']}")
    reached = summary.targets(total, settings, options.category_of == "psb")
    print(summary.targets_line(reached))
    return {"totals": total, "targets": {text: state for text, state in reached}}


def main(words):
    options = parse(words)
    category = meshes.princeton_category if options.category_of == "psb" else meshes.folder_category
    paths = meshes.chosen(options.folder, options.only, category)
    if not paths:
        sys.exit(f"decompose_bench: no meshes chosen in {options.folder}")
    judged = options.check or options.remove or options.hacd
    settings = Settings(options.program, options.checker if judged else None, options.tolerance, options.measure,
                        options.max_hull_vertices, options.cup_repair, options.threads, options.time_limit, options.samples)
    people = People(options.seg_dir, options.evaluator) if options.seg_dir else None
    result = {"meshes": len(paths), "settings": settings.described()}
    with ThreadPoolExecutor(options.jobs) as pool:
        jobs = pool.map
        if options.rotations:
            result["rotations"] = experiments.rotations(settings, paths, options.rotations, jobs)
        elif options.determinism:
            result["determinism"] = experiments.determinism(settings, paths, jobs)
        elif options.remove:
            result["removal"] = experiments.removal(settings, paths, options.remove, jobs)
        elif options.fig_2_35:
            result["figure_2_35"] = experiments.figure_2_35(settings, paths, category, people, options.tolerances, jobs)
        elif options.ridge_noise:
            result["settings"] = {"tolerance": settings.tolerance, "threads": settings.threads}
            result["ridge_noise"] = ridge_noise.ridge_noise(settings, options.noise_program, options.ridge_noise,
                                                            options.along_normals, paths, category, jobs)
        else:
            result |= run_table(options, settings, paths, category, people, jobs)
            if options.hacd:
                sample = [paths[k * len(paths) // options.hacd] for k in range(min(options.hacd, len(paths)))]
                result["hacd"] = experiments.hacd(settings, options.hacd_program, options.hacd_faces, sample, jobs)
    if options.record:
        print(f"recorded in {history.record('decompose', result)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
