// partwise.decompose: partwise::decompose with arrays.
#include <pybind11/stl.h>

#include <map>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/parts/solid/decompose.h"

namespace partwise::python {
namespace {

struct Parts {
  py::array labels, mesh_labels;
  py::list hulls;
  SharedMesh mesh;
  Decomposition rest;  // the numbers
};

Parts as_parts(Decomposition found, const SharedMesh& input) {
  Parts parts;
  for (Mesh& hull : found.hulls) parts.hulls.append(mesh_out(std::move(hull)));
  parts.labels = vector_out(std::move(found.labels));
  parts.mesh_labels = vector_out(std::move(found.mesh_labels));
  parts.mesh = found.cut_inside ? mesh_out(std::move(found.mesh)) : input;
  found.mesh = {};
  parts.rest = std::move(found);
  return parts;
}

Parts parts_of(const py::object& mesh, double tolerance, bool absolute, const std::string& measure, bool cup_repair,
               int max_hulls, int max_hull_vertices) {
  const SharedMesh input = mesh_in(mesh);
  const DecompositionSettings settings = {
      .tolerance = tolerance,
      .absolute = absolute,
      .measure = chosen<ConcavityMeasure>("measure", measure,
                                          {{"hull", ConcavityMeasure::hull}, {"valley", ConcavityMeasure::valley}}),
      .cup_repair = cup_repair,
      .max_hulls = max_hulls,
      .max_hull_vertices = max_hull_vertices};
  return as_parts(long_call([&](const Progress& progress) { return decompose(*input, settings, progress); }), input);
}

}  // namespace

void add_solid_parts(py::module_& core) {
  const auto number = [](auto Decomposition::*member) {
    return [member](const Parts& parts) { return parts.rest.*member; };
  };
  py::class_<Parts>(core, "Parts", "Nearly convex parts of a mesh, from decompose().")
      .def_readonly("labels", &Parts::labels, "The part of each face of the input, int32.")
      .def_readonly("hulls", &Parts::hulls, "A convex Mesh a part, which encloses it.")
      .def_readonly("mesh", &Parts::mesh, "What the parts are made of: the input, or the input with faces cut inside.")
      .def_readonly("mesh_labels", &Parts::mesh_labels, "The part of each face of `mesh`, int32.")
      .def_property_readonly("cut_inside", number(&Decomposition::cut_inside), "Whether faces were cut inside.")
      .def_property_readonly("radius", number(&Decomposition::radius), "Of the bounding sphere, model units.")
      .def_property_readonly("tolerance", number(&Decomposition::tolerance), "As asked for.")
      .def_property_readonly("concavity", number(&Decomposition::concavity),
                             "Upper bound of the largest of any part, in the unit of the tolerance.")
      .def_property_readonly("volume_ratio", number(&Decomposition::volume_ratio),
                             "Volume of the union of the hulls over that of the mesh; NaN for an open mesh.")
      .def_property_readonly("watertight", number(&Decomposition::watertight), "Whether the mesh is closed.")
      .def_property_readonly("seconds", number(&Decomposition::seconds), "Wall time by stage.")
      .def("__len__", [](const Parts& parts) { return parts.hulls.size(); });

  core.def("decompose", &parts_of, py::arg("mesh"), py::arg("tolerance") = 0.1, py::kw_only(),
           py::arg("absolute") = false, py::arg("measure") = "hull", py::arg("cup_repair") = false,
           py::arg("max_hulls") = 0, py::arg("max_hull_vertices") = 0,
           "Cuts a mesh into nearly convex parts, each with a convex hull that encloses it (docs/decompose.md).\n\n"
           "tolerance: largest concavity of a part, a share of the bounding sphere's radius; model units if absolute.\n"
           "measure: 'hull', no hull leaves the solid by more than the tolerance, or 'valley', as published.\n"
           "cup_repair: with 'valley', cups are cut as well.\n"
           "max_hulls, max_hull_vertices: 0 for no limit; `concavity` says what was reached.");
}

}  // namespace partwise::python
