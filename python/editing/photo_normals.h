// partwise.photo_normals: the normals of an object off one photo.
#pragma once

#include <pybind11/pybind11.h>

namespace partwise::python {

namespace py = pybind11;

void add_photo_normals(py::module_& editing);

}  // namespace partwise::python
