"""`partwise decompose` on one mesh, timed, and judged by decompose_check: what the program says of itself is compared with
what the judge finds in its files."""

import json
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from . import meshes, process


@dataclass
class Settings:
    program: Path
    checker: Path | None = None  # judges too where given
    tolerance: float = 0.1
    measure: str = "hull"
    max_hull_vertices: int = 0
    cup_repair: bool = False
    threads: int = 1
    time_limit: float = 120  # seconds
    samples: int = 20000

    def described(self):
        """What a result depends on, for the history."""
        return {"tolerance": self.tolerance, "measure": self.measure, "max_hull_vertices": self.max_hull_vertices,
                "threads": self.threads} | ({"cup_repair": True} if self.cup_repair else {})


@dataclass
class Result:
    mesh: Path
    trouble: str = ""  # why there is no result; empty when there is
    parts: int | None = None
    ratio: float | None = None  # the judge's where it was asked, else the program's own
    cpu_seconds: float | None = None
    memory_mb: float | None = None
    check: dict | None = None
    failures: list = field(default_factory=list)  # promises broken, the judge's words or ours
    rand: float | None = None

    def checked(self, name):
        return self.check.get(name) if self.check else None


@dataclass
class Files:
    """Where a decomposition's files lie in a folder."""
    folder: Path

    @property
    def labels(self):
        return self.folder / "labels.seg"

    @property
    def hulls(self):
        return self.folder / "hulls.obj"

    @property
    def scene(self):
        return self.folder / "parts.glb"

    @property
    def report(self):
        return self.folder / "report.json"


def run_program(settings, mesh, files, threads=None, scene=False):
    """`scene`: writes the coloured parts as well, which the other measurements have no use for."""
    command = [settings.program, "decompose", mesh, "--tolerance", settings.tolerance, "--measure", settings.measure,
               "--threads", threads or settings.threads, "--labels", files.labels, "--hulls", files.hulls,
               "--json", files.report, "--quiet"]
    if scene:
        command += ["--glb", files.scene]
    if settings.cup_repair:
        command.append("--cup-repair")
    if settings.max_hull_vertices:
        command += ["--max-hull-vertices", settings.max_hull_vertices]
    return process.run(command, settings.time_limit)


def judge(settings, mesh, labels, hulls, tolerance=None):
    """The judge's report, or the reason that there is none. `labels` may be "-"."""
    command = [settings.checker, mesh, labels, hulls, "--samples", settings.samples]
    if tolerance is not None:
        command += ["--tolerance", tolerance]
    run = process.run(command, 20 * settings.time_limit)
    if run.status in (0, 3) and not run.timed_out:
        return json.loads(run.output), ""
    return None, run.trouble


def judged_mesh(settings, mesh, folder):
    """The mesh as the judge can read it: itself if it is an OFF file of triangles."""
    try:
        if mesh.suffix.lower() == ".off":
            meshes.read_off(mesh)
            return mesh
    except ValueError:
        pass
    triangles = folder / "triangles.off"
    process.run([settings.checker.with_name("triangle_off"), mesh, triangles], settings.time_limit)
    return triangles if triangles.exists() else mesh


def decompose(settings, mesh, people=None):
    with tempfile.TemporaryDirectory() as folder:
        files = Files(Path(folder))
        run = run_program(settings, mesh, files)
        result = Result(mesh, run.trouble, cpu_seconds=run.cpu_seconds, memory_mb=run.memory_mb)
        missing = [path.name for path in (files.labels, files.hulls, files.report) if not path.exists()]
        if not result.trouble and missing:
            result.trouble = "exit status 0 without " + ", ".join(missing)
        if result.trouble:
            return result
        report = json.loads(files.report.read_text())
        result.parts, result.ratio = report["parts"], report["volume_ratio"]
        if people:
            result.rand = people.error(mesh, files.labels)
        if settings.checker:
            _judge(settings, files, report, result)
        return result


def _judge(settings, files, report, result):
    # Exposure is what `hull` promises and `valley` does not.
    limit = settings.tolerance if settings.measure == "hull" else None
    result.check, trouble = judge(settings, judged_mesh(settings, result.mesh, files.folder), files.labels, files.hulls, limit)
    if trouble:
        result.failures.append(f"the judge: {trouble}")
        return
    check = result.check
    result.failures += check["failures"]
    if settings.max_hull_vertices and check["max_hull_vertices"] > settings.max_hull_vertices:
        result.failures.append(f"a hull has {check['max_hull_vertices']} vertices")
    if report["parts"] != check["parts"]:
        result.failures.append(f"says {report['parts']} parts and labels {check['parts']}")
    if report["watertight"] != check["closed"]:
        result.failures.append(f"says watertight: {report['watertight']}")
    if abs(report["radius"] / check["radius"] - 1) > 1e-6:
        result.failures.append(f"says radius {report['radius']:.9g}, it is {check['radius']:.9g}")
    if check["volume_ratio"] is not None:
        said, found = report["volume_ratio"], check["volume_ratio"]
        if said is None or abs(said - found) > 4 * check["volume_ratio_error"] + 5e-3 * found:
            result.failures.append(f"says volume ratio {'none' if said is None else f'{said:.4f}'}, it is {found:.4f}")
        result.ratio = found
