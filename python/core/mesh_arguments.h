// Meshes as arguments: partwise.Mesh, a pair of arrays, or whatever has the attributes vertices and faces.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise::python {

namespace py = pybind11;

// A mesh of Python's never changes, so that long calls may read it without the interpreter's lock.
using SharedMesh = std::shared_ptr<Mesh>;

// A Mesh as it is, without a copy; of arrays by one copy. Errors: InputError for arrays that are no mesh.
SharedMesh mesh_in(const py::handle& given, const std::string& name = "mesh");

// Of a list of them. Errors: also for what is no list.
std::vector<Mesh> meshes_in(const py::handle& given, const std::string& name);

// n x 3 vertices and m x 3 whole numbers below n.
SharedMesh mesh_of_arrays(const py::handle& vertices, const py::handle& faces);

inline SharedMesh mesh_out(Mesh mesh) { return std::make_shared<Mesh>(std::move(mesh)); }

}  // namespace partwise::python
