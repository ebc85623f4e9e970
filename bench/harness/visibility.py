"""Continuous visibility over a folder of meshes: its methods beside each other, its times, and how they grow."""

import json
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

from . import process
from .dissertation import FILTER_SAVES, FILTER_SECONDS_AT_10K, SIZE_CLASSES
from .table import cell, largest, mean, table

OTHERS = ("filter", "filter-printed", "bfs-plain")  # than bfs


@dataclass
class Settings:
    program: Path
    tools: Path = process.BIN  # visibility_compare, mesh_variant, medial_check
    threads: int = 2
    time_limit: float = 600  # wall seconds a run


def report_of(command, time_limit):
    """The run, and what it printed as JSON or None."""
    run = process.run(command, time_limit)
    return run, None if run.trouble else json.loads(run.output)


def size_class(vertices):
    """Of the dissertation's three."""
    return SIZE_CLASSES[(vertices >= 5000) + (vertices > 10000)]


def percent(share, form=".1f"):
    return cell(None if share is None else 100 * share, form)


# Methods


def methods(settings, paths, category, jobs):
    """Whether filter finds what bfs finds, how many tests it saves, and how far the other two differ."""
    command = [settings.tools / "visibility_compare", "--threads", settings.threads]
    found = list(zip(paths, jobs(lambda path: report_of([*command, path], settings.time_limit), paths)))
    reports = [report for _, (_, report) in found if report]
    print(table(["mesh", "vertices", "bfs tests", *("saved %: " * (k == 0) + name for k, name in enumerate(OTHERS[:2])),
                 "| filter differs", "| printed: % differ", "mean %", "| plain: % differ", "mean %"],
                [[f"{path.stem} {category(path)}", *_methods_row(report)] for path, (_, report) in found if report]))
    print()
    totals = {name: methods_totals([report for report in reports if name in (size_class(report["vertices"]), "all")])
              for name in (*SIZE_CLASSES, "all")}
    print(table(["vertices", "meshes", "saved %, of all tests: filter", "filter-printed", "| mean of meshes: filter",
                 "filter-printed", "| dissertation", "| filter differs", "| printed: % differ", "mean %",
                 "| plain: % differ", "mean %"],
                [[name, *_totals_row(total, FILTER_SAVES.get(name))] for name, total in totals.items()]))
    for path, (run, report) in found:
        if not report:
            print(f"{path.stem}: {run.trouble}")
    total = totals["all"]
    print(f"filter differs from bfs at {total['filter']['regions_differ']} of {total['vertices']} vertices"
          f" (regions), {total['filter']['values_differ']} (values)")
    return {"finished": len(reports), "totals": totals}


def methods_totals(reports):
    """`saved`: of the tests of all meshes together; `saved_mean`: the mean over the meshes. Shares of vertices and
    relative differences are of all vertices together."""
    vertices = sum(report["vertices"] for report in reports)
    bfs = sum(report["methods"]["bfs"]["tests"] for report in reports)
    totals = {"meshes": len(reports), "vertices": vertices, "bfs_tests": bfs}
    for name in OTHERS:
        ours = [report["methods"][name] for report in reports]
        weighted = sum(method["difference"] * report["vertices"] for method, report in zip(ours, reports))
        values_differ = sum(method["values_differ"] for method in ours)
        totals[name] = {
            "saved": 1 - sum(method["tests"] for method in ours) / bfs if bfs else None,
            "saved_mean": mean(saved(report, name) for report in reports),
            "regions_differ": sum(method["regions_differ"] for method in ours),
            "values_differ": values_differ,
            "share_differ": values_differ / vertices if vertices else None,
            "difference": weighted / vertices if vertices else None}
    return totals


def saved(report, name):
    tests = report["methods"]["bfs"]["tests"]
    return 1 - report["methods"][name]["tests"] / tests if tests else None


def _methods_row(report):
    row = [str(report["vertices"]), str(report["methods"]["bfs"]["tests"]),
           *(percent(saved(report, name)) for name in OTHERS[:2]), f"| {report['methods']['filter']['regions_differ']}"]
    for name in OTHERS[1:]:
        method = report["methods"][name]
        row += [f"| {percent(method['values_differ'] / report['vertices'])}", percent(method["difference"], ".2f")]
    return row


def _totals_row(total, dissertation):
    row = [str(total["meshes"]), *(percent(total[name]["saved"]) for name in OTHERS[:2])]
    first, second = (percent(total[name]["saved_mean"]) for name in OTHERS[:2])
    row += [f"| {first}", second, f"| {percent(dissertation and dissertation[0], 'g')}",
            f"| {total['filter']['regions_differ']}"]
    for name in OTHERS[1:]:
        row += [f"| {percent(total[name]['share_differ'])}", percent(total[name]["difference"], ".2f")]
    return row


# Times


def feature_run(settings, mesh, kind, method=None):
    command = [settings.program, "feature", mesh, "--kind", kind, "--threads", settings.threads, "--json", "-"]
    return report_of(command + (["--method", method] if method else []), settings.time_limit)


TIMED = (("cvf", None), ("cvf-avg", None), ("cvf", "bfs"))  # kind and method; none: filter


def times(settings, paths, category, jobs):
    """Wall and CPU seconds and memory of filter, and CPU seconds that it saves on bfs by size class."""
    runs = list(jobs(lambda path: [feature_run(settings, path, *timed) for timed in TIMED], paths))
    rows, classes = [], {}
    for path, timed in zip(paths, runs):
        troubles = [run.trouble for run, _ in timed if run.trouble]
        if troubles:
            rows.append([path.stem, troubles[0]] + [""] * 8)
            continue
        cvf, average, search = (run for run, _ in timed)
        vertices = timed[0][1]["vertices"]
        classes.setdefault(size_class(vertices), []).append((vertices, cvf, average, search))
        rows.append([f"{path.stem} {category(path)}", str(vertices),
                     *(text for run in (cvf, average) for text in (f"| {run.wall_seconds:.2f}", f"{run.cpu_seconds:.2f}",
                                                                   f"{run.memory_mb:.0f}")),
                     f"| {search.cpu_seconds:.2f}", percent(1 - cvf.cpu_seconds / search.cpu_seconds, ".0f")])
    print(table(["mesh", "vertices", "| cvf: wall s", "CPU s", "MB", "| cvf-avg: wall s", "CPU s", "MB", "| bfs: CPU s",
                 "saved %"], rows))
    print()
    totals = {name: _class_times(classes.get(name, [])) for name in SIZE_CLASSES}
    print(table(["vertices", "meshes", "mean vertices", "cvf: CPU s", "cvf-avg: CPU s", "bfs: CPU s", "saved %",
                 "| dissertation: saved %", "MB, most"],
                [[name, str(total["meshes"]), cell(total["vertices"], ".0f"),
                  *(cell(total[key], ".2f") for key in ("cvf", "cvf_avg", "bfs")), percent(total["saved"], ".0f"),
                  f"| {percent(FILTER_SAVES[name][1], 'g')}", cell(total["memory_mb"], ".0f")]
                 for name, total in totals.items()]))
    print(f"{settings.threads} threads; dissertation: about {FILTER_SECONDS_AT_10K} s for 10k vertices by filter")
    return {"threads": settings.threads, "finished": sum(map(len, classes.values())), "totals": totals}


def _class_times(timed):
    cvf, search = (sum(row[k].cpu_seconds for row in timed) for k in (1, 3))
    return {"meshes": len(timed), "vertices": mean(row[0] for row in timed),
            **{key: mean(row[k].cpu_seconds for row in timed) for k, key in ((1, "cvf"), (2, "cvf_avg"), (3, "bfs"))},
            "wall_cvf": mean(row[1].wall_seconds for row in timed), "saved": 1 - cvf / search if search else None,
            "memory_mb": largest(row[k].memory_mb for row in timed for k in (1, 2))}


# Growth


def exponent(sizes, seconds):
    """Of the power law that fits best: least squares between the logarithms. None for less than two sizes."""
    xs, ys = [math.log(size) for size in sizes], [math.log(second) for second in seconds]
    x, y = mean(xs), mean(ys)
    spread = sum((each - x) ** 2 for each in xs)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / spread if spread else None


def growth(settings, paths, sizes, category, jobs):
    """CPU seconds of cvf by filter on subdivided copies of about `sizes` vertices, and how they grow."""
    def one(path):
        found = []
        with tempfile.TemporaryDirectory() as folder:
            for size in sizes:
                copy = Path(folder) / f"{path.stem}_{size}.off"
                made = process.run([settings.tools / "mesh_variant", path, copy, "--vertices", size], settings.time_limit)
                found.append((made, None) if made.trouble else feature_run(settings, copy, "cvf"))
        return found

    rows, exponents, test_exponents, by_mesh = [], [], [], {}
    for path, found in zip(paths, jobs(one, paths)):
        for run, report in found:
            if not report:
                rows.append([f"{path.stem} {category(path)}", run.trouble, *[""] * 4])
                continue
            rows.append([f"{path.stem} {category(path)}", str(report["vertices"]), f"{run.wall_seconds:.2f}",
                         f"{run.cpu_seconds:.2f}", f"{run.memory_mb:.0f}", f"{report['visibility_tests'] / 1e6:.1f}"])
        known = [(report["vertices"], run.cpu_seconds, report["visibility_tests"]) for run, report in found if report]
        vertices, seconds, tests = zip(*known) if known else ((), (), ())
        exponents.append(exponent(vertices, seconds) if known else None)
        test_exponents.append(exponent(vertices, tests) if known else None)
        by_mesh[path.stem] = {"vertices": vertices, "cpu_seconds": seconds, "exponent": exponents[-1]}
        rows.append(["  exponent", "", "", cell(exponents[-1], ".2f"), "", cell(test_exponents[-1], ".2f")])
    print(table(["mesh", "vertices", "wall s", "CPU s", "MB", "million tests"], rows))
    print(f"{settings.threads} threads; mean exponents: CPU seconds {cell(mean(exponents), '.2f')},"
          f" tests {cell(mean(test_exponents), '.2f')}; dissertation: about {FILTER_SECONDS_AT_10K} s for 10k vertices")
    return {"threads": settings.threads, "sizes": sizes, "exponent": mean(exponents),
            "exponent_tests": mean(test_exponents), "by_mesh": by_mesh}
