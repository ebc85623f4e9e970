// partwise.decompose_outline: shapes in the plane, as lists of polygons.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "partwise/parts/planar/outline.h"
#include "partwise/parts/planar/read_shape.h"
#include "partwise/parts/planar/skeleton.h"

namespace partwise::python {
namespace {

struct OutlineParts {
  py::list parts, holes;
  py::array cuts, cut_parts, skeleton_nodes, skeleton_edges;
  double tolerance = 0, concavity = 0, radius = 0;
  int unresolved = 0;
};

OutlineParts as_parts(Outline found) {
  OutlineParts result;
  const Skeleton skeleton = extract_skeleton(found);
  std::vector<double> cuts, nodes;
  std::vector<int> beside, edges;
  for (const OutlineCut& cut : found.cuts) {
    cuts.insert(cuts.end(), {cut.a.x(), cut.a.y(), cut.b.x(), cut.b.y()});
    beside.insert(beside.end(), {cut.left, cut.right});
  }
  for (const SkeletonNode& node : skeleton.nodes) nodes.insert(nodes.end(), {node.at.x(), node.at.y()});
  for (const auto& [a, b] : skeleton.edges) edges.insert(edges.end(), {a, b});
  const auto count = static_cast<py::ssize_t>(found.cuts.size());
  result.cuts = array_out(std::move(cuts), {count, 2, 2});
  result.cut_parts = array_out(std::move(beside), {count, 2});
  result.skeleton_nodes = array_out(std::move(nodes), {static_cast<py::ssize_t>(skeleton.nodes.size()), 2});
  result.skeleton_edges = array_out(std::move(edges), {static_cast<py::ssize_t>(skeleton.edges.size()), 2});
  for (const OutlineHole& hole : found.holes) {
    result.holes.append(py::make_tuple(hole.polygon, hole.index, hole.concavity, hole.noise));
  }
  result.parts = polygons_out(std::move(found.parts));
  result.tolerance = found.tolerance;
  result.concavity = found.concavity;
  result.radius = found.radius;
  result.unresolved = found.unresolved;
  return result;
}

OutlineParts parts_of(const py::object& shape, double tolerance, bool absolute) {
  const Polygons given = polygons_in(shape, "shape");
  return as_parts(long_call([&](const Progress& progress) {
    const Polygons valid = valid_polygons(given, false, "shape").polygons;
    return decompose_outline(valid, {.tolerance = tolerance, .absolute = absolute}, progress);
  }));
}

}  // namespace

void add_outlines(py::module_& core) {
  core.def(
      "read_shape",
      [](const std::filesystem::path& path, bool repair) {
        return polygons_out(long_call([&](const Progress&) { return read_shape(path, {.repair = repair}).polygons; }));
      },
      py::arg("path"), py::kw_only(), py::arg("repair") = true,
      "The polygons of a .poly, .svg, .geojson, .wkt or of a mask .png (docs/formats.md).\n\n"
      "repair: make shapes valid that are not; else they are refused.");
  core.def(
      "repaired_shape",
      [](const py::object& shape) {
        const Polygons given = polygons_in(shape, "shape");
        return polygons_out(long_call([&](const Progress&) { return valid_polygons(given, true, "shape").polygons; }));
      },
      py::arg("shape"), "The same shape as valid polygons: what is enclosed stays filled, overlaps are joined.");

  py::class_<OutlineParts>(core, "OutlineParts", "Nearly convex parts of a shape, from decompose_outline().")
      .def_readonly("parts", &OutlineParts::parts, "A polygon a part: a list of rings, the outer one, then holes.")
      .def_readonly("cuts", &OutlineParts::cuts, "c x 2 x 2 float64, the two ends of each cut.")
      .def_readonly("cut_parts", &OutlineParts::cut_parts, "c x 2 int32, the parts left and right of each cut.")
      .def_readonly("holes", &OutlineParts::holes,
                    "Of each hole a tuple: its polygon, its number there, its concavity, whether it is noise.")
      .def_readonly("skeleton_nodes", &OutlineParts::skeleton_nodes,
                    "n x 2 float64; the first are the parts, in order.")
      .def_readonly("skeleton_edges", &OutlineParts::skeleton_edges, "e x 2 int32, indices of nodes.")
      .def_readonly("tolerance", &OutlineParts::tolerance, "As asked for.")
      .def_readonly("concavity", &OutlineParts::concavity, "The largest of any part, in the unit of the tolerance.")
      .def_readonly("radius", &OutlineParts::radius, "Of the smallest circle around the shape.")
      .def_readonly("unresolved", &OutlineParts::unresolved, "Features that were cut without a resolver.")
      .def("__len__", [](const OutlineParts& outline) { return outline.parts.size(); });
  core.def("decompose_outline", &parts_of, py::arg("shape"), py::arg("tolerance") = 0.05, py::kw_only(),
           py::arg("absolute") = false,
           "Cuts a shape in the plane into nearly convex parts that tile it (docs/outline.md).\n\n"
           "shape: a list of polygons, each a list of rings (k x 2 arrays): the outer one, then holes.\n"
           "tolerance: largest concavity of a part, a share of the radius of the shape's smallest circle; in the "
           "units of the shape if absolute.");
}

}  // namespace partwise::python
