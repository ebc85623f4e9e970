// What each file of the module partwise._core adds to it.
#pragma once

#include <pybind11/pybind11.h>

namespace partwise::python {

namespace py = pybind11;

void add_meshes(py::module_& core);
void add_solid_parts(py::module_& core);
void add_surface_parts(py::module_& core);
void add_applications(py::module_& core);
void add_nets(py::module_& core);
void add_retrieval(py::module_& core);
void add_outlines(py::module_& core);
void add_images(py::module_& core);
void add_materials(py::module_& core);
void add_rendering(py::module_& core);
void add_normals(py::module_& core);
void add_motion(py::module_& core);
void add_problems(py::module_& core);
void add_paths(py::module_& core);

}  // namespace partwise::python
