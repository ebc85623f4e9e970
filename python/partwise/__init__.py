"""Shapes into parts: nearly convex parts of meshes and outlines, materials on them, and motion among them.

Meshes, images and labels are NumPy arrays in and out. docs/python.md says what there is, docs/ how it is computed.
"""

from ._core import (
    Camera as Camera,
    CheckFailed as CheckFailed,
    City as City,
    InputError as InputError,
    Material as Material,
    Mesh as Mesh,
    OutlineParts as OutlineParts,
    Parts as Parts,
    Rendering as Rendering,
    Roadmap as Roadmap,
    Segments as Segments,
    decompose as decompose,
    decompose_outline as decompose_outline,
    feature as feature,
    fit_material as fit_material,
    material as material,
    material_ball as material_ball,
    normals_from_depth as normals_from_depth,
    read_city as read_city,
    read_image as read_image,
    read_labels as read_labels,
    read_mesh as read_mesh,
    read_shape as read_shape,
    render as render,
    render_scene as render_scene,
    repaired_shape as repaired_shape,
    roadmap as roadmap,
    segment as segment,
    shipped_lights as shipped_lights,
    shipped_materials as shipped_materials,
    tone_mapped as tone_mapped,
    write_image as write_image,
    write_labels as write_labels,
    write_material as write_material,
    write_mesh as write_mesh,
    write_meshes as write_meshes,
)
from .editing import edit as edit
