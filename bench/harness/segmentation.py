"""Labellings of a folder of meshes judged by people's: results and their table by category."""

from dataclasses import dataclass
from pathlib import Path

from .dissertation import TABLE_2_1, TABLE_2_1_AVERAGE, TABLE_2_1_COLUMNS
from .people import MEASURES
from .table import cell, mean, table

TITLES = ("Rand", "cut discr.", "Hamming", "missing", "false", "GCE", "LCE")  # of MEASURES, in their order


@dataclass
class Result:
    mesh: Path
    measures: dict | None = None  # means over the people, by the names in MEASURES
    trouble: str = ""  # why there are none; empty when there are


def judged(mesh, measures_of):
    """`measures_of(mesh)` gives the report of `partwise evaluate`, or None where nobody has segmented the mesh, or raises a
    ValueError."""
    try:
        report = measures_of(mesh)
    except ValueError as error:
        return Result(mesh, trouble=str(error))
    if report is None:
        return Result(mesh, trouble=f"{mesh.stem}: too few people")
    return Result(mesh, {name: report[name] for name in MEASURES})


def means(results):
    """Of each measure over the meshes; None where there is nothing."""
    known = [result.measures for result in results if result.measures]
    return {"meshes": len(known)} | {name: mean(measures[name] for measures in known) for name in MEASURES}


def by_category(results, category, dissertation):
    """The means by category, in the order of the meshes, beside the dissertation's Table 2.1 (Rand errors) where asked."""
    groups = {}
    for result in results:
        groups.setdefault(category(result.mesh), []).append(result)
    header = ["category", "meshes", *TITLES]
    if dissertation:
        header += [f"| Rand: {TABLE_2_1_COLUMNS[0]}", *TABLE_2_1_COLUMNS[1:]]
    rows = []
    for name, group in [*groups.items(), ("all", results)]:
        found = means(group)
        row = [name, str(found["meshes"]), *(cell(found[measure], ".3f") for measure in MEASURES)]
        if dissertation:
            figures = TABLE_2_1_AVERAGE if name == "all" else TABLE_2_1.get(name, ())
            row += [cell(figure, ".2f") for figure in figures] or [""] * len(TABLE_2_1_COLUMNS)
        rows.append(row)
    return table(header, rows)
