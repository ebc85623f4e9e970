"""What is read off one photo: its object in another material, its normals. libtorch is loaded by the first call."""

from ._core import InputError, Material, material as find_material


def edit(photo, material=None, *, masks=None, other=None, other_masks=None, light=None, refine=False, weights=None):
    """The object of a photo in another material (docs/edit.md).

    photo: a .png or .jpg; or an array h x w x 3 or 4 as shown, uint8 or 0 to 1.
    material: a name, a file, a Material, or a list of them, one for each mask.
    masks: where the regions are, files for a photo in a file, else arrays h x w. Left out: what is not transparent, or
    (files) not of the background's plain colour.
    other, other_masks: take the material from this photo instead.
    light: another light, a shipped one, a file (.exr, .hdr) or a map h x w x 3.
    refine: make what was found explain the photo better first: slower, nearer.
    weights: networks that `partwise train` made; left out, those that ship.
    """
    if (material is None) == (other is None):
        raise InputError("material: one of material and other has to be there; name a material, or another photo")
    coefficients = None
    if material is not None:
        several = material if isinstance(material, (list, tuple)) else [material]
        coefficients = [_coefficients(each) for each in several]
    return _module("edit").edit(photo, masks, coefficients, other, other_masks, light, refine, weights)


def photo_normals(photo, *, mask=None, weights=None):
    """The normals of the object of a photo (docs/normals.md): h x w x 3 float32 in camera space, unit vectors (+x right,
    +y up, +z towards the camera), zero off the object.

    photo: a .png or .jpg; or an array h x w x 3 or 4 as shown, uint8 or 0 to 1.
    mask: where the object is, a file for a photo in a file, else an array h x w. Left out: what is not transparent, or
    (files) not of the background's plain colour.
    weights: a network that `partwise train` made; left out, that which ships.
    """
    return _module("photo_normals").photo_normals(photo, None if mask is None else [mask], weights)


def scene_normals(photo, *, weights=None):
    """The normals of all that a photo of a room shows (docs/normals.md): h x w x 3 float32 in camera space, unit vectors (+x
    right, +y up, +z towards the camera).

    photo: a .png or .jpg; or an array h x w x 3 as shown, uint8 or 0 to 1.
    weights: a network that `partwise train` made for scenes; left out, that which ships.
    """
    return _module("scene_normals").scene_normals(photo, weights)


def _module(function):
    try:
        from . import _editing
    except ImportError as error:
        remedy = "build partwise with -DPARTWISE_LEARNING=ON, or install libtorch-dev"
        raise ImportError(f"{function} needs libtorch; {remedy}") from error
    return _editing


def _coefficients(given):
    found = given if isinstance(given, Material) else find_material(given)
    if found.coefficients is None:
        raise InputError(f"{found.name}: is measured, not fitted; fit it with fit_material")
    return found.coefficients
