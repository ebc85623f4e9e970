// Bullet's HACD (Mamou and Ghorbel 2009) as a peer: decomposes a mesh and writes its hulls, so that decompose_check can
// judge them as it judges ours.
//
//   hacd_peer MESH --hulls F.obj [--tolerance T] [--faces N]
//
// As in the dissertation's comparison the mesh is first simplified with quadric errors, to N faces, and then clustered
// with Bullet's weights until no cluster may grow within the tolerance, a share of the bounding-sphere radius. Prints
// one JSON object on one line; seconds are CPU time, simplification included. Exits 0, 1 when it cannot be done, 2 for
// wrong usage.
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <hacdHACD.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/check/shape.h"
#include "bench/check/solid.h"
#include "bench/tool.h"

namespace {

using namespace partwise::bench;
namespace simplification = CGAL::Surface_mesh_simplification;

Shape simplified(const Shape& shape, int faces) {
  using Surface = CGAL::Surface_mesh<Point>;
  Surface surface;
  for (const Point& p : shape.vertices) surface.add_vertex(p);
  for (const auto& [a, b, c] : shape.faces)
    if (surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c)) ==
        Surface::null_face())
      throw std::runtime_error("the mesh is not manifold: HACD's simplification needs it to be");
  if (static_cast<int>(surface.number_of_faces()) > faces) {
    simplification::GarlandHeckbert_plane_policies<Surface, Kernel> policies(surface);
    const simplification::Count_stop_predicate<Surface> stop(3 * faces / 2);  // edges
    simplification::edge_collapse(
        surface, stop, CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
    surface.collect_garbage();
  }
  Shape result;
  for (const auto v : surface.vertices()) result.vertices.push_back(surface.point(v));
  for (const auto f : surface.faces()) {
    std::array<int, 3> face{};
    int k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) face[k++] = static_cast<int>(v.idx());
    result.faces.push_back(face);
  }
  return result;
}

// `tolerance` in model units.
std::vector<Shape> hacd(const Shape& shape, double tolerance) {
  std::vector<HACD::Vec3<HACD::Real>> points;
  std::vector<HACD::Vec3<long>> triangles;
  for (const Point& p : shape.vertices) points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : shape.faces) triangles.emplace_back(a, b, c);
  const CGAL::Bbox_3 box = CGAL::bbox_3(shape.vertices.begin(), shape.vertices.end());
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  HACD::HACD solver;
  solver.SetPoints(points.data());
  solver.SetNPoints(points.size());
  solver.SetTriangles(triangles.data());
  solver.SetNTriangles(triangles.size());
  solver.SetCompacityWeight(0.1);
  solver.SetVolumeWeight(0.0);
  solver.SetNClusters(1);
  solver.SetNVerticesPerCH(100);
  solver.SetAddExtraDistPoints(false);
  solver.SetAddNeighboursDistPoints(false);
  solver.SetAddFacesPoints(false);
  solver.SetConcavity(tolerance / (diagonal / 2) *
                      solver.GetScaleFactor());  // half the box's diagonal becomes this factor
  if (!solver.Compute()) throw std::runtime_error("HACD failed");
  std::vector<Shape> hulls;
  for (std::size_t cluster = 0; cluster < solver.GetNClusters(); ++cluster) {
    std::vector<HACD::Vec3<HACD::Real>> hull_points(solver.GetNPointsCH(cluster));
    std::vector<HACD::Vec3<long>> hull_triangles(solver.GetNTrianglesCH(cluster));
    solver.GetCH(cluster, hull_points.data(), hull_triangles.data());
    Shape& hull = hulls.emplace_back();
    for (const auto& p : hull_points) hull.vertices.emplace_back(p.X(), p.Y(), p.Z());
    for (const auto& t : hull_triangles)
      hull.faces.push_back({static_cast<int>(t.X()), static_cast<int>(t.Y()), static_cast<int>(t.Z())});
  }
  return hulls;
}

}  // namespace

int main(int argc, char** argv) {
  std::string mesh, output;
  double tolerance = 0.1;
  int faces = 2000;
  CLI::App app("Bullet's HACD as a peer");
  app.add_option("mesh", mesh, "OFF or OBJ, manifold triangles")->required();
  app.add_option("--hulls", output, "OBJ, an object a hull")->required();
  app.add_option("--tolerance", tolerance, "share of the bounding-sphere radius");
  app.add_option("--faces", faces, "to simplify to");
  return run_tool("hacd_peer", app, argc, argv, [&] {
    const Shape shape = read_shape(mesh);
    const double radius = Solid(shape).radius();
    const std::clock_t start = std::clock();
    const Shape coarse = simplified(shape, faces);
    const std::vector<Shape> hulls = hacd(coarse, tolerance * radius);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    write_objects(output, hulls);
    std::cout << nlohmann::ordered_json{{"mesh", mesh},
                                        {"faces", coarse.faces.size()},
                                        {"tolerance", tolerance},
                                        {"parts", hulls.size()},
                                        {"seconds", seconds}}
              << std::endl;
    return 0;
  });
}
