"""What a table of means does not show: turned meshes, other numbers of threads, missing faces, segmentations by people,
and HACD as a peer."""

import json
import tempfile
from dataclasses import replace
from pathlib import Path

from . import meshes, process
from .decompose import Files, decompose, judge, run_program
from .table import cell, largest, mean, table


def rotations(settings, paths, count, jobs):
    """Parts under random rotations; the same seeds for every mesh."""
    settings = replace(settings, checker=None)

    def one(path):
        vertices, faces = meshes.read_off(path)
        parts = []
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(count):
                turned = Path(folder) / f"{path.stem}_{seed}.off"
                meshes.write_off(turned, meshes.rotated(vertices, seed), faces)
                parts.append(decompose(settings, turned).parts)
                turned.unlink()
        return decompose(settings, path).parts, parts

    rows, worst, unfinished = [], 0, 0
    for path, (as_given, parts) in zip(paths, jobs(one, paths)):
        known = [p for p in parts if p is not None]
        unfinished += (as_given is None) + len(parts) - len(known)
        if as_given is not None and known:
            worst = max(worst, abs(min(known) - as_given), abs(max(known) - as_given))
        rows.append([path.stem, cell(as_given), cell(min(known, default=None)), cell(max(known, default=None))])
    print(table(["mesh", "parts as given", "fewest", "most"], rows))
    print(f"{count} rotations: parts within {worst} of the mesh as given (target 1); {unfinished} runs did not finish")
    return {"rotations": count, "parts_within": worst, "unfinished": unfinished}


def determinism(settings, paths, jobs):
    """Bytes of labels, hulls, coloured parts and report (less its times) for one thread, two, and two again."""
    def bytes_of(path, threads, files):
        run = run_program(settings, path, files, threads, scene=True)
        if run.trouble:
            return run.trouble
        written = {"labels": files.labels, "hulls": files.hulls, "parts": files.scene, "report": files.report}
        missing = [file.name for file in written.values() if not file.exists()]
        if missing:
            return "exit status 0 without " + ", ".join(missing)
        found = {name: file.read_bytes() for name, file in written.items()}
        found["report"] = json.loads(found["report"])
        found["report"].pop("seconds", None)
        for file in written.values():
            file.unlink()
        return found

    def one(path):
        with tempfile.TemporaryDirectory() as folder:  # the same names each time: a report may hold them
            runs = [bytes_of(path, threads, Files(Path(folder))) for threads in (1, 2, 2)]
        for trouble in runs:
            if isinstance(trouble, str):
                return trouble
        different = [name for name in runs[0] if any(run[name] != runs[0][name] for run in runs)]
        return "different: " + ", ".join(different) if different else "same"

    verdicts = list(jobs(one, paths))
    for path, verdict in zip(paths, verdicts):
        if verdict != "same":
            print(f"{path.stem}: {verdict}")
    same = verdicts.count("same")
    print(f"1 thread, 2 threads, 2 again: the same bytes on {same} of {len(paths)} meshes")
    return {"meshes": len(paths), "same": same}


def removal(settings, paths, shares, jobs):
    """Seeded removal of faces; the union's volume over the volume of the mesh as given."""
    def one(path):
        vertices, faces = meshes.read_off(path)
        intact = meshes.volume(vertices, faces)
        found = []
        with tempfile.TemporaryDirectory() as folder:
            for share in shares:
                holed = Path(folder) / f"{path.stem}.off"
                meshes.write_off(holed, vertices, meshes.thinned_out(faces, share, seed=1))
                result = decompose(settings, holed)
                union = result.checked("volume_union")
                found.append((result, None if union is None else union / intact))
        return found

    rows, outcomes = [], {}
    for path, found in zip(paths, jobs(one, paths)):
        row = [path.stem]
        for share, (result, ratio) in zip(shares, found):
            row += [result.trouble or cell(result.parts), cell(ratio, ".3f"), cell(result.cpu_seconds, ".2f"),
                    "; ".join(result.failures) or "-"]
            outcomes.setdefault(share, []).append((result.parts, ratio, bool(result.trouble), bool(result.failures)))
        rows.append(row)
    header = ["mesh"] + [text for share in shares for text in (f"{share:.0%} gone: parts", "ratio", "CPU s", "broken")]
    print(table(header, rows))
    return {f"{share:g}": {"parts": mean(row[0] for row in found), "volume_ratio": mean(row[1] for row in found),
                           "parts_max": largest(row[0] for row in found),
                           "volume_ratio_max": largest(row[1] for row in found),
                           "unfinished": sum(row[2] for row in found), "broken_promises": sum(row[3] for row in found)}
            for share, found in outcomes.items()}


def figure_2_35(settings, paths, category, people, tolerances, jobs):
    """Rand error against people at 0.09 and 0.1, with the best of some tolerances a category, and a mesh."""
    tolerances = sorted({0.09, 0.1, *tolerances})

    def one(path):
        errors, unfinished = {}, 0
        for tolerance in tolerances if people.files(path) else []:
            with tempfile.TemporaryDirectory() as folder:
                files = Files(Path(folder))
                if run_program(replace(settings, tolerance=tolerance), path, files).trouble:
                    unfinished += 1
                else:
                    errors[tolerance] = people.error(path, files.labels)
        return errors, people.among_themselves(path), unfinished

    groups, unfinished = {}, 0
    for path, found in zip(paths, jobs(one, paths)):
        groups.setdefault(category(path), []).append(found[:2])
        unfinished += found[2]
    rows, columns = [], []
    for name, group in groups.items():
        at = {t: mean(errors.get(t) for errors, _ in group) for t in tolerances}
        best = min((t for t in tolerances if at[t] is not None), key=lambda t: at[t], default=None)
        each = [mean([human for _, human in group]), mean(min(e.values(), default=None) for e, _ in group),
                at.get(best), at[0.09], at[0.1]]
        rows.append([name, *(cell(value, ".3f") for value in each), cell(best, "g")])
        columns.append((len(group), each))
    averages = []
    for k in range(5):
        known = [(n, each[k]) for n, each in columns if each[k] is not None]
        averages.append(sum(n * v for n, v in known) / sum(n for n, _ in known) if known else None)
    rows.append(["all", *(cell(value, ".3f") for value in averages), ""])
    print("Rand error, as Figure 2.35; tolerances " + " ".join(f"{t:g}" for t in tolerances))
    print(table(["category", "people", "best a mesh", "best a category", "0.09", "0.1", "at"], rows))
    print(f"{unfinished} runs did not finish")
    names = ("people", "best_per_mesh", "best_per_category", "at_0.09", "at_0.1")
    return {"tolerances": tolerances, "unfinished": unfinished, **dict(zip(names, averages))}


def hacd(settings, program, faces, paths, jobs):
    """Bullet's HACD beside ours, both judged by decompose_check."""
    def one(path):
        ours = decompose(settings, path)
        with tempfile.TemporaryDirectory() as folder:
            hulls = Path(folder) / "hulls.obj"
            run = process.run([program, path, "--hulls", hulls, "--tolerance", settings.tolerance, "--faces", faces],
                              10 * settings.time_limit)
            if run.trouble:
                return ours, run.trouble, None, run.cpu_seconds
            check, trouble = judge(settings, path, "-", hulls)
            return ours, trouble, check, json.loads(run.output)["seconds"]

    rows, sums = [], []
    for path, (ours, trouble, check, seconds) in zip(paths, jobs(one, paths)):
        peer = [check["hulls"], check["volume_ratio"], seconds, check["interior_uncovered"],
                check["exposure"]] if check else [None, None, seconds, None, None]
        own = [ours.parts, ours.ratio, ours.cpu_seconds, ours.checked("interior_uncovered"), ours.checked("exposure")]
        if check and not ours.trouble:
            sums.append(own + peer)
        rows.append([path.stem, *_figures(own), *_figures(peer), trouble or ours.trouble or "-"])
    means = [mean(row[k] for row in sums) for k in range(10)]
    rows.append([f"mean of {len(sums)}", *_figures(means[:5]), *_figures(means[5:]), ""])
    columns = ["parts", "ratio", "CPU s", "lost %", "sticks out"]
    print(table(["mesh", *columns, *("HACD: " + columns[0], *columns[1:]), "trouble"], rows))
    print(f"HACD on meshes simplified to {faces} faces, at the same tolerance; its hulls need not enclose the mesh")
    names = ("parts", "volume_ratio", "cpu_seconds", "uncovered", "exposure")
    return {"meshes": len(paths), "both_finished": len(sums), "faces": faces, "ours": dict(zip(names, means[:5])),
            "hacd": dict(zip(names, means[5:]))}


def _figures(values):
    parts, ratio, seconds, lost, out = values
    return [cell(parts, "g" if isinstance(parts, int) else ".2f"), cell(ratio, ".3f"), cell(seconds, ".2f"),
            cell(None if lost is None else 100 * lost, ".2f"), cell(out, ".4f")]
