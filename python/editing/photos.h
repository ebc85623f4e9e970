// Photos as arguments: a file, or an array of values as they are shown.
#pragma once

#include <pybind11/pybind11.h>

#include "partwise/editing/photo.h"

namespace partwise::python {

namespace py = pybind11;

// A file with masks in files, as partwise edit reads them; or an array, h x w x 3 or 4, uint8 or real numbers 0 to 1,
// with masks h x w, bright where the region is. Without masks an array's fourth channel says where the object is.
// Errors: those of read_photo; InputError for an array without masks and transparency.
Photo photo_in(const py::object& given, const py::object& masks);

// A picture that is looked at whole: a file, or an array of values as they are shown, h x w x 3.
Image shown_in_whole(const py::object& given);

}  // namespace partwise::python
