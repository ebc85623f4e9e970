// partwise.make_cage, deform and repair: closed surfaces around a mesh from the hulls of its parts.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/parts/applications/cage.h"
#include "partwise/parts/applications/cage_deformer.h"
#include "partwise/parts/applications/cage_moves.h"
#include "partwise/parts/applications/repair.h"

namespace partwise::python {
namespace {

const Choices<CageCoordinates> coordinates = {{"green", CageCoordinates::green},
                                              {"mean-value", CageCoordinates::mean_value}};

Vertices points_in(const py::object& given, const std::string& name) {
  const DoubleArray points = real_array(given, name, {-1, 3}, "n x 3");
  return Eigen::Map<const Vertices>(points.data(), points.shape(0), 3);
}

py::array points_out(Vertices points) {
  const py::ssize_t rows = points.rows();
  return array_out(std::move(points), {rows, 3});
}

std::unique_ptr<CageDeformer> deformer_of(const py::object& given, const py::object& cage, const std::string& kind) {
  const Vertices points = points_in(given, "points");
  const SharedMesh closed = mesh_in(cage, "cage");
  const CageCoordinates chosen_kind = chosen("coordinates", kind, coordinates);
  return long_call(
      [&](const Progress& progress) { return std::make_unique<CageDeformer>(points, *closed, chosen_kind, progress); });
}

py::array deformed_points(const CageDeformer& deformer, const py::object& cage_vertices) {
  const Vertices moved = points_in(cage_vertices, "cage_vertices");
  return points_out(long_call([&](const Progress&) { return deformer.deformed(moved); }));
}

SharedMesh deformed_mesh(const py::object& given, const py::object& given_cage, const py::object& cage_vertices,
                         const std::string& kind) {
  const SharedMesh mesh = mesh_in(given), cage = mesh_in(given_cage, "cage");
  const Vertices moved = points_in(cage_vertices, "cage_vertices");
  const CageCoordinates chosen_kind = chosen("coordinates", kind, coordinates);
  return mesh_out(long_call([&](const Progress& progress) -> Mesh {
    return {CageDeformer(mesh->vertices, *cage, chosen_kind, progress).deformed(moved), mesh->faces};
  }));
}

// A result of the library, its mesh apart.
template <typename Result>
struct WithMesh {
  SharedMesh mesh;
  Result rest;
};

template <typename Result>
WithMesh<Result> with_mesh(Result found) {
  SharedMesh mesh = mesh_out(std::move(found.mesh));
  found.mesh = {};
  return {std::move(mesh), std::move(found)};
}

template <typename Result>
auto member_of(auto Result::*member) {
  return [member](const WithMesh<Result>& found) { return found.rest.*member; };
}

void add_cages(py::module_& core) {
  using CageOut = WithMesh<Cage>;
  py::class_<CageOut>(core, "Cage", "A coarse closed surface around a mesh, from make_cage().")
      .def_readonly("mesh", &CageOut::mesh, "Watertight, with all of the given mesh inside.")
      .def_property_readonly("parts", member_of(&Cage::parts), "Of the given mesh, which the cage follows.")
      .def_property_readonly("radius", member_of(&Cage::radius), "Of the bounding sphere, model units.")
      .def_property_readonly("expansion", member_of(&Cage::expansion), "That it took, a share of the radius.")
      .def_property_readonly("volume", member_of(&Cage::volume), "Enclosed, model units cubed.")
      .def_property_readonly("seconds", member_of(&Cage::seconds), "Wall time by stage.");
  core.def(
      "make_cage",
      [](const py::object& given, double tolerance, double expansion, int max_faces) {
        const SharedMesh mesh = mesh_in(given);
        const CageSettings settings = {.tolerance = tolerance, .expansion = expansion, .max_faces = max_faces};
        return with_mesh(long_call([&](const Progress& progress) { return make_cage(*mesh, settings, progress); }));
      },
      py::arg("mesh"), py::kw_only(), py::arg("tolerance") = 0.1, py::arg("expansion") = 0.04,
      py::arg("max_faces") = 300,
      "A coarse closed surface around a mesh, to deform it by (docs/cage.md).\n\n"
      "tolerance: largest concavity of the parts that the cage follows, a share of the bounding sphere's radius.\n"
      "expansion: how far the hulls of the parts are expanded, such a share: more closes wider gaps.");
}

void add_deformation(py::module_& core) {
  py::class_<CageDeformer>(core, "CageDeformer", "Points that follow the vertices of a cage, any number of times.")
      .def(py::init(&deformer_of), py::arg("points"), py::arg("cage"), py::arg("coordinates") = "green",
           "points: n x 3, strictly inside of the cage. cage: a closed mesh.\n"
           "coordinates: 'green' keeps the shape of details, 'mean-value' follows all affine maps.")
      .def("deformed", &deformed_points, py::arg("cage_vertices"),
           "Where the points go, n x 3 float64, when the cage's vertices go to cage_vertices, v x 3.")
      .def_property_readonly(
          "vertex_weights",
          [](const py::object& self) {
            return read_only_view(self.cast<const CageDeformer&>().vertex_weights(), self);
          },
          "n x v float64, a view that cannot be written to; rows sum to 1.")
      .def_property_readonly(
          "face_weights",
          [](const py::object& self) { return read_only_view(self.cast<const CageDeformer&>().face_weights(), self); },
          "n x f float64, model units, such a view; empty for 'mean-value'.");
  core.def("deform", &deformed_mesh, py::arg("mesh"), py::arg("cage"), py::arg("cage_vertices"), py::kw_only(),
           py::arg("coordinates") = "green",
           "The mesh when the vertices of the cage around it go to cage_vertices, v x 3 (docs/cage.md).\n\n"
           "coordinates: 'green' keeps the shape of details, 'mean-value' follows all affine maps.");
  core.def(
      "read_cage_moves",
      [](const std::filesystem::path& path, const py::object& cage) {
        const SharedMesh mesh = mesh_in(cage, "cage");
        return points_out(long_call([&](const Progress&) { return read_cage_moves(path, *mesh); }));
      },
      py::arg("path"), py::arg("cage"),
      "Where the vertices of the cage go, v x 3 float64, by a .json of handles (docs/cage.md).");
}

void add_repair(py::module_& core) {
  using RepairOut = WithMesh<Repair>;
  py::class_<RepairOut>(core, "Repair", "A watertight mesh from a broken one, from repair().")
      .def_readonly("mesh", &RepairOut::mesh, "Watertight, with all faces that were there inside.")
      .def_property_readonly("parts", member_of(&Repair::parts), "Whose hulls it is made of.")
      .def_property_readonly("radius", member_of(&Repair::radius), "Of the bounding sphere, model units.")
      .def_property_readonly("seal", member_of(&Repair::seal),
                             "Half the width of gaps that were sealed beyond the expansion, a share of the radius.")
      .def_property_readonly("reach", member_of(&Repair::reach),
                             "Largest distance from the given surface, a share of the radius; above the tolerance if "
                             "that is too small for what is missing.")
      .def_property_readonly("seconds", member_of(&Repair::seconds), "Wall time by stage.");
  core.def(
      "repair",
      [](const py::object& given, double tolerance, int max_faces) {
        const SharedMesh mesh = mesh_in(given);
        const RepairSettings settings = {.tolerance = tolerance, .max_faces = max_faces};
        return with_mesh(long_call([&](const Progress& progress) { return repair(*mesh, settings, progress); }));
      },
      py::arg("mesh"), py::kw_only(), py::arg("tolerance") = 0.1, py::arg("max_faces") = 20000,
      "A watertight mesh from one with holes or many faces missing (docs/repair.md).\n\n"
      "tolerance: how far the result may stray, a share of the bounding sphere's radius, at least 0.03.");

  py::class_<RepairLoss>(core, "RepairLoss", "How a repaired mesh differs from the intact one, from repair_loss().")
      .def_readonly("added", &RepairLoss::added, "How far it reaches from the intact surface, a share of the radius.")
      .def_readonly("lost", &RepairLoss::lost, "How far the intact surface reaches outside of it, such a share.")
      .def_readonly("volume_added", &RepairLoss::volume_added, "Outside of the intact solid, a share of its volume.")
      .def_readonly("volume_lost", &RepairLoss::volume_lost, "Of the intact solid outside of it, such a share.");
  core.def(
      "repair_loss",
      [](const py::object& repaired, const py::object& intact) {
        const SharedMesh ours = mesh_in(repaired, "repaired"), theirs = mesh_in(intact, "intact");
        return long_call([&](const Progress& progress) { return repair_loss(*ours, *theirs, progress); });
      },
      py::arg("repaired"), py::arg("reference"), "What was lost and added; both meshes have to be watertight.");
}

}  // namespace

void add_applications(py::module_& core) {
  add_cages(core);
  add_deformation(core);
  add_repair(core);
}

}  // namespace partwise::python
