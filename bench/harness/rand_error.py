"""Rand error of segmentations (Chen, Golovinskiy, Funkhouser 2009): 1 - Rand index, the share of pairs of faces that one
segmentation puts together and the other apart. Counted from the contingency table, in time linear in the faces."""

from collections import Counter
from pathlib import Path


def read_labels(path):
    return [int(word) for word in Path(path).read_text().split()]


def rand_error(a, b):
    """Labels a face of two segmentations of the same mesh; at least two faces."""
    if len(a) != len(b) or len(a) < 2:
        raise ValueError(f"segmentations of {len(a)} and {len(b)} faces")
    together_a = _ordered_pairs(Counter(a))
    together_b = _ordered_pairs(Counter(b))
    together_both = _ordered_pairs(Counter(zip(a, b)))
    return (together_a + together_b - 2 * together_both) / (len(a) * (len(a) - 1))


def _ordered_pairs(counts):
    return sum(count * (count - 1) for count in counts.values())


class People:
    """The segmentations of a mesh by people: SEG_DIR/NAME/NAME_k.seg."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def of(self, mesh):
        return [read_labels(path) for path in sorted((self.folder / mesh.stem).glob("*.seg"))]

    def error(self, mesh, labels):
        """Mean Rand error against each of the people; None where there are none."""
        errors = [rand_error(labels, person) for person in self.of(mesh)]
        return sum(errors) / len(errors) if errors else None

    def among_themselves(self, mesh):
        """Mean Rand error of a person against another."""
        people = self.of(mesh)
        errors = [rand_error(a, b) for i, a in enumerate(people) for b in people[:i]]
        return sum(errors) / len(errors) if errors else None
