"""Another material on one photo. libtorch is loaded by the first edit, not before."""

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
    try:
        from . import _editing
    except ImportError as error:
        raise ImportError("edit needs libtorch; build partwise with -DPARTWISE_LEARNING=ON, or install libtorch-dev") from error
    return _editing.edit(photo, masks, coefficients, other, other_masks, light, refine, weights)


def _coefficients(given):
    found = given if isinstance(given, Material) else find_material(given)
    if found.coefficients is None:
        raise InputError(f"{found.name}: is measured, not fitted; fit it with fit_material")
    return found.coefficients
