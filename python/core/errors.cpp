#include "errors.h"

#include <string>

#include "partwise/base/error.h"

namespace partwise::python {
namespace {

// Of the one Python that the module lives in; never released, as errors may come until its very end.
PyObject* input_error = nullptr;
PyObject* check_failed = nullptr;

void add_error(py::module_& core, const char* name, PyObject* base, const char* about) {
  const std::string full = "partwise." + std::string(name);
  const auto error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(full.c_str(), about, base, nullptr));
  if (!error) throw py::error_already_set();
  core.attr(name) = error;
}

}  // namespace

void add_errors(py::module_& core) {
  add_error(core, "InputError", PyExc_ValueError,
            "A file, an array or a setting cannot be used. The message says where, what is wrong and what to do.");
  add_error(core, "CheckFailed", PyExc_RuntimeError,
            "A promise that the library makes to itself does not hold: a mistake in partwise.");
}

void translate_errors(const py::module_& core) {
  input_error = py::object(core.attr("InputError")).release().ptr();
  check_failed = py::object(core.attr("CheckFailed")).release().ptr();
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      PyErr_SetString(input_error, error.what());
    } catch (const CheckFailed& error) {
      PyErr_SetString(check_failed, error.what());
    }
  });
}

}  // namespace partwise::python
