from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Light, Material, Path

class Edit:
    image: NDArray[np.float32]
    normals: NDArray[np.float32]
    light: NDArray[np.float32]
    materials: NDArray[np.float64]
    l2_reconstruction: float

def edit(
    photo: Path | ArrayLike,
    material: Path | Material | Sequence[Path | Material] | None = None,
    *,
    masks: Sequence[Path] | Sequence[ArrayLike] | None = None,
    other: Path | ArrayLike | None = None,
    other_masks: Sequence[Path] | Sequence[ArrayLike] | None = None,
    light: Light | None = None,
    refine: bool = False,
    weights: Path | None = None,
) -> Edit: ...
def photo_normals(
    photo: Path | ArrayLike, *, mask: Path | ArrayLike | None = None, weights: Path | None = None
) -> NDArray[np.float32]: ...
def scene_normals(photo: Path | ArrayLike, *, weights: Path | None = None) -> NDArray[np.float32]: ...
