"""Segmentations by people, and how far others are from them: `partwise evaluate` with the benchmark's measures."""

import json
from pathlib import Path

from . import process

MEASURES = ("rand_error", "cut_discrepancy", "hamming", "hamming_missing", "hamming_false", "consistency_global",
            "consistency_local")


class People:
    """The segmentations of a mesh by people: FOLDER/NAME/NAME_k.seg. `program`: partwise."""

    def __init__(self, folder, program, time_limit=120):
        self.folder = Path(folder)
        self.program = program
        self.time_limit = time_limit

    def files(self, mesh):
        """In the order of k."""
        return sorted((self.folder / mesh.stem).glob("*.seg"), key=lambda path: (len(path.stem), path.stem))

    def compare(self, mesh, labels, references):
        """The program's report: the mean of each measure and `by_reference`. Errors: ValueError with its complaint."""
        run = process.run([self.program, "evaluate", mesh, labels, *references, "--threads", 1, "--json", "-"],
                          self.time_limit)
        if run.trouble:
            raise ValueError(f"{mesh.stem}: {run.trouble}")
        return json.loads(run.output)

    def measures(self, mesh, labels):
        """A file of labels against each of the people, the means; None where there are none."""
        references = self.files(mesh)
        return self.compare(mesh, labels, references) if references else None

    def error(self, mesh, labels):
        """The mean Rand error alone."""
        report = self.measures(mesh, labels)
        return report and report["rand_error"]

    def first_against_others(self, mesh):
        """The first of the people in place of a program; None where there are fewer than two."""
        first, *others = self.files(mesh) or [None]
        return self.compare(mesh, first, others) if others else None

    def among_themselves(self, mesh):
        """Mean Rand error of a person against another; None where there are fewer than two."""
        people = self.files(mesh)
        errors = [each["rand_error"] for i in range(1, len(people))
                  for each in self.compare(mesh, people[i], people[:i])["by_reference"]]
        return sum(errors) / len(errors) if errors else None
