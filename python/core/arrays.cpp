#include "arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "partwise/base/error.h"

namespace partwise::python {
namespace {

std::string shape_of(const py::array& array) {
  std::string text;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    text += fmt::format("{}{}", axis == 0 ? "" : " x ", array.shape(axis));
  }
  return array.ndim() == 0 ? "no shape, a single value" : "the shape " + text;
}

bool fits(const py::array& array, const Shape& shape) {
  if (array.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    const py::ssize_t wanted = shape[static_cast<std::size_t>(axis)];
    if (wanted >= 0 && array.shape(axis) != wanted) return false;
  }
  return true;
}

// An array of numbers of one of the kinds (NumPy's letters) and of at most 64 bits.
py::array numbers(const py::handle& given, const std::string& name, std::string_view kinds, const char* wanted) {
  const py::array array = py::array::ensure(given);
  if (!array) throw InputError(name, "is no array", fmt::format("give {}", wanted));
  if (kinds.find(array.dtype().kind()) == std::string_view::npos || array.itemsize() > 8) {
    throw InputError(name, fmt::format("holds {}", py::str(array.dtype()).cast<std::string>()),
                     fmt::format("give {}", wanted));
  }
  return array;
}

template <typename Array>
Array converted(const py::array& array) {
  Array result = Array::ensure(array.attr("astype")(py::dtype::of<typename Array::value_type>(), "C"));
  if (!result) throw py::error_already_set();
  return result;
}

template <typename Array>
Array finite_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what) {
  const py::array array = numbers(given, name, "fiu", "real numbers");
  if (!fits(array, shape)) {
    throw InputError(name, fmt::format("has {}", shape_of(array)), fmt::format("give an array {}", what));
  }
  Array result = converted<Array>(array);
  const auto* values = result.data();
  for (py::ssize_t i = 0; i < result.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const py::ssize_t row = result.ndim() > 1 ? i / (result.size() / result.shape(0)) : i;
    throw InputError(fmt::format("{}[{}]", name, row), fmt::format("holds {}", values[i]), "give finite numbers");
  }
  return result;
}

Ring ring_in(const py::handle& given, const std::string& name) {
  const DoubleArray array = real_array(given, name, {-1, 2}, "k x 2");
  return Eigen::Map<const Ring>(array.data(), array.shape(0), 2);
}

py::array ring_out(Ring ring) {
  const py::ssize_t rows = ring.rows();
  return array_out(std::move(ring), {rows, 2});
}

}  // namespace

DoubleArray real_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what) {
  return finite_array<DoubleArray>(given, name, shape, what);
}

FloatArray float_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what) {
  return finite_array<FloatArray>(given, name, shape, what);
}

LongArray whole_array(const py::handle& given, const std::string& name, const Shape& shape, const char* what) {
  const py::array array = numbers(given, name, "iu", "whole numbers");
  if (!fits(array, shape)) {
    throw InputError(name, fmt::format("has {}", shape_of(array)), fmt::format("give an array {}", what));
  }
  return converted<LongArray>(array);
}

std::vector<int> labels_in(const py::handle& given, const std::string& name) {
  const LongArray array = whole_array(given, name, {-1}, "with a number for each face");
  std::vector<int> labels;
  labels.reserve(static_cast<std::size_t>(array.size()));
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const long long label = array.data()[i];
    if (label < std::numeric_limits<int>::min() || label > std::numeric_limits<int>::max()) {
      throw InputError(fmt::format("{}[{}]", name, i), fmt::format("{} is too large", label), "use labels of 32 bits");
    }
    labels.push_back(static_cast<int>(label));
  }
  return labels;
}

Image image_in(const py::handle& given, const std::string& name) {
  constexpr const char* what = "h x w or h x w x c, with 1 to 4 channels";
  const py::array array = numbers(given, name, "fiu", "real numbers");
  const FloatArray pixels =
      array.ndim() == 2 ? float_array(array, name, {-1, -1}, what) : float_array(array, name, {-1, -1, -1}, what);
  const py::ssize_t channels = pixels.ndim() == 2 ? 1 : pixels.shape(2);
  if (pixels.size() == 0 || channels > 4) {
    throw InputError(name, fmt::format("has {}", shape_of(pixels)), fmt::format("give an array {}", what));
  }
  Image image(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), static_cast<int>(channels));
  image.values.assign(pixels.data(), pixels.data() + pixels.size());
  return image;
}

py::array image_out(Image image) {
  Shape shape = {image.height, image.width};
  if (image.channels > 1) shape.push_back(image.channels);
  return array_out(std::move(image.values), std::move(shape));
}

Polygons polygons_in(const py::handle& given, const std::string& name) {
  Polygons polygons;
  for (const py::handle& each : list_in(given, name, "a list of polygons, each a list of rings")) {
    const std::string place = fmt::format("{}[{}]", name, polygons.size());
    Polygon polygon;
    int count = 0;
    for (const py::handle& ring : list_in(each, place, "a list of rings, the outer one and then holes")) {
      const std::string place_of_ring = fmt::format("{}[{}]", place, count);
      (count == 0 ? polygon.outer : polygon.holes.emplace_back()) = ring_in(ring, place_of_ring);
      ++count;
    }
    if (count == 0) throw InputError(place, "has no ring", "give its outer ring");
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

py::sequence list_in(const py::handle& given, const std::string& name, const char* what) {
  if (!py::isinstance<py::sequence>(given) || py::isinstance<py::str>(given) || py::isinstance<py::array>(given)) {
    throw InputError(name, "is no list", fmt::format("give {}", what));
  }
  return py::reinterpret_borrow<py::sequence>(given);
}

py::list polygons_out(Polygons polygons) {
  py::list result;
  for (Polygon& polygon : polygons) {
    py::list rings;
    rings.append(ring_out(std::move(polygon.outer)));
    for (Ring& hole : polygon.holes) rings.append(ring_out(std::move(hole)));
    result.append(rings);
  }
  return result;
}

py::list footprints_out(const std::vector<Polygons>& footprints) {
  py::list result;
  for (const Polygons& each : footprints) {
    for (const py::handle& polygon : polygons_out(each)) result.append(polygon);
  }
  return result;
}

}  // namespace partwise::python
