#include "lights.h"

#include <string>

#include "arrays.h"

namespace partwise::python {

EnvironmentLight light_in(const py::handle& given) {
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__")) {
    const auto name = py::str(given).cast<std::string>();
    const py::gil_scoped_release released;
    return named_light(name);
  }
  return EnvironmentLight(image_in(given, "light"));
}

}  // namespace partwise::python
