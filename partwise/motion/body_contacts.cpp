#include "partwise/motion/body_contacts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/hull_simplify.h"
#include "partwise/motion/even_points.h"
#include "partwise/parts/planar/planar_hull.h"

namespace partwise {
namespace {

constexpr double golden = 0.6180339887498949;

// The Minkowski sum of an obstacle and the reflected body, in the plane or in space: with its planes, n . x <= d
// inside.
struct PlanarSum {
  using Hull = Ring;
  using Planes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  static Ring hull(const Vertices& corners) {
    const std::vector<Eigen::Vector2d> flat(corners.leftCols(2).rowwise().begin(), corners.leftCols(2).rowwise().end());
    const std::vector<int> order = planar_hull(flat);
    return corners.leftCols(2)(order, Eigen::all);
  }
  static Planes planes(const Ring& hull) {
    Planes planes(hull.rows(), 3);
    for (Eigen::Index i = 0; i < hull.rows(); ++i) {
      const Eigen::RowVector2d along = hull.row((i + 1) % hull.rows()) - hull.row(i);
      const Eigen::RowVector2d out = Eigen::RowVector2d(along.y(), -along.x()).normalized();
      planes.row(i) << out, out.dot(hull.row(i));
    }
    return planes;
  }
  static MotionVector centre(const Ring& hull) { return hull.colwise().mean().transpose(); }
};

struct SpatialSum {
  using Hull = Mesh;
  using Planes = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

  static Mesh hull(const Vertices& corners) {
    constexpr double thinnest = 1e-9;  // share of its size: a flat obstacle and a flat body may sum up to a flat set
    const double size = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).norm();
    return convex_hull(corners, std::max(thinnest * size, std::numeric_limits<double>::min())).mesh;
  }
  static Planes planes(const Mesh& hull) { return hull_planes(hull); }
  static MotionVector centre(const Mesh& hull) { return hull.vertices.colwise().mean().transpose(); }
};

Vertices differences(const Mesh& obstacle, const Vertices& body) {
  Vertices all(obstacle.vertices.rows() * body.rows(), 3);
  for (Eigen::Index i = 0; i < body.rows(); ++i)
    all.middleRows(i * obstacle.vertices.rows(), obstacle.vertices.rows()) =
        obstacle.vertices.rowwise() - Point(body.row(i));
  return all;
}

template <typename Planes>
bool inside(const Planes& planes, const MotionVector& x, double by) {
  const Eigen::Index dimension = planes.cols() - 1;
  return (planes.leftCols(dimension) * x - planes.col(dimension)).maxCoeff() < -by;
}

struct Found {
  Configuration q;
  int obstacle = 0;
  bool covered = false;  // by another sum of the obstacle
};

// At one rotation of the bodies, for all obstacles.
template <typename Sum>
class Sampler {
 public:
  Sampler(std::vector<Vertices> bodies, const std::vector<Mesh>& hulls, const std::vector<std::vector<int>>& parts,
          ContactSource source, int each)
      : bodies_(std::move(bodies)), hulls_(hulls), parts_(parts), source_(source), each_(each) {}

  // `number` of the rotation moves samples along, so that those of all rotations do not stand in rows.
  void add(const Configuration& rotation, int number, std::vector<Found>& found) const {
    for (std::size_t obstacle = 0; obstacle < parts_.size(); ++obstacle) {
      std::vector<typename Sum::Hull> sums;
      std::vector<typename Sum::Planes> planes;
      for (const int part : parts_[obstacle]) {
        for (const Vertices& body : bodies_) {
          sums.push_back(Sum::hull(differences(hulls_[static_cast<std::size_t>(part)], body)));
          planes.push_back(Sum::planes(sums.back()));
        }
      }
      const double phase = std::fmod((number + 0.5) * golden, 1.0);
      int taken = 0;
      for (BoundaryPoint& point : even_points(std::span<const typename Sum::Hull>(sums), each_, phase)) {
        if (source_ == ContactSource::collision) {
          constexpr double deepest = 0.3;  // share of the way to the centre
          const double depth = deepest * std::fmod(phase + (++taken) * golden, 1.0);
          point.at += depth * (Sum::centre(sums[static_cast<std::size_t>(point.hull)]) - point.at);
        }
        Configuration q = rotation;
        q.head(point.at.size()) = point.at;
        const bool dropped = source_ == ContactSource::contact && covered(planes, point);
        found.push_back({q, static_cast<int>(obstacle), dropped});
      }
    }
  }

 private:
  static bool covered(const std::vector<typename Sum::Planes>& planes, const BoundaryPoint& point) {
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double size = planes[i].col(planes[i].cols() - 1).cwiseAbs().maxCoeff();
      if (static_cast<int>(i) != point.hull && inside(planes[i], point.at, rounding * size)) return true;
    }
    return false;
  }

  std::vector<Vertices> bodies_;
  const std::vector<Mesh>& hulls_;
  const std::vector<std::vector<int>>& parts_;
  ContactSource source_;
  int each_;  // samples an obstacle
};

std::vector<Mesh> simplified(std::vector<Mesh> hulls, int most_vertices) {
  if (most_vertices <= 0) return hulls;
  tbb::parallel_for(std::size_t(0), hulls.size(),
                    [&](std::size_t i) { hulls[i] = simplify_hull(hulls[i], std::max(4, most_vertices)); });
  return hulls;
}

}  // namespace

std::vector<Configuration> spread_rotations(const ConfigurationSpace& space, int count) {
  Configuration q = Configuration::Zero(space.coordinates());
  if (!space.rotates()) return {q};
  std::vector<Configuration> result;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    if (space.kind() == SpaceKind::se2) {
      q[2] = std::numbers::pi * (2 * share - 1);
    } else {
      constexpr double psi = 1.533751168755204288118041;  // psi^4 = psi + 4
      const double alpha = 2 * std::numbers::pi * (i + 0.5) / std::numbers::sqrt2;
      const double beta = 2 * std::numbers::pi * (i + 0.5) / psi;
      const double a = std::sqrt(share), b = std::sqrt(1 - share);
      q.tail<4>() =
          quaternion_coordinates({b * std::cos(beta), a * std::sin(alpha), a * std::cos(alpha), b * std::sin(beta)});
    }
    result.push_back(q);
  }
  return result;
}

ContactSamples body_contacts(const ConfigurationSpace& space, const std::vector<Mesh>& robot,
                             const std::vector<Mesh>& hulls, const std::vector<int>& obstacles,
                             const BodyContactSettings& settings, const Progress& progress) {
  PARTWISE_CHECK(hulls.size(), ==, obstacles.size());
  const int count = obstacles.empty() ? 0 : *std::ranges::max_element(obstacles) + 1;
  std::vector<std::vector<int>> parts(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    parts[static_cast<std::size_t>(obstacles[i])].push_back(static_cast<int>(i));
  const std::vector<Mesh> bodies = simplified(robot, settings.most_hull_vertices);
  const std::vector<Mesh> few = simplified(hulls, settings.most_hull_vertices);

  const int wanted = std::clamp(settings.most_samples / std::max(count, 1), 1, settings.samples);
  const std::vector<Configuration> rotations = spread_rotations(space, std::min(settings.rotations, wanted));
  const auto at_each =
      static_cast<int>(std::lround(static_cast<double>(wanted) / static_cast<double>(rotations.size())));
  std::vector<std::vector<Found>> found(rotations.size());
  SharedProgress shared(progress, "contacts", static_cast<int>(rotations.size()));
  tbb::parallel_for(std::size_t(0), rotations.size(), [&](std::size_t i) {
    const Eigen::Matrix3d turn = space.pose(rotations[i]).linear();
    std::vector<Vertices> turned;
    for (const Mesh& body : bodies) turned.emplace_back(body.vertices * turn.transpose());
    const auto number = static_cast<int>(i);
    if (is_planar(space.kind()))
      Sampler<PlanarSum>(std::move(turned), few, parts, settings.source, at_each).add(rotations[i], number, found[i]);
    else
      Sampler<SpatialSum>(std::move(turned), few, parts, settings.source, at_each).add(rotations[i], number, found[i]);
    shared.add(1);
  });
  std::vector<MotionVector> points;
  std::vector<int> labels;
  std::vector<bool> known(parts.size(), false);
  for (const auto& at_rotation : found) {
    for (const Found& each : at_rotation) {
      if (!each.covered) known[static_cast<std::size_t>(each.obstacle)] = true;
    }
  }
  for (const auto& at_rotation : found) {
    for (const Found& each : at_rotation) {
      if (each.covered && known[static_cast<std::size_t>(each.obstacle)]) continue;
      points.push_back(space.embedded(each.q));
      labels.push_back(each.obstacle);
    }
  }
  return assembled(points, std::move(labels), count);
}

}  // namespace partwise
