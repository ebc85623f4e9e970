"""The type stubs say what there is: the same names, arguments, defaults and attributes; everything has a docstring."""

import ast
import inspect
import re

import partwise as pw
import partwise.editing
import pytest
from partwise import _core
from program import REPOSITORY

PACKAGE = REPOSITORY / "python" / "partwise"
STUB = {node.name: node for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body
        if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
PUBLIC = [name for name in dir(_core) if not name.startswith("_")]


def of_stub(function):
    """Names of arguments with their defaults as written, and how many come before the star."""
    given = function.args
    before = [argument.arg for argument in given.args if argument.arg != "self"]
    after = [argument.arg for argument in given.kwonlyargs]
    defaults = dict(zip(reversed(before), (ast.unparse(value) for value in reversed(given.defaults)), strict=False))
    defaults |= {name: ast.unparse(value) for name, value in zip(after, given.kw_defaults, strict=True) if value}
    return before, after, defaults


def of_docstring(text):
    """The same of the signature that pybind11 writes in the first line."""
    parsed = ast.parse("def " + re.sub(r"\bpartwise\.\w+\.|\bpartwise::\w+::", "", text.splitlines()[0]) + ": ...")
    return of_stub(parsed.body[0])


def test_names():
    helpers = {"HasMesh"}
    assert sorted(PUBLIC) == sorted(STUB.keys() - helpers)
    exported = {name for name in dir(pw) if not name.startswith("_")} - {"editing", "edit", "photo_normals", "scene_normals"}
    assert exported == set(PUBLIC)


@pytest.mark.parametrize("name", [name for name in PUBLIC if not inspect.isclass(getattr(_core, name))])
def test_functions(name):
    (before, after, defaults), real = of_stub(STUB[name]), of_docstring(getattr(_core, name).__doc__)
    assert (before, after) == real[:2]
    assert defaults.keys() == real[2].keys()
    for argument, value in defaults.items():
        assert value == "..." or ast.literal_eval(value) == ast.literal_eval(real[2][argument]), argument
    assert len(getattr(_core, name).__doc__.splitlines()) > 2, "no docstring"


@pytest.mark.parametrize("name", [name for name in PUBLIC if inspect.isclass(getattr(_core, name))])
def test_classes(name):
    real, special = getattr(_core, name), {"__init__", "__len__"}
    assert real.__doc__
    if issubclass(real, Exception):
        return
    members = {member for member in vars(real) if not member.startswith("_") or member in special}
    written = {node.name for node in STUB[name].body if isinstance(node, ast.FunctionDef)}
    assert members - {"__init__"} == written - {"__init__"}
    assert all(getattr(real, member).__doc__ for member in written)


@pytest.mark.parametrize("name", ["edit", "photo_normals", "scene_normals"])
def test_what_needs_libtorch(name):
    stub = ast.parse((PACKAGE / "editing.pyi").read_text())
    function = next(node for node in stub.body if isinstance(node, ast.FunctionDef) and node.name == name)
    before, after, defaults = of_stub(function)
    real = inspect.signature(getattr(partwise.editing, name)).parameters
    assert [*before, *after] == list(real)
    assert {name: ast.literal_eval(value) for name, value in defaults.items()} == {
        name: each.default for name, each in real.items() if each.default is not each.empty}
