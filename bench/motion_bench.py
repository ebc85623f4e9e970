#!/usr/bin/python3
"""Medial axes by max-margin fields beside medial-axis PRM with rays and with exact distances, in the same run on the same scenes
(the dissertation's Table 5.1, and its Table 5.2 with --steps). See bench/README.md.

    motion_bench.py [SCENE...] [--steps] [--growth] [--record]
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, motion_scenes  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import cell, table  # noqa: E402

TOWN = Path(__file__).resolve().parents[1] / "data" / "city" / "kronstadt.geojson"
# Samples; total seconds of MAPRM and SVMA in Table 5.1; how many times as fast as with rays ours should be.
SCENES = {"city": (40000, (715.20, 542.32), 3), "extruded city": (40000, None, 3), "frame": (20000, (1337.06, 323.42), 10)}
METHODS = {"svma": ["--method", "svma"], "maprm": ["--method", "maprm"], "maprm-exact": ["--method", "maprm-exact"]}
STEPS = {f"svma, {step}": ["--method", "svma", "--step", step] for step in ("svm", "clearance", "combined")}
STAGES = ("parts", "train", "sample", "connect")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES) + "; left out: all")
    add("--samples", type=int, help="instead of those of the dissertation")
    add("--steps", action="store_true", help="the three lengths of steps instead of the three methods")
    add("--growth", action="store_true", help="footprints from 10 to all, samples from 1000 to 1 million")
    add("--threads", type=int, default=0, help="of the program; 0: all")
    add("--program", type=Path, default=BIN / "partwise")
    add("--record", action="store_true", help="append the result to bench/history/motion.jsonl")
    options = parser.parse_args(words)
    if unknown := set(options.scenes) - set(SCENES):
        parser.error(f"{unknown.pop()} is none of {', '.join(SCENES)}")
    return options


def roadmap(options, scene, samples, *words):
    threads = ["--threads", options.threads] if options.threads else []
    done = expect([options.program, "roadmap", *scene, "--samples", samples, "--quiet", "--json", "-", *threads, *words], 7200)
    return json.loads(done.output)


def files(folder):
    motion_scenes.town(TOWN, 354, folder / "town.obj")
    motion_scenes.frame(folder / "frame.obj")
    return {"city": [TOWN, "--limit", 354], "extruded city": [folder / "town.obj"], "frame": [folder / "frame.obj"]}


def total(report):
    return sum(report["seconds"].get(stage, 0) for stage in STAGES)


def row(name, report):
    shares = [report["within_ten_steps"] / report["drawn"], report["lost"] / report["drawn"], report["on_axis"]]
    return [name, str(report["obstacles"]), *(cell(report["seconds"].get(stage), ".2f") for stage in STAGES), f"{total(report):.2f}",
            *(f"{100 * share:.1f}" for share in shares), str(report["edges"]), str(report["components"]),
            f"{report['distance_queries'] / report['samples']:.1f}", f"{report['collision_checks'] / report['samples']:.1f}"]


HEADER = ["", "obstacles", *STAGES, "total s", "in 10 steps %", "lost %", "on axis %", "edges", "components", "distances a sample", "checks"]


def compare(options, scenes):
    found, rows, verdicts = {}, [], []
    for name in options.scenes or SCENES:
        samples, published, wanted = SCENES[name]
        reports = found[name] = {}
        for method, words in (STEPS if options.steps else METHODS).items():
            reports[method] = roadmap(options, scenes[name], options.samples or samples, *words)
            rows.append(row(f"{name}: {method}", reports[method]))
        if options.steps:
            continue
        ratios = {method: total(reports[method]) / total(reports["svma"]) for method in ("maprm", "maprm-exact")}
        verdict = "holds" if ratios["maprm"] >= wanted else "MISSED"
        beside = f"; the dissertation: {published[0] / published[1]:.1f}" if published else ""
        verdicts.append(f"{name}: svma {ratios['maprm']:.1f} times as fast as maprm >= {wanted} ({verdict}{beside}), "
                        f"{ratios['maprm-exact']:.2f} times as maprm-exact")
    print(table(HEADER, rows))
    print("\n".join(verdicts))
    return found


def growth(options):
    found, rows = {}, []
    for obstacles in (10, 30, 100, 300, 1008):
        report = found[f"{obstacles} obstacles"] = roadmap(options, [TOWN, "--limit", obstacles], 10000)
        rows.append(row(f"{obstacles} footprints, 10000 samples", report))
    for samples in (1000, 10000, 100000, 1000000):
        report = found[f"{samples} samples"] = roadmap(options, [TOWN, "--limit", 354], samples)
        rows.append(row(f"354 footprints, {samples} samples", report))
    print(table(HEADER, rows))
    return found


def main(words):
    options = parse(words)
    with tempfile.TemporaryDirectory() as folder:
        found = growth(options) if options.growth else compare(options, files(Path(folder)))
    print(f"seconds on the clock, {'all' if not options.threads else options.threads} threads; parts: decomposition; lost: of the configurations drawn")
    if options.record:
        kind = "growth" if options.growth else "steps" if options.steps else "methods"
        for reports in found.values():
            for report in [reports] if options.growth else reports.values():
                del report["input"]
        print(f"recorded in {history.record('motion', {'kind': kind, 'found': found})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
