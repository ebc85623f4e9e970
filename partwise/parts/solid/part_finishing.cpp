#include "partwise/parts/solid/part_finishing.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

// The faces around each vertex.
struct Stars {
  std::vector<int> first, faces;

  explicit Stars(const Mesh& mesh)
      : first(static_cast<std::size_t>(mesh.vertices.rows()) + 1, 0),
        faces(static_cast<std::size_t>(mesh.faces.size())) {
    for (int v : mesh.faces.reshaped()) ++first[v + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (int f = 0; f < mesh.faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) faces[next[mesh.faces(f, k)]++] = f;
  }
};

}  // namespace

bool absorb_faces(const Mesh& mesh, std::vector<HullPart>& parts, double minimum_thickness) {
  std::vector<int> owner(static_cast<std::size_t>(mesh.faces.rows()), -1);
  for (int p = 0; p < static_cast<int>(parts.size()); ++p)
    for (int f : parts[p].faces) owner[f] = p;
  const Stars stars(mesh);
  std::vector<int> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return parts[a].volume > parts[b].volume; });

  bool changed = false;
  // Marks of the part that last looked at a face or a vertex: nothing of the mesh's size is touched for every part.
  std::vector<int> face_seen(owner.size(), -1), vertex_seen(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  std::vector<char> vertex_inside(vertex_seen.size(), 0);
  for (int p : order) {
    if (parts[p].faces.empty()) continue;
    const auto planes = hull_planes(parts[p].hull);
    const auto inside = [&](int v) {
      if (vertex_seen[v] != p) {
        vertex_seen[v] = p;
        vertex_inside[v] =
            ((planes.leftCols<3>() * mesh.vertices.row(v).transpose()).array() <= planes.col(3).array()).all();
      }
      return vertex_inside[v] != 0;
    };
    // What hangs together with the part inside its hull, by owner.
    std::map<int, std::vector<int>> offered;
    std::vector<int> front = parts[p].faces;
    while (!front.empty()) {
      const int f = front.back();
      front.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.faces(f, k);
        for (int i = stars.first[v]; i < stars.first[v + 1]; ++i) {
          const int g = stars.faces[i];
          if (face_seen[g] == p || owner[g] < 0 || owner[g] == p) continue;
          if (!inside(mesh.faces(g, 0)) || !inside(mesh.faces(g, 1)) || !inside(mesh.faces(g, 2))) continue;
          face_seen[g] = p;
          offered[owner[g]].push_back(g);
          front.push_back(g);
        }
      }
    }
    for (auto& [donor, faces] : offered) {
      std::sort(faces.begin(), faces.end());
      std::vector<int> rest, all = parts[p].faces;
      std::set_difference(parts[donor].faces.begin(), parts[donor].faces.end(), faces.begin(), faces.end(),
                          std::back_inserter(rest));
      all.insert(all.end(), faces.begin(), faces.end());
      std::sort(all.begin(), all.end());
      if (!rest.empty() && connected_groups(mesh, rest).size() > 1) continue;
      if (connected_groups(mesh, all).size() > 1) continue;  // It hung on what another owner kept.
      for (int f : faces) owner[f] = p;
      parts[p].faces = std::move(all);
      parts[donor].faces.clear();
      if (!rest.empty()) parts[donor] = hull_part(mesh, std::move(rest), minimum_thickness);
      changed = true;
    }
  }
  std::erase_if(parts, [](const HullPart& part) { return part.faces.empty(); });
  return changed;
}

void fill_interior(const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart>& parts,
                   const HullPromise& promise, double minimum_thickness) {
  constexpr std::size_t kTries = 8;
  std::vector<char> covered(static_cast<std::size_t>(space.solid.size()), 0),
      air(static_cast<std::size_t>(space.air.size()), 0);
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>> planes(parts.size());
  const auto enter = [&](std::size_t p, const Mesh& hull) {
    planes[p] = hull_planes(hull);
    for (int i : space.solid.inside(hull)) covered[i] = 1;
    for (int i : space.air.inside(hull)) air[i] = 1;
  };
  for (std::size_t p = 0; p < parts.size(); ++p) enter(p, parts[p].hull);

  for (int i = 0; i < space.solid.size(); ++i) {
    if (covered[i]) continue;
    const Point point = space.solid[i];
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t p = 0; p < parts.size(); ++p)
      nearest.emplace_back((planes[p].leftCols<3>() * point.transpose() - planes[p].col(3)).maxCoeff(), p);
    std::sort(nearest.begin(), nearest.end());
    if (nearest.size() > kTries) nearest.resize(kTries);
    double least = std::numeric_limits<double>::infinity();
    std::size_t chosen = 0;
    HullPart grown;
    for (const auto& [distance, p] : nearest) {
      HullPart larger;
      Corners corners = exact_corners(mesh, parts[p]);
      corners.append(point, {-1});
      set_hull(larger, corners, minimum_thickness);
      // What stays thin gains nothing, and thin hulls are made anew from the part's vertices alone when delivered.
      if (larger.thickened) continue;
      double taken = 1e-6 * distance;
      for (int a : space.air.inside(larger.hull)) taken += !air[a];
      if (taken >= least || !promise.holds(larger.hull)) continue;
      least = taken;
      chosen = p;
      grown = std::move(larger);
    }
    if (grown.hull.faces.rows() == 0) continue;
    grown.faces = std::move(parts[chosen].faces);
    parts[chosen] = std::move(grown);
    enter(chosen, parts[chosen].hull);
  }
}

}  // namespace partwise
