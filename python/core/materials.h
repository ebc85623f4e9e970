// partwise.Material: how a surface reflects light, by a fit of 108 numbers or as it was measured.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "partwise/appearance/material/brdf.h"

namespace partwise::python {

namespace py = pybind11;

struct Material {
  std::string name;
  std::shared_ptr<const Brdf> brdf;
  std::optional<double> log_rmse;  // of a fit that was made here
};

// A Material as it is, or one by its name or file. Errors: those of find_material.
Material material_in(const py::handle& given, const std::string& name);

}  // namespace partwise::python
