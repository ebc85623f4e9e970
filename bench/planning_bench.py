#!/usr/bin/python3
"""Narrow passages: planner SVMA, MAPRM and UMAPRM beside OMPL's PRM with four samplers, each run with the same seconds, on the same checks
of validity and motions. How many runs solve, how clear their paths are, and what two ways of shortening leave. See bench/README.md.

    planning_bench.py [PROBLEM...] [--parasol DIR] [--runs 50] [--time 20] [--record]
"""

import argparse
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, ompl_log, planning_scenes  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import cell, table  # noqa: E402

OURS = {planner: ["--planner", planner] for planner in ("svma", "maprm", "umaprm")}
PRM = {f"prm, {sampler}": ["--planner", "prm", "--sampler", sampler] for sampler in ("uniform", "bridge", "obstacle", "clearance")}
METHODS = {**OURS, **PRM}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("problems", nargs="*", metavar="PROBLEM", help="three sticks, alpha, flange, bug trap; left out: all that are there")
    add("--parasol", type=Path, help="folder of Parasol's environments (alpha1.6/, flange_1.0/, bug_trap1.0/)")
    add("--methods", nargs="*", choices=METHODS, default=list(METHODS))
    add("--runs", type=int, default=50)
    add("--time", type=float, default=20, help="seconds of each run, training included")
    add("--program", type=Path, default=BIN / "partwise")
    add("--record", action="store_true", help="append the result to bench/history/planning.jsonl")
    return parser.parse_args(words)


def median(runs, name):
    values = [run[name] for run in runs if run.get(name) is not None]
    return statistics.median(values) if values else None


def measured(options, problem, method, folder):
    log = Path(folder) / "runs.log"
    expect([options.program, "plan", problem, *METHODS[method], "--runs", options.runs, "--time", options.time, "--log", log, "--quiet"],
           options.runs * (options.time + 60) + 600)
    runs = ompl_log.read(log.read_text())
    solved = [run for run in runs if run["solved"]]
    names = {"seconds": "time", "length": "path length", "clearance": "path minimum clearance", "mean clearance": "path mean clearance",
             "kept length": "kept length", "kept clearance": "kept minimum clearance", "shortcut length": "shortcut length",
             "shortcut clearance": "shortcut minimum clearance"}
    found = {ours: median(solved, theirs) for ours, theirs in names.items()}
    for name, (above, below) in {"length ratio": ("kept length", "shortcut length"), "clearance ratio": ("kept minimum clearance", "path minimum clearance")}.items():
        ratios = [run[above] / run[below] for run in solved]
        found[name] = statistics.median(ratios) if ratios else None
        found[f"worst {name}"] = (max if above == "kept length" else min)(ratios) if ratios else None
    return {"runs": len(runs), "solved": len(solved), **found}


HEADER = ["", "solved", "seconds", "length", "clearance", "mean clearance", "kept length", "kept clearance", "shortcut length",
          "shortcut clearance", "length ratio", "worst", "clearance ratio", "worst"]
COLUMNS = ["seconds", "length", "clearance", "mean clearance", "kept length", "kept clearance", "shortcut length", "shortcut clearance",
           "length ratio", "worst length ratio", "clearance ratio", "worst clearance ratio"]


def verdicts(name, found):
    lines = []
    svma = found.get("svma")
    for method, other in found.items():
        if not svma or method not in PRM:
            continue
        more = "holds" if svma["solved"] > other["solved"] else "equal" if svma["solved"] == other["solved"] else "MISSED"
        line = f"{name}: svma solves {svma['solved']} of {svma['runs']}, {method} {other['solved']} ({more})"
        if svma["clearance"] and other["clearance"]:
            line += f"; clearance {svma['clearance'] / other['clearance']:.1f} times, time {svma['seconds'] / other['seconds']:.2f} times"
        lines.append(line)
    return lines


def main(words):
    options = parse(words)
    found, rows, lines = {}, [], []
    with tempfile.TemporaryDirectory() as folder:
        scenes = planning_scenes.problems(folder, options.parasol)
        for name in options.problems or scenes:
            if name not in scenes:
                sys.exit(f"planning_bench: no problem {name}; there are {', '.join(scenes)}, and those of Parasol with --parasol")
            found[name] = {}
            for method in options.methods:
                result = found[name][method] = measured(options, scenes[name], method, folder)
                rows.append([f"{name}: {method}", f"{result['solved']}/{result['runs']}", *(cell(result[column], ".3g") for column in COLUMNS)])
            lines += verdicts(name, found[name])
    print(table(HEADER, rows))
    print("\n".join(lines))
    print(f"medians of solved runs; at most {options.time:g} s a run")
    if options.record:
        print(f"recorded in {history.record('planning', {'seconds': options.time, 'found': found})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
