"""`partwise medial` judged by medial_check, whose own axis comes from the Voronoi diagram of a dense sample."""

import tempfile
from pathlib import Path

from . import process
from .table import cell, largest, mean, table
from .visibility import report_of

COMPARED = ("to_axis", "from_axis", "repeat", "radius_error")


def judged(settings, mesh, samples):
    """The judge's report. Errors: ValueError with a program's complaint."""
    with tempfile.TemporaryDirectory() as folder:
        triangles, points = Path(folder) / f"{mesh.stem}.off", Path(folder) / "points.ply"
        for command in ([settings.tools / "mesh_variant", mesh, triangles],
                        [settings.program, "medial", triangles, "--points", points, "--threads", settings.threads]):
            run = process.run(command, settings.time_limit)
            if run.trouble:
                raise ValueError(run.trouble)
        run, report = report_of([settings.tools / "medial_check", triangles, points, "--samples", samples],
                                settings.time_limit)
        if not report:
            raise ValueError(run.trouble)
        return report


def medial(settings, paths, category, samples, jobs):
    def one(path):
        try:
            return judged(settings, path, samples)
        except ValueError as error:
            return str(error)

    found = list(zip(paths, jobs(one, paths)))
    reports = [report for _, report in found if not isinstance(report, str)]
    rows = [[f"{path.stem} {category(path)}", *_row(report)] for path, report in found if report in reports]
    total = totals(reports)
    rows.append(["mean", *_row(total)])
    print(table(["mesh", "points", "axis", "| to axis: mean", "95 %", "| from axis: mean", "95 %", "| judge's own: mean",
                 "95 %", "| radius: mean", "95 %", "| inside"], rows))
    for path, report in found:
        if report not in reports:
            print(f"{path.stem}: {report}")
    print(f"shares of R; the judge draws {samples} samples of the surface")
    return {"finished": len(reports), "samples": samples, "totals": total,
            "largest": {name: largest(report[name]["p95"] for report in reports) for name in COMPARED}}


def totals(reports):
    return {name: mean(report[name] for report in reports) for name in ("points", "axis_points", "inside")} | {
        name: {key: mean(report[name][key] for report in reports) for key in ("mean", "p95")} for name in COMPARED}


def _row(report):
    row = [cell(report["points"], ".0f"), cell(report["axis_points"], ".0f")]
    for name in COMPARED:
        row += [f"| {cell(report[name]['mean'], '.4f')}", cell(report[name]["p95"], ".4f")]
    return [*row, f"| {cell(report['inside'], '.3f')}"]
