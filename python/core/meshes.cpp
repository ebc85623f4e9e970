// partwise.Mesh, and meshes and labels from and to files.
#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/appearance/palette.h"
#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise::python {
namespace {

// As partwise decompose --hulls names and colours them.
void write_as_parts(const std::filesystem::path& path, const py::object& meshes) {
  std::vector<NamedMesh> parts;
  for (Mesh& mesh : meshes_in(meshes, "meshes")) {
    const auto number = static_cast<int>(parts.size());
    parts.push_back({fmt::format("part_{}", number), std::move(mesh), part_colour(number)});
  }
  const py::gil_scoped_release released;
  write_meshes(path, parts);
}

}  // namespace

SharedMesh mesh_of_arrays(const py::handle& vertices, const py::handle& faces) {
  const DoubleArray points = real_array(vertices, "vertices", {-1, 3}, "n x 3");
  const LongArray corners = whole_array(faces, "faces", {-1, 3}, "m x 3");
  for (py::ssize_t i = 0; i < corners.size(); ++i) {
    const long long vertex = corners.data()[i];
    if (vertex >= 0 && vertex < points.shape(0)) continue;
    throw InputError(fmt::format("faces[{}]", i / 3),
                     fmt::format("names vertex {}, there are {}", vertex, points.shape(0)), "count vertices from 0");
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = Eigen::Map<const Vertices>(points.data(), points.shape(0), 3);
  using LongFaces = Eigen::Matrix<long long, Eigen::Dynamic, 3, Eigen::RowMajor>;
  mesh->faces = Eigen::Map<const LongFaces>(corners.data(), corners.shape(0), 3).cast<int>();
  return mesh;
}

SharedMesh mesh_in(const py::handle& given, const std::string& name) {
  if (py::isinstance<Mesh>(given)) return given.cast<SharedMesh>();
  if (py::hasattr(given, "vertices") && py::hasattr(given, "faces")) {
    return mesh_of_arrays(given.attr("vertices"), given.attr("faces"));
  }
  if ((py::isinstance<py::tuple>(given) || py::isinstance<py::list>(given)) && py::len(given) == 2) {
    const auto pair = py::reinterpret_borrow<py::sequence>(given);
    return mesh_of_arrays(pair[0], pair[1]);
  }
  throw InputError(name, "is no mesh", "give a partwise.Mesh, or a pair (vertices, faces)");
}

std::vector<Mesh> meshes_in(const py::handle& given, const std::string& name) {
  std::vector<Mesh> meshes;
  for (const py::handle& each : list_in(given, name, "a list of meshes"))
    meshes.push_back(*mesh_in(each, fmt::format("{}[{}]", name, meshes.size())));
  return meshes;
}

void add_meshes(py::module_& core) {
  py::class_<Mesh, SharedMesh>(core, "Mesh", "A triangle mesh that never changes.")
      .def(py::init(&mesh_of_arrays), py::arg("vertices"), py::arg("faces"),
           "Copies vertices, n x 3, and faces, m x 3 indices from 0, counter-clockwise from outside.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return read_only_view(self.cast<const Mesh&>().vertices, self); },
          "n x 3 float64, a view that cannot be written to and keeps the mesh alive.")
      .def_property_readonly(
          "faces", [](const py::object& self) { return read_only_view(self.cast<const Mesh&>().faces, self); },
          "m x 3 int32, such a view.")
      .def("__repr__", [](const Mesh& mesh) {
        return fmt::format("<partwise.Mesh of {} vertices, {} faces>", mesh.vertices.rows(), mesh.faces.rows());
      });

  core.def(
      "read_mesh",
      [](const std::filesystem::path& path) {
        return long_call([&](const Progress&) { return mesh_out(read_mesh(path)); });
      },
      py::arg("path"), "The mesh of a file: .off, .obj, .ply, .stl, .g, .gltf or .glb (docs/formats.md).");
  core.def(
      "write_mesh",
      [](const std::filesystem::path& path, const py::object& mesh) {
        const SharedMesh held = mesh_in(mesh);
        const py::gil_scoped_release released;
        write_mesh(path, *held);
      },
      py::arg("path"), py::arg("mesh"), "Writes .off, .obj, .ply, .stl or .glb, the first three to the bit.");
  core.def("write_meshes", &write_as_parts, py::arg("path"), py::arg("meshes"),
           "Writes all into one file, in .obj and .glb as objects part_0, part_1 ... (in .glb coloured); of hulls the "
           "bytes of `partwise decompose --hulls`.");
  core.def(
      "read_labels", [](const std::filesystem::path& path) { return vector_out(read_labels(path)); }, py::arg("path"),
      "The labels of a .seg file, int32, one a face.");
  core.def(
      "write_labels",
      [](const std::filesystem::path& path, const py::object& labels) {
        write_labels(path, labels_in(labels, "labels"));
      },
      py::arg("path"), py::arg("labels"), "Writes a .seg file, a line a face.");
}

}  // namespace partwise::python
