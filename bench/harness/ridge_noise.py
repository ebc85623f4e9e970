"""Whether convex ridges stay put when the surface is noisy, as Figure 2.27 shows for an ant: what ridge_noise finds, by
mesh, and its shares over all."""

import json

from . import process
from .table import cell, mean, table

AMPLITUDES = (1e-6, 0.005, 0.01, 0.02)  # of R; the first is no noise but other rounding


def ridge_noise(settings, program, seeds, along_normals, paths, category, jobs):
    """`seeds` noisy copies an amplitude, the same seeds for every mesh."""
    command = ["--tolerance", settings.tolerance, "--seeds", seeds, "--threads", settings.threads,
               "--amplitudes", *AMPLITUDES] + ["--along-normals"] * along_normals

    def one(path):
        run = process.run([program, path, *command], settings.time_limit)
        return run.trouble or json.loads(run.output)

    found = list(zip(paths, jobs(one, paths)))
    reports = [report for _, report in found if not isinstance(report, str)]
    several = [report for report in reports if report["ridges"] > 1]
    rows = [[f"{path.stem} {category(path)}", *_figures([report])] for path, report in found if report in reports]
    rows.append(["all", *_figures(reports)])
    if len(several) < len(reports):
        rows.append(["of several ridges", *_figures(several)])
    header = ["mesh", "ridges", "compact"]
    for amplitude in AMPLITUDES:
        header += [f"| {100 * amplitude:g} %: stay", "compact", "extra"]
    print(table([*header, "| grew", "shrank", "gone", "| 0.9 T: stay", "1.1 T"], rows))
    for path, report in found:
        if report not in reports:
            print(f"{path.stem}: {report}")
    moved = "along normals" if along_normals else "in a ball"
    print(f"{seeds} copies an amplitude, vertices moved {moved}; share of the ridges that stay, %, all and"
          f" compact; a ridge stays where one of the copy is at most {settings.tolerance:g} R away; extra, grew, shrank,"
          " gone: ridges a copy")
    return {"seeds": seeds, "moved": moved, "finished": len(reports), "several_ridges": len(several),
            "all": totals(reports), "meshes_of_several_ridges": totals(several)}


def share_that_stays(reports, runs_of, stay="stay", of="ridges"):
    """Of the ridges of all meshes, each counted once a copy; None where there are none."""
    counts = [(run[stay], report[of]) for report in reports for run in runs_of(report)]
    total = sum(ridges for _, ridges in counts)
    return sum(stay for stay, _ in counts) / total if total else None


def totals(reports):
    def at(amplitude):
        return lambda report: [run for run in report["noisy"] if run["amplitude"] == amplitude]

    def a_copy(name, runs_of=lambda report: report["noisy"]):
        return mean(run[name] for report in reports for run in runs_of(report))

    return {"ridges": mean(report["ridges"] for report in reports),
            "compact": mean(report["compact"] for report in reports),
            "noise": {f"{amplitude:g}": {
                "stay": share_that_stays(reports, at(amplitude)),
                "stay_compact": share_that_stays(reports, at(amplitude), "stay_compact", "compact"),
                "extra": a_copy("extra", at(amplitude))} for amplitude in AMPLITUDES},
            **{name: a_copy(name) for name in ("grew", "shrank", "gone")},
            "other_tolerance": {f"{factor:g}": share_that_stays(reports, lambda report, factor=factor: [
                run for run in report["other_tolerance"] if run["factor"] == factor]) for factor in (0.9, 1.1)}}


def _figures(reports):
    def percent(share):
        return cell(None if share is None else 100 * share, ".1f")

    total = totals(reports)
    row = [cell(total[name], "g" if len(reports) == 1 else ".2f") for name in ("ridges", "compact")]
    for noise in total["noise"].values():
        row += [f"| {percent(noise['stay'])}", percent(noise["stay_compact"]), cell(noise["extra"], ".2f")]
    row += ["| " * (name == "grew") + cell(total[name], ".2f") for name in ("grew", "shrank", "gone")]
    less, more = (percent(share) for share in total["other_tolerance"].values())
    return row + [f"| {less}", more]
