#include "partwise/parts/surface/piece_graph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "partwise/geometry/inner_visibility.h"
#include "partwise/parts/surface/face_clustering.h"
#include "partwise/parts/surface/face_values.h"

namespace partwise {
namespace {

// So that quotients and logarithms exist: areas of pieces, and in logarithms, over a component's; thickness over the
// root of the whole area.
constexpr double kLeastArea = 1e-9, kLeastShare = 1e-4, kLeastThickness = 1e-3;
constexpr double kFlatnessUnit = 5;
constexpr double kPoints = 700;
constexpr int kLeastPoints = 4;
constexpr double kConvexFactor = ClusteringSettings{}.convex_factor;

// A vertex that stands for some of a piece's area.
struct Viewpoint {
  int vertex, row;
  double area;
};

// `count` corners of faces, evenly by area in the order of the faces.
std::vector<int> spread_corners(const Mesh& mesh, const std::vector<int>& faces, const std::vector<double>& areas,
                                int count) {
  double whole = 0, passed = 0;
  for (const int f : faces) whole += areas[f];
  std::vector<int> corners;
  for (const int f : faces) {
    passed += areas[f];
    const auto drawn = static_cast<int>(corners.size());
    const int due = whole > 0 ? static_cast<int>(std::floor(count * passed / whole + 0.5)) : count;
    for (int i = drawn; i < std::min(due, count); ++i) corners.push_back(mesh.faces(f, i % 3));
  }
  return corners;
}

}  // namespace

PieceGraph::PieceGraph(const Mesh& mesh, const Eigen::VectorXd& visibility, const Eigen::VectorXd& thickness,
                       const Components& pieces)
    : borders_(static_cast<std::size_t>(pieces.count)), row_(static_cast<std::size_t>(pieces.count), -1) {
  const auto count = static_cast<std::size_t>(pieces.count);
  for (const FaceBorder& border : face_borders(mesh, kConvexFactor)) {
    const int a = pieces.label[border.a], b = pieces.label[border.b];
    if (a == b) continue;
    for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
      Border& sum = borders_[from][to];
      sum.length += border.length, sum.flatness += border.length * border.flatness;
    }
  }
  const std::vector<int> component = components();
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> whole(count, 0.0);  // area of each component
  for (std::size_t f = 0; f < areas.size(); ++f) whole[component[pieces.label[f]]] += areas[f];
  const double size = std::sqrt(std::accumulate(areas.begin(), areas.end(), 0.0));
  const Eigen::VectorXd scaled = normalised(visibility);
  area_.assign(count, 0.0), visible_ = thick_ = area_;
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const int piece = pieces.label[f];
    const double share = whole[component[piece]] > 0 ? areas[f] / whole[component[piece]] : 0;
    const auto i = static_cast<Eigen::Index>(f);
    area_[piece] += share, visible_[piece] += share * scaled[i];
    thick_[piece] += share * std::log(std::max(thickness[i] / size, 0.0) + kLeastThickness);
  }
  for (std::size_t piece = 0; piece < count; ++piece) {
    const double unit = std::sqrt(whole[component[piece]]);
    if (!(unit > 0)) continue;
    for (auto& [other, border] : borders_[piece]) border.length /= unit, border.flatness /= unit;
  }
  test_sight(mesh, pieces, areas);
}

// Of each piece the first that it hangs together with.
std::vector<int> PieceGraph::components() const {
  std::vector<int> component(borders_.size(), -1), open;
  for (std::size_t first = 0; first < borders_.size(); ++first) {
    if (component[first] >= 0) continue;
    component[first] = static_cast<int>(first);
    open.assign(1, static_cast<int>(first));
    while (!open.empty()) {
      const int piece = open.back();
      open.pop_back();
      for (const auto& [next, border] : borders_[piece])
        if (component[next] < 0) component[next] = static_cast<int>(first), open.push_back(next);
    }
  }
  return component;
}

void PieceGraph::test_sight(const Mesh& mesh, const Components& pieces, const std::vector<double>& face_areas) {
  std::vector<std::vector<int>> faces(area_.size());
  for (std::size_t f = 0; f < pieces.label.size(); ++f) faces[pieces.label[f]].push_back(static_cast<int>(f));
  std::vector<Viewpoint> points;
  int rows = 0;
  for (std::size_t piece = 0; piece < area_.size(); ++piece) {
    if (borders_[piece].empty()) continue;  // a component: nothing to merge with
    row_[piece] = rows++;
    const int wanted = std::max(kLeastPoints, static_cast<int>(kPoints * area_[piece]));
    for (const int vertex : spread_corners(mesh, faces[piece], face_areas, wanted))
      points.push_back({vertex, row_[piece], area_[piece] / wanted});
  }
  sight_ = Eigen::MatrixXd::Zero(rows, rows);
  if (rows == 0) return;
  const InnerVisibility visibility(mesh);
  std::vector<Eigen::VectorXd> seen(points.size());  // by each point: of each piece, its own later points only
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t p) {
    seen[p] = Eigen::VectorXd::Zero(rows);
    for (std::size_t q = p; q < points.size(); ++q) {
      if (points[p].vertex == points[q].vertex || visibility.sees(points[p].vertex, points[q].vertex))
        seen[p][points[q].row] += (p == q ? 0.5 : 1) * points[q].area;
    }
  });
  for (std::size_t p = 0; p < points.size(); ++p) sight_.row(points[p].row) += points[p].area * seen[p].transpose();
  sight_ += sight_.transpose().eval();
}

BorderTerms PieceGraph::terms(int a, int b) const {
  const Border& border = borders_[a].at(b);
  const double length = border.length + kLeastArea;
  const double area_a = area_[a] + kLeastArea, area_b = area_[b] + kLeastArea;
  BorderTerms terms = BorderTerms::Zero();
  terms[one] = 1;
  terms[flatness] = border.flatness / length / kFlatnessUnit;
  terms[width] = length / std::sqrt(std::min(area_a, area_b));
  terms[visible_step] = std::abs(visible_[a] / area_a - visible_[b] / area_b);
  terms[thick_step] = std::abs(thick_[a] / area_a - thick_[b] / area_b);
  terms[smaller] = std::log(std::min(area_a, area_b) + kLeastShare);
  terms[together] = std::log(area_a + area_b + kLeastShare);
  if (row_[a] >= 0) {
    const double across = sight_(row_[a], row_[b]), in_a = sight_(row_[a], row_[a]), in_b = sight_(row_[b], row_[b]);
    terms[seen_across] = across / (std::sqrt(in_a * in_b) + kLeastArea * kLeastArea);
    terms[seen_together] = (in_a + in_b + 2 * across) / ((area_a + area_b) * (area_a + area_b));
  }
  return terms;
}

void PieceGraph::join(int a, int b) {
  area_[a] += area_[b], visible_[a] += visible_[b], thick_[a] += thick_[b];
  if (row_[a] >= 0) {
    sight_.row(row_[a]) += sight_.row(row_[b]).eval();
    sight_.col(row_[a]) += sight_.col(row_[b]).eval();
  }
  for (const auto& [other, border] : borders_[b]) {
    borders_[other].erase(b);
    if (other == a) continue;
    for (const auto& [from, to] : {std::pair{a, other}, {other, a}}) {
      Border& sum = borders_[from][to];
      sum.length += border.length, sum.flatness += border.flatness;
    }
  }
  borders_[b].clear();
}

}  // namespace partwise
