// partwise.index_parts and similar_parts: parts like a given one, of other meshes.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/parts/surface/part_database.h"

namespace partwise::python {
namespace {

using IntegerColumn = Eigen::Map<const Eigen::VectorXi>;

// A column as it is in memory, of one dimension.
py::array column_view(const std::vector<int>& values, const py::object& owner) {
  const IntegerColumn column(values.data(), static_cast<Eigen::Index>(values.size()));
  return read_only_view(column, owner).attr("reshape")(-1);
}

// An index of Python's never changes, so that long calls may read it without the interpreter's lock.
using SharedIndex = std::shared_ptr<PartIndex>;

struct Database {
  std::vector<std::string> files;
  std::vector<SharedIndex> indices;
  std::vector<std::pair<std::string, std::string>> skipped;
  int indexed = 0;
};

Database opened(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& cache) {
  PartDatabase found =
      long_call([&](const Progress& progress) { return open_part_database(folder, cache.value_or(""), progress); });
  Database database;
  for (DatabaseMesh& mesh : found.meshes) {
    database.files.push_back(mesh.file.string());
    database.indices.push_back(std::make_shared<PartIndex>(std::move(mesh.index)));
  }
  for (const auto& [file, reason] : found.skipped) database.skipped.emplace_back(file.string(), reason);
  database.indexed = found.indexed;
  return database;
}

SharedIndex index_in(const py::handle& given, const std::string& name) {
  if (py::isinstance<PartIndex>(given)) return given.cast<SharedIndex>();
  throw InputError(name, "is no PartIndex", "give what index_parts() or open_part_database() made");
}

double similarity(const py::object& a, int part_a, const py::object& b, int part_b) {
  const SharedIndex first = index_in(a, "a"), second = index_in(b, "b");
  const auto expect_part = [](const PartIndex& index, int part, const char* name) {
    const int parts = index.hierarchy.parts;
    if (part < 0 || part >= parts) {
      throw InputError(name, fmt::format("is {}, there are {}", part, parts), "count parts from 0");
    }
  };
  expect_part(*first, part_a, "part_a");
  expect_part(*second, part_b, "part_b");
  return long_call(
      [&](const Progress&) { return part_similarity(first->hierarchy, part_a, second->hierarchy, part_b); });
}

std::vector<std::tuple<int, int, double>> matches(const py::object& query, int part, const py::object& indices,
                                                  int count) {
  const SharedIndex wanted = index_in(query, "query");
  if (count < 1) throw InputError("count", "is less than 1", "give how many parts to find");
  std::vector<SharedIndex> kept;
  std::vector<const PartIndex*> searched;
  for (const py::handle& each : list_in(indices, "indices", "a list, the indices of a PartDatabase for example")) {
    kept.push_back(index_in(each, fmt::format("indices[{}]", kept.size())));
    searched.push_back(kept.back().get());
  }
  std::vector<std::tuple<int, int, double>> result;
  for (const PartMatch& match :
       long_call([&](const Progress&) { return similar_parts(*wanted, part, searched, count); })) {
    result.emplace_back(match.mesh, match.part, match.similarity);
  }
  return result;
}

}  // namespace

void add_retrieval(py::module_& core) {
  py::class_<PartIndex, SharedIndex>(core, "PartIndex", "All that is kept of a mesh to find parts like others.")
      .def_property_readonly(
          "labels", [](const py::object& self) { return column_view(self.cast<const PartIndex&>().labels, self); },
          "The part of each face, int32, as segment() gives them; a view that cannot be written to.")
      .def_property_readonly(
          "parents",
          [](const py::object& self) { return column_view(self.cast<const PartIndex&>().hierarchy.parents, self); },
          "int32, the node that each node belongs to; parts come first, -1 for the whole, which is the last.")
      .def_property_readonly(
          "histograms",
          [](const py::object& self) {
            return read_only_view(self.cast<const PartIndex&>().hierarchy.histograms, self);
          },
          "nodes x 288 float64, what the surface of each is like; rows sum to its share of the area.")
      .def("__len__", [](const PartIndex& index) { return index.hierarchy.parts; });
  core.def(
      "index_parts",
      [](const py::object& given) {
        const SharedMesh mesh = mesh_in(given);
        return long_call(
            [&](const Progress& progress) { return std::make_shared<PartIndex>(index_parts(*mesh, progress)); });
      },
      py::arg("mesh"), "The parts of a mesh, with what they belong to, ready to be compared (docs/retrieve.md).");
  core.def("part_similarity", &similarity, py::arg("a"), py::arg("part_a"), py::arg("b"), py::arg("part_b"),
           "How alike two parts of two PartIndex are with what they belong to: 0 to 1, which is the same.");
  core.def("similar_parts", &matches, py::arg("query"), py::arg("part"), py::arg("indices"), py::arg("count") = 9,
           "The parts most like a part of a PartIndex, best first: tuples (which of the indices, part, similarity).");

  py::class_<Database>(core, "PartDatabase", "The meshes of a folder, indexed, from open_part_database().")
      .def_readonly("files", &Database::files, "Below the folder, by name.")
      .def_readonly("indices", &Database::indices, "A PartIndex each.")
      .def_readonly("skipped", &Database::skipped, "Files that were left out, as pairs (file, reason).")
      .def_readonly("indexed", &Database::indexed, "How many had no index that could be used.")
      .def("__len__", [](const Database& database) { return database.indices.size(); });
  core.def("open_part_database", &opened, py::arg("folder"), py::kw_only(), py::arg("cache") = py::none(),
           "Indexes each mesh of a folder once and keeps its index, as `partwise retrieve` does (docs/retrieve.md).\n\n"
           "cache: the folder that indices are kept in; left out, .partwise in the folder.");
}

}  // namespace partwise::python
