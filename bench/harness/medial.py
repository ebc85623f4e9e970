"""`partwise medial` judged by medial_check, whose own axis comes from the Voronoi diagram of a dense sample."""

import json
import tempfile
from pathlib import Path

from . import process
from .table import cell, largest, mean, table

COMPARED = ("to_axis", "from_axis", "repeat", "radius_error")


def judged(settings, mesh, samples):
    """The judge's report. Errors: ValueError with a program's complaint."""
    with tempfile.TemporaryDirectory() as folder:
        triangles, points = Path(folder) / f"{mesh.stem}.off", Path(folder) / "points.ply"
        for command in ([settings.tools / "mesh_variant", mesh, triangles],
                        [settings.program, "medial", triangles, "--points", points, "--threads", settings.threads]):
            process.expect(command, settings.time_limit)
        judge = [settings.tools / "medial_check", triangles, points, "--samples", samples]
        return json.loads(process.expect(judge, settings.time_limit).output)


def medial(settings, paths, category, samples, jobs):
    def one(path):
        try:
            return judged(settings, path, samples)
        except ValueError as error:
            return str(error)

    reports, rows, troubles = [], [], []
    for path, found in zip(paths, jobs(one, paths)):
        if isinstance(found, str):
            troubles.append(f"{path.stem}: {found}")
        else:
            reports.append(found)
            rows.append([f"{path.stem} {category(path)}", *_row(found)])
    total = totals(reports)
    rows.append(["mean", *_row(total)])
    print(table(["mesh", "points", "axis", "| to axis: mean", "95 %", "| from axis: mean", "95 %", "| judge's own: mean",
                 "95 %", "| radius: mean", "95 %", "| inside"], rows))
    for trouble in troubles:
        print(trouble)
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
