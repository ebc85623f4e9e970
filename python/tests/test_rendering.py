"""Materials, balls and images are the program's, to the byte."""

import json

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, REPOSITORY, run, same_bytes


def write_scene(folder, **more):
    scene = {"meshes": [{"file": str(CHAIR), "labels": "chair.seg", "material": ["chrome", "pink-fabric"]}],
             "light": {"name": "venice", "rotation": 40}, "camera": {"azimuth": 50, "elevation": 10, "share": 0.3},
             "size": [64, 48], "samples": 2}
    (folder / "scene.json").write_text(json.dumps(scene | more))


@pytest.fixture(scope="module")
def labels():
    return pw.decompose(pw.read_mesh(CHAIR)).labels


def shown(rendering):
    return pw.tone_mapped(rendering.image, rendering.mask)


@pytest.mark.parametrize("exact", [False, True])
def test_images_are_the_programs(tmp_path, labels, exact):
    pw.write_labels(tmp_path / "chair.seg", labels)
    write_scene(tmp_path, path="exact" if exact else "reflectance_map")
    run(tmp_path, "render", "scene.json", "--exr", "a.exr", "--png", "a.png", "--mask", "mask.png", "--depth", "depth.exr")
    of_file = pw.render_scene(tmp_path / "scene.json")
    of_arrays = pw.render(pw.read_mesh(CHAIR), ["chrome", "pink-fabric"], labels, light="venice", rotation=40, azimuth=50,
                          elevation=10, share=0.3, size=(64, 48), samples=2, exact=exact)
    for number, rendering in enumerate([of_file, of_arrays]):
        pw.write_image(tmp_path / f"{number}.exr", rendering.image)
        pw.write_image(tmp_path / f"{number}.png", shown(rendering), shown=True)
        pw.write_image(tmp_path / f"{number}.mask.png", rendering.mask, shown=True)
        same_bytes(tmp_path, "a.exr", f"{number}.exr")
        same_bytes(tmp_path, "a.png", f"{number}.png")
        same_bytes(tmp_path, "mask.png", f"{number}.mask.png")
        assert (pw.read_image(tmp_path / "depth.exr") == rendering.depth).all()
    for name in ("image", "normals", "depth", "mask", "parts"):
        assert (getattr(of_file, name) == getattr(of_arrays, name)).all(), name


def test_arrays_of_a_rendering(labels):
    rendering = pw.render(pw.read_mesh(CHAIR), "chrome", labels, size=(40, 30))
    assert rendering.image.shape == rendering.normals.shape == (30, 40, 3) and rendering.image.dtype == np.float32
    assert rendering.depth.shape == rendering.mask.shape == rendering.parts.shape == (30, 40)
    seen = rendering.mask > 0
    assert np.allclose(np.linalg.norm(rendering.normals[seen], axis=1), 1, atol=1e-5)
    assert (rendering.normals[~seen] == 0).all() and (rendering.parts[~seen] == -1).all()
    assert rendering.camera.axes.shape == (3, 3) and rendering.camera.orthographic


def test_a_map_of_light_is_a_light():
    mesh = pw.read_mesh(CHAIR)
    light = pw.read_image(REPOSITORY / "data" / "lights" / "studio.exr")
    assert (pw.render(mesh, "nylon", light=light, size=(32, 32)).image ==
            pw.render(mesh, "nylon", light="studio", size=(32, 32)).image).all()


def test_balls_are_the_programs(tmp_path):
    run(tmp_path, "material", "ball", "chrome", "-o", "a.exr", "--light", "venice", "--size", 48)
    ball = pw.material_ball("chrome", light="venice", size=48)
    assert ball.shape == (48, 48, 4)
    pw.write_image(tmp_path / "b.exr", ball)
    same_bytes(tmp_path, "a.exr", "b.exr")


def test_materials_list_and_evaluate(tmp_path):
    assert pw.shipped_materials() == run(tmp_path, "material", "list")["materials"]
    material = pw.material("gold-metallic-paint")
    assert material.coefficients.shape == (108,) and material.name == "gold-metallic-paint"
    half = np.sqrt(0.5)
    lights = np.array([[0, 0, 1], [half, 0, half], [0, half, half], [0, 0, -1]])
    values = material.evaluate(lights, [0, 0, 1])
    assert values.shape == (4, 3) and values.dtype == np.float32
    assert (values[:3] > 0).all() and (values[3] == 0).all()
    assert np.allclose(values[1], values[2]) and (material.evaluate(lights[1], [0, 0, 1]) == values[1]).all()
    # Reciprocal.
    assert np.allclose(material.evaluate([0, 0, 1], lights[1]), values[1], rtol=1e-4)
    again = pw.Material(material.coefficients, "copy")
    assert (again.evaluate(lights, [0, 0, 1]) == values).all()
    pw.write_material(tmp_path / "copy.json", again)
    assert np.allclose(pw.material(tmp_path / "copy.json").coefficients, material.coefficients, rtol=1e-5)


def test_images_between_file_and_array(tmp_path):
    picture = np.linspace(0, 1, 2 * 3 * 3, dtype=np.float32).reshape(2, 3, 3)
    for name in ("a.exr", "a.hdr", "a.png"):
        pw.write_image(tmp_path / name, picture)
        again = pw.read_image(tmp_path / name)
        assert again.shape == picture.shape and np.allclose(again, picture, atol=0.02), name
