// Lights as arguments: a shipped one by its name, a file, or an equirectangular map of linear radiance.
#pragma once

#include <pybind11/pybind11.h>

#include "partwise/appearance/rendering/environment_light.h"

namespace partwise::python {

namespace py = pybind11;

// Errors: InputError for what is none of these.
EnvironmentLight light_in(const py::handle& given);

}  // namespace partwise::python
