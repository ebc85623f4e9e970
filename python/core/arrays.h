// NumPy arrays from and to the library's types.
//
// In: anything that NumPy makes an array of. Real numbers become the library's by one copy (integers and float32 become
// float64); a wrong shape, numbers of another kind, and values that are not finite are InputErrors that name the
// argument. Out: the array takes over the memory of what is given, without a copy, and frees it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/imaging/image.h"

namespace partwise::python {

namespace py = pybind11;

// A sketch of the shape, a letter for a length of any size: "n x 3".
using Shape = std::vector<py::ssize_t>;  // -1: any length

using DoubleArray = py::array_t<double, py::array::c_style>;
using FloatArray = py::array_t<float, py::array::c_style>;
using LongArray = py::array_t<long long, py::array::c_style>;

// `name` is the argument that messages name; `what` its shape in words, "n x 3".
DoubleArray real_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what);
FloatArray float_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what);
LongArray whole_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what);

// A label for each face. Errors: also for labels beyond 32 bits.
std::vector<int> labels_in(const py::handle& given, const std::string& name);

// h x w or h x w x c, c from 1 to 4.
Image image_in(const py::handle& given, const std::string& name);
// h x w x c float32; one channel: h x w.
py::array image_out(Image image);

// A polygon is a list of its rings, k x 2 each: the outer one, then holes. A shape is a list of polygons.
Polygons polygons_in(const py::handle& given, const std::string& name);
py::list polygons_out(Polygons polygons);
py::list footprints_out(const std::vector<Polygons>& footprints);  // all of their polygons, copied

// A list or tuple, or another sequence that is no array and no text. `what` to give is said where it is none.
py::sequence list_in(const py::handle& given, const std::string& name, const char* what);

// Takes over the memory of a std::vector or of a row-major Eigen matrix.
template <typename Container>
py::array array_out(Container values, Shape shape) {
  using Value = std::remove_cvref_t<decltype(*values.data())>;
  auto* kept = new Container(std::move(values));
  const py::capsule owner(kept, [](void* held) { delete static_cast<Container*>(held); });
  return py::array_t<Value>(std::move(shape), kept->data(), owner);
}

template <typename Value>
py::array vector_out(std::vector<Value> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_out(std::move(values), {size});
}

// A view, which cannot be written to, of a matrix of Eigen's that `owner` holds.
template <typename Matrix>
py::array read_only_view(const Matrix& matrix, const py::object& owner) {
  using Value = typename Matrix::Scalar;
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Value));
  py::array_t<Value> view({matrix.rows(), matrix.cols()}, {size * matrix.rowStride(), size * matrix.colStride()},
                          matrix.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

// One row after the other, each of the same length, by one copy.
template <typename Rows>
py::array rows_out(const Rows& rows, py::ssize_t columns) {
  std::vector<double> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return array_out(std::move(values), {static_cast<py::ssize_t>(rows.size()), columns});
}

}  // namespace partwise::python
