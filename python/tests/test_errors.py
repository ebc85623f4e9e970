"""What is wrong with arguments is said in one line that names the argument; Ctrl-C ends long calls."""

import signal
import threading
import time

import numpy as np
import partwise as pw
import pytest
from program import CHAIR, NOTCH

MESH = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
SOLID = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
INSIDE = [0.2, 0.2, 0.2]
FREE = pw.Problem("space", [SOLID], queries=[([1, 0.9, 0.9], [0.9, 1, 0.9])])
BODY = pw.Problem("se3", [SOLID], [SOLID])
INDEX = pw.index_parts(SOLID)
SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


def in_space(**more):
    return pw.Problem("space", [SOLID], **more)


WRONG = {
    "shape of vertices": (lambda: pw.Mesh([[0, 0]], [[0, 0, 0]]), "vertices: has the shape 1 x 2; give an array n x 3"),
    "NaN": (lambda: pw.Mesh([[0, 0, 0], [0, np.nan, 0]], [[0, 1, 1]]), "vertices[1]: holds nan"),
    "infinite": (lambda: pw.Mesh([[0, 0, np.inf]], [[0, 0, 0]]), "vertices[0]: holds inf"),
    "dtype of vertices": (lambda: pw.Mesh([["a", "b", "c"]], [[0, 0, 0]]), "vertices: holds <U1; give real numbers"),
    "complex": (lambda: pw.Mesh([[0j, 0, 0]], [[0, 0, 0]]), "vertices: holds complex128"),
    "truth values": (lambda: pw.Mesh(MESH[0], [[True, False, True]]), "faces: holds bool; give whole numbers"),
    "dtype of faces": (lambda: pw.Mesh(MESH[0], [[0, 1, 2.0]]), "faces: holds float64; give whole numbers"),
    "shape of faces": (lambda: pw.Mesh(MESH[0], [[0, 1, 2, 0]]), "faces: has the shape 1 x 4"),
    "index": (lambda: pw.Mesh(MESH[0], [[0, 1, 3]]), "faces[0]: names vertex 3, there are 3"),
    "index below 0": (lambda: pw.Mesh(MESH[0], [[0, 1, 2], [0, 1, -1]]), "faces[1]: names vertex -1"),
    "index of 64 bits": (lambda: pw.Mesh(MESH[0], np.array([[0, 1, 2**63]], np.uint64)), "faces[0]: names vertex -"),
    "ragged": (lambda: pw.Mesh([[0, 0, 0], [1]], [[0, 0, 0]]), "vertices: "),
    "no mesh": (lambda: pw.decompose(3), "mesh: is no mesh"),
    "no faces": (lambda: pw.decompose((MESH[0], np.zeros((0, 3), int))), "mesh: "),
    "measure": (lambda: pw.decompose(MESH, measure="volume"), "measure: volume is none of hull, valley"),
    "tolerance": (lambda: pw.decompose(MESH, float("nan")), "tolerance: is not a positive number"),
    "file": (lambda: pw.read_mesh("nowhere.off"), "nowhere.off: does not exist"),
    "kind": (lambda: pw.feature(MESH, "curvature"), "kind: curvature is none of cvf, "),
    "smooth": (lambda: pw.feature(MESH, "sdf", smooth=-1), "smooth: is below 0"),
    "labels": (lambda: pw.write_labels("never.seg", [0.5]), "labels: holds float64"),
    "labels of 64 bits": (lambda: pw.write_labels("never.seg", [2**40]), "labels[0]: 1099511627776 is too large"),
    "ring": (lambda: pw.decompose_outline([[[[0, 0, 0]]]]), "shape[0][0]: has the shape 1 x 3; give an array k x 2"),
    "nesting": (lambda: pw.decompose_outline([np.zeros((3, 2))]), "shape[0]: is no list"),
    "crossing": (lambda: pw.decompose_outline([[[[0, 0], [1, 1], [1, 0], [0, 1]]]]), "shape: "),
    "hole": (lambda: pw.decompose_outline([[SQUARE, [[0, 0], [np.nan, 0], [1, 1]]]]), "shape[0][1][1]: holds nan"),
    "image": (lambda: pw.write_image("never.png", np.zeros((2, 2, 5))), "image: has the shape 2 x 2 x 5"),
    "empty image": (lambda: pw.tone_mapped(np.zeros((0, 2))), "image: has the shape 0 x 2"),
    "image of NaN": (lambda: pw.tone_mapped([[0, np.nan]]), "image[0]: holds nan"),
    "mask": (lambda: pw.tone_mapped(np.ones((2, 3, 3)), np.ones((3, 2))), "mask: is 3 x 2 x 1; give one that is 2 x 3"),
    "ending": (lambda: pw.write_image("never.gif", np.zeros((2, 2))), "never.gif: has an ending that is not known"),
    "name of a material": (lambda: pw.material("crome"), "material 'crome': is none"),
    "numbers of a material": (lambda: pw.Material([1, 2, 3]), "coefficients: has the shape 3"),
    "direction": (lambda: pw.material("chrome").evaluate([0, 0, 2], [0, 0, 1]), "to_light[0]: has the length 2"),
    "shape of directions": (lambda: pw.material("chrome").evaluate([[0, 1]], [0, 0, 1]), "to_light: has the shape 1 x 2"),
    "light": (lambda: pw.material_ball("chrome", light=np.zeros((4, 8))), "light: "),
    "labels of a mesh": (lambda: pw.render(MESH, "chrome", [0, 1]), "labels: has 2 labels for 1 faces"),
    "label below 0": (lambda: pw.render(MESH, "chrome", [-1]), "labels: are not all from 0"),
    "size": (lambda: pw.render(MESH, "chrome", size=(0, 5)), "size: is not from 1"),
    "depth": (lambda: pw.normals_from_depth(np.zeros((2, 2, 3)), 500), "depth: is no picture of depth"),
    "focal": (lambda: pw.normals_from_depth(np.ones((2, 2)), 0), "focal: is not above 0"),
    "normals": (lambda: pw.write_normals("never.png", np.zeros((2, 2))), "normals: has 1 channels"),
    "bits": (lambda: pw.write_normals("never.png", np.zeros((2, 2, 3)), bits=12), "bits: is 12"),
    "spacing": (lambda: pw.medial_samples(MESH, spacing=0), "spacing: is 0"),
    "angle": (lambda: pw.medial_samples(MESH, least_angle=float("nan")), "least_angle: is not from 0 to 180"),
    "faces of a cage": (lambda: pw.make_cage(MESH, max_faces=3), "max_faces: 3 faces enclose nothing"),
    "open cage": (lambda: pw.deform(MESH, MESH, MESH[0]), "cage: is not closed"),
    "outside of a cage": (lambda: pw.CageDeformer([[2, 2, 2]], SOLID), "mesh: vertex 0 is not inside"),
    "points": (lambda: pw.CageDeformer([[0, 0]], SOLID), "points: has the shape 1 x 2"),
    "coordinates": (lambda: pw.CageDeformer([INSIDE], SOLID, "harmonic"), "coordinates: harmonic is none of green"),
    "vertices of a cage": (lambda: pw.CageDeformer([INSIDE], SOLID).deformed(MESH[0]), "cage: 3 vertices are given for 4"),
    "moved to NaN": (lambda: pw.deform(MESH, SOLID, np.full((4, 3), np.nan)), "cage_vertices[0]: holds nan"),
    "moves": (lambda: pw.read_cage_moves("nowhere.json", SOLID), "nowhere.json: "),
    "tolerance of a repair": (lambda: pw.repair(MESH, tolerance=0.001), "tolerance: 0.001 is out of range"),
    "open reference": (lambda: pw.repair_loss(SOLID, MESH), "reference: is not watertight"),
    "open repair": (lambda: pw.repair_loss(MESH, SOLID), "repaired: is not watertight"),
    "tab": (lambda: pw.unfold(SOLID, tab=float("inf")), "tab: is below 0"),
    "nothing to unfold": (lambda: pw.unfold((MESH[0], np.zeros((0, 3), int))), "mesh: has no faces"),
    "face without area": (lambda: pw.unfold((MESH[0], [[0, 1, 1]])), "mesh: "),
    "nets": (lambda: pw.write_nets("never.svg", [SOLID]), "unfoldings[0]: is no Unfolding"),
    "no nets": (lambda: pw.write_nets("never.svg", []), "nets: there are none"),
    "ending of nets": (lambda: pw.write_nets("never.png", []), "never.png: has an ending that is not known"),
    "part": (lambda: pw.similar_parts(INDEX, 7, [INDEX]), "part: there is no part 7"),
    "parts": (lambda: pw.part_similarity(INDEX, 0, INDEX, -1), "part_b: is -1, there are 1"),
    "no index": (lambda: pw.similar_parts(INDEX, 0, [SOLID]), "indices[0]: is no PartIndex"),
    "folder": (lambda: pw.open_part_database("nowhere"), "nowhere: cannot be listed"),
    "space": (lambda: pw.Problem("se4", []), "space: se4 is none of plane, space, se2, se3"),
    "no obstacles": (lambda: pw.Problem("space", []), "obstacles: the world holds no obstacle"),
    "no list of meshes": (lambda: pw.Problem("space", SOLID[0]), "obstacles[0]: is no mesh"),
    "no robot": (lambda: pw.Problem("se3", [SOLID]), "robot: is missing"),
    "city for a body": (lambda: pw.Problem("se2", pw.City([[SQUARE]]), [SOLID]), "obstacles: are footprints"),
    "mesh for a point": (lambda: pw.Problem("plane", [SOLID]), "obstacles: are meshes"),
    "bounds": (lambda: in_space(bounds=[[0, 0], [1, 1]]), "bounds: has the shape 2 x 2; give an array 2 x 3"),
    "bounds upside down": (lambda: in_space(bounds=[[1] * 3, [0] * 3]), "bounds: the bounds run from 1 to 0"),
    "query of NaN": (lambda: in_space(queries=[([0, 0, np.nan], [1, 1, 1])]), "queries[0].start[2]: holds nan"),
    "query": (lambda: in_space(queries=[([0, 0], [1, 1, 1])]), "queries[0].start: has the shape 2"),
    "query outside": (lambda: in_space(queries=[([9, 9, 9], [1, 1, 1])]), "queries[0].start: the start at 9, 9, 9"),
    "quaternion": (lambda: pw.plan(BODY, ([0] * 7, [0] * 7)), "query.start: has a quaternion of length 0"),
    "prisms": (lambda: pw.prisms([[SQUARE]], 1, 0), "low, high: do not run upward"),
    "no problem": (lambda: pw.plan(SOLID), "problem: is no problem"),
    "number of a query": (lambda: pw.plan(FREE, 1), "query: is 1, the problem has 1"),
    "start outside": (lambda: pw.plan(FREE, ([9, 9, 9], [1, 1, 1])), "query.start: lies outside the bounds"),
    "start inside": (lambda: pw.plan(FREE, (INSIDE, [1, 1, 1])), "query: the robot touches an obstacle at the start"),
    "planner": (lambda: pw.plan(FREE, planner="rrt"), "planner: rrt is none of svma, maprm, umaprm"),
    "time": (lambda: pw.plan(FREE, time=float("nan")), "time: is not above 0"),
    "file of a problem": (lambda: pw.read_problem("nowhere.cfg"), "nowhere.cfg: "),
    "method": (lambda: pw.roadmap(MESH, method="prm"), "method: prm is none of svma, maprm, maprm-exact"),
    "material of an edit": (lambda: pw.edit("photo.png"), "material: one of material and other"),
}


@pytest.mark.parametrize("wrong, message", WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_said(wrong, message):
    with pytest.raises(pw.InputError) as raised:
        wrong()
    text = str(raised.value)
    assert text.startswith(message) and ";" in text and "\n" not in text, text


def test_errors_are_pythons_own_kinds():
    assert issubclass(pw.InputError, ValueError) and issubclass(pw.CheckFailed, RuntimeError)
    assert pw.InputError.__module__ == "partwise"


def test_words_that_no_function_has_are_type_errors():
    with pytest.raises(TypeError):
        pw.decompose(MESH, tolerence=0.1)


TOWN = pw.City([[SQUARE], [[[x + 3, y] for x, y in SQUARE]]])
# Where no path is: walls all around the goal.
FRAME = pw.City([[[[9 * x, 9 * y] for x, y in SQUARE], [[2 + 5 * x, 2 + 5 * y] for x, y in SQUARE]]])
WALLED = pw.Problem("plane", FRAME, bounds=[[-3, -3], [12, 12]], queries=[([-2, -2], [4, 4])])
LONG_WORK = {
    "roadmap": lambda: pw.roadmap(TOWN, samples=100_000_000),
    "plan": lambda: pw.plan(WALLED, planner="maprm", time=1e6),
}


@pytest.mark.parametrize("long_work", LONG_WORK.values(), ids=LONG_WORK.keys())
def test_ctrl_c_ends_long_calls(long_work):
    """Of work that takes much longer than any test waits."""
    main = threading.main_thread().ident
    threading.Timer(0.5, lambda: signal.pthread_kill(main, signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        long_work()
    assert time.monotonic() - start < 60
    assert len(pw.decompose(MESH)) == 1  # nothing is left stopped


def test_other_threads_go_on_meanwhile():
    """One turn of a loop in Python a millisecond, while the library works."""
    turns, done = 0, threading.Event()

    def work():
        pw.feature(pw.read_mesh(CHAIR), "cvf")
        pw.decompose(pw.read_mesh(NOTCH))
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    while not done.is_set():
        time.sleep(0.001)
        turns += 1
    worker.join()
    assert turns > 20
