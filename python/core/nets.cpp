// partwise.unfold: surfaces as nets in the plane, and sheets of them to print.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/base/atomic_file.h"
#include "partwise/parts/applications/net.h"
#include "partwise/parts/applications/net_sheets.h"

namespace partwise::python {
namespace {

// The faces of all nets one after the other, and their cut sides.
struct UnfoldingArrays {
  Unfolding whole;
  double refolding_error = 0;
  py::array nets, faces, parents, folds, angles, corners, cuts, tabs;
};

void append(std::vector<double>& values, const Eigen::Vector2d& point) {
  values.insert(values.end(), {point.x(), point.y()});
}

UnfoldingArrays as_arrays(Unfolding found, double refolding_error) {
  std::vector<int> nets, faces, parents, folds, cuts;
  std::vector<double> angles, corners, tabs;
  for (std::size_t n = 0; n < found.nets.size(); ++n) {
    const int first = static_cast<int>(faces.size());  // of the net, among the faces of all
    for (const NetFace& face : found.nets[n].faces) {
      nets.push_back(static_cast<int>(n));
      faces.push_back(face.face);
      parents.push_back(face.parent < 0 ? -1 : first + face.parent);
      folds.push_back(face.fold);
      angles.push_back(face.angle);
      for (const Eigen::Vector2d& corner : face.corners) append(corners, corner);
    }
    for (const NetEdge& cut : found.nets[n].cuts) {
      cuts.insert(cuts.end(), {first + cut.net_face, cut.side, cut.number});
      for (const Eigen::Vector2d& corner : cut.tab) append(tabs, corner);
      if (cut.tab.empty()) tabs.insert(tabs.end(), 8, std::numeric_limits<double>::quiet_NaN());
    }
  }
  const auto count = static_cast<py::ssize_t>(faces.size()), cut_count = static_cast<py::ssize_t>(cuts.size() / 3);
  return {.whole = std::move(found),
          .refolding_error = refolding_error,
          .nets = vector_out(std::move(nets)),
          .faces = vector_out(std::move(faces)),
          .parents = vector_out(std::move(parents)),
          .folds = vector_out(std::move(folds)),
          .angles = vector_out(std::move(angles)),
          .corners = array_out(std::move(corners), {count, 3, 2}),
          .cuts = array_out(std::move(cuts), {cut_count, 3}),
          .tabs = array_out(std::move(tabs), {cut_count, 4, 2})};
}

UnfoldingArrays unfolded(const py::object& given, double tab, int directions) {
  const SharedMesh mesh = mesh_in(given);
  if (mesh->faces.rows() == 0) throw InputError("mesh", "has no faces", "give at least one");
  if (!(std::isfinite(tab) && tab >= 0)) throw InputError("tab", "is below 0", "0.15 is usual");
  if (directions < 1) throw InputError("directions", "is less than 1", "60 are usual");
  auto [found, error] = long_call([&](const Progress& progress) {
    Unfolding unfolding = unfold(*mesh, {.tab = tab, .directions = directions}, progress);
    const double refolding = refolding_error(unfolding, *mesh);
    return std::pair(std::move(unfolding), refolding);
  });
  return as_arrays(std::move(found), error);
}

std::pair<int, double> write_nets(const std::filesystem::path& path, const py::object& given, double scale) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".svg" && ending != ".pdf") {
    throw InputError(path.string(), "has an ending that is not known", "write .svg or .pdf");
  }
  if (!(std::isfinite(scale) && scale >= 0)) throw InputError("scale", "is below 0", "give millimetres a unit, or 0");
  std::vector<Unfolding> unfoldings;
  for (const py::handle& each : list_in(given, "unfoldings", "a list of what unfold() made")) {
    if (!py::isinstance<UnfoldingArrays>(each)) {
      throw InputError(fmt::format("unfoldings[{}]", unfoldings.size()), "is no Unfolding", "give what unfold() made");
    }
    unfoldings.push_back(each.cast<const UnfoldingArrays&>().whole);
  }
  return long_call([&](const Progress&) {
    const Sheets sheets = lay_out(unfoldings, {.scale = scale});
    write_file(path, ending == ".svg" ? as_svg(sheets) : as_pdf(sheets));
    return std::pair(sheets.pages, sheets.scale);
  });
}

}  // namespace

void add_nets(py::module_& core) {
  const auto number = [](auto Unfolding::*member) {
    return [member](const UnfoldingArrays& unfolding) { return unfolding.whole.*member; };
  };
  py::class_<UnfoldingArrays>(core, "Unfolding", "A surface in the plane, one net or several, from unfold().")
      .def_readonly("nets", &UnfoldingArrays::nets, "The net that each unfolded face is of, m int32.")
      .def_readonly("faces", &UnfoldingArrays::faces, "Which face of the mesh each one is, m int32.")
      .def_readonly("parents", &UnfoldingArrays::parents,
                    "m int32, the unfolded face that each one hangs from, which comes before it; -1 for the first of a "
                    "net.")
      .def_readonly("folds", &UnfoldingArrays::folds,
                    "m int32, the corner where the side to the parent starts; -1 for the first of a net.")
      .def_readonly("angles", &UnfoldingArrays::angles,
                    "m float64, radians by which each folds up from its parent's plane: positive at ridges.")
      .def_readonly("corners", &UnfoldingArrays::corners,
                    "m x 3 x 2 float64, model units, counter-clockwise with the outside of the surface up.")
      .def_readonly("cuts", &UnfoldingArrays::cuts,
                    "c x 3 int32: an unfolded face, the side from that corner to the next, and a number that the two "
                    "sides share which are glued together; -1 on a border.")
      .def_readonly("tabs", &UnfoldingArrays::tabs, "c x 4 x 2 float64, the tab on each cut side; NaN for none.")
      .def_property_readonly("overlaps", number(&Unfolding::overlaps), "Pairs of faces that overlap: 0.")
      .def_property_readonly("glued", number(&Unfolding::glued), "Pairs of sides to be glued.")
      .def_property_readonly("without_tab", number(&Unfolding::without_tab), "Such pairs that had no room for a tab.")
      .def_readonly("refolding_error", &UnfoldingArrays::refolding_error,
                    "How far the nets folded up are from the mesh, a share of the bounding sphere's radius.")
      .def("__len__", [](const UnfoldingArrays& unfolding) { return unfolding.whole.nets.size(); });
  core.def("unfold", &unfolded, py::arg("mesh"), py::kw_only(), py::arg("tab") = UnfoldSettings().tab,
           py::arg("directions") = UnfoldSettings().directions,
           "A surface unfolded into the plane, faces that do not overlap (docs/unfold.md).\n\n"
           "tab: height of tabs, a share of the mean length of edges. directions: tried for a single net.");
  core.def("write_nets", &write_nets, py::arg("path"), py::arg("unfoldings"), py::kw_only(), py::arg("scale") = 0.0,
           "Writes nets on A4 pages, .svg or .pdf; returns how many pages, and millimetres a model unit.\n\n"
           "unfoldings: of the hulls of decompose(mesh, max_hull_vertices=32) the bytes of `partwise unfold`.\n"
           "scale: millimetres a model unit; 0, as large as the largest net fits.");
}

}  // namespace partwise::python
