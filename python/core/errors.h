// The library's errors as Python's exceptions of the same names: InputError, which is a ValueError, and CheckFailed, a
// RuntimeError. Cancelled is no exception of Python's: what cancels is Ctrl-C, which is KeyboardInterrupt
// (long_call.h).
#pragma once

#include <pybind11/pybind11.h>

namespace partwise::python {

namespace py = pybind11;

// Makes the classes, once, in partwise._core.
void add_errors(py::module_& core);

// What the calling extension module throws is raised as the classes of `core`. Once in each module.
void translate_errors(const py::module_& core);

}  // namespace partwise::python
