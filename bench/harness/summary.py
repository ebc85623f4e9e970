"""The table by category, the totals and the targets of a run of the decomposition over a folder."""

from .dissertation import AVERAGE, TABLE_2_3
from .table import cell, largest, mean, table

HEADER = ["category", "meshes", "parts", "ratio", "CPU s", "max", "lost %", "max %", "sticks out", "outside", "Rand",
          "| parts: HACD", "WCSeg", "CoRISE", "| ratio: HACD", "WCSeg", "CoRISE", "| s: CoRISE"]


def totals(results):
    done = [result for result in results if not result.trouble]
    return {
        "meshes": len(results),
        "finished": len(done),
        "broken_promises": sum(bool(result.failures) for result in done),
        "parts": mean(result.parts for result in done),
        "volume_ratio": mean(result.ratio for result in done),
        "cpu_seconds": mean(result.cpu_seconds for result in done),
        "cpu_seconds_max": largest(result.cpu_seconds for result in done),
        "memory_mb_max": largest(result.memory_mb for result in done),
        "uncovered": mean(result.checked("interior_uncovered") for result in done),
        "uncovered_max": largest(result.checked("interior_uncovered") for result in done),
        "exposure_max": largest(result.checked("exposure") for result in done),
        "exposure_bound_max": largest(result.checked("exposure_bound") for result in done),
        "exposure_strict_max": largest(result.checked("exposure_strict") for result in done),
        "certified": sum(bool(result.checked("exposure_certified")) for result in done),
        "hull_outside_max": largest(result.checked("hull_outside") for result in done),
        "min_hull_volume": min((v for v in (r.checked("min_hull_volume") for r in done) if v is not None), default=None),
        "rand_error": mean(result.rand for result in done),
    }


def _row(name, total, dissertation):
    percent = lambda value: None if value is None else 100 * value
    row = [name, str(total["meshes"]), cell(total["parts"], ".2f"), cell(total["volume_ratio"], ".3f"),
           cell(total["cpu_seconds"], ".2f"), cell(total["cpu_seconds_max"], ".2f"),
           cell(percent(total["uncovered"]), ".2f"), cell(percent(total["uncovered_max"]), ".2f"),
           cell(total["exposure_max"], ".4f"), cell(total["hull_outside_max"], ".0e"), cell(total["rand_error"], ".3f")]
    if not dissertation:
        return row + ["|"] + [""] * 2 + ["|"] + [""] * 2 + ["|"]
    parts, seconds, ratio = dissertation
    row += [f"| {parts[0]:.2f}", f"{parts[1]:.2f}", f"{parts[2]:.2f}", f"| {ratio[0]:.2f}", f"{ratio[1]:.2f}"]
    return row + [f"{ratio[2]:.2f}", f"| {seconds[2]:.2f}"]


def by_category(results, category, dissertation):
    """Beside the dissertation's Table 2.3 where asked; categories in the order of the meshes."""
    groups = {}
    for result in results:
        groups.setdefault(category(result.mesh), []).append(result)
    rows = [_row(name, totals(group), TABLE_2_3.get(name) if dissertation else None) for name, group in groups.items()]
    rows.append(_row("all", totals(results), AVERAGE if dissertation else None))
    header = HEADER if dissertation else HEADER[:11]
    return table(header, [row[:len(header)] for row in rows])


def targets(total, settings, princeton):
    """What was aimed at for these settings, with its means on the Princeton meshes: (what, reached or not, or None if not
    measured)."""
    def at_most(name, limit, label, scale=1.0, form=".2f"):
        value = total[name]
        text = f"{label} {cell(None if value is None else scale * value, form)} <= {scale * limit:g}"
        return text, None if value is None else value <= limit

    count = f"finished {total['finished']} of {total['meshes']}"
    result = [(count, total["finished"] == total["meshes"])]
    if total["exposure_max"] is not None:
        result.append((f"meshes with a broken promise {total['broken_promises']} = 0", total["broken_promises"] == 0))
    result.append(at_most("hull_outside_max", 1e-9, "vertex outside its hull, R", form=".1e"))
    if settings.measure == "hull":
        result.append(at_most("exposure_max", settings.tolerance, "sticks out, R", form=".4f"))
        result.append(at_most("uncovered", 0.005, "interior in no hull, mean %", 100))
        result.append(at_most("uncovered_max", 0.05, "worst %", 100))
    if not princeton:
        return result
    if (settings.measure, settings.tolerance) == ("valley", 0.1):
        result += [at_most("parts", 8.0, "parts"), at_most("volume_ratio", 1.36, "ratio", form=".3f"),
                   at_most("cpu_seconds", 0.8, "CPU s"), at_most("cpu_seconds_max", 4.0, "max CPU s")]
    if (settings.measure, settings.tolerance) == ("hull", 0.1):
        result += [at_most("parts", 8.0, "parts"), at_most("volume_ratio", 1.25, "ratio", form=".3f"),
                   at_most("cpu_seconds", 1.2, "CPU s")]
        text, few = at_most("parts", 7.0, "stretch: parts at that ratio")
        result.append((text, few and result[-2][1]))
    if (settings.measure, settings.tolerance) == ("hull", 0.05):
        result += [at_most("parts", 16.0, "parts"), at_most("volume_ratio", 1.11, "ratio", form=".3f")]
    return result


def targets_line(reached):
    marks = {True: "holds", False: "MISSED", None: "not measured"}
    return "targets: " + "; ".join(f"{text} ({marks[state]})" for text, state in reached)
