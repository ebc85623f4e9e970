#include "partwise/motion/mesh_proximity.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

fcl::Transform3d scaled(Eigen::Isometry3d pose, double scale) {
  pose.translation() *= scale;
  return pose;
}

}  // namespace

double proximity_scale(double size) {
  constexpr int wanted = 30;  // size becomes about 2^30: triangles count down to 1e-17 of it
  return size > 0 && std::isfinite(size) ? std::exp2(wanted - std::ilogb(size)) : 1;
}

struct ProximityMesh::Model {
  fcl::BVHModel<fcl::OBBRSSd> tree;
};

ProximityMesh::ProximityMesh(const Mesh& mesh, double scale) : scale_(scale), model_(std::make_unique<Model>()) {
  PARTWISE_CHECK(mesh.faces.rows(), >, 0);
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const auto& vertex : mesh.vertices.rowwise()) vertices.emplace_back(scale * vertex.transpose());
  for (const auto& face : mesh.faces.rowwise()) {
    const auto corner = [&](int i) { return static_cast<std::size_t>(face[i]); };
    triangles.emplace_back(corner(0), corner(1), corner(2));
  }
  model_->tree.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model_->tree.addSubModel(vertices, triangles);
  model_->tree.endModel();
}

ProximityMesh::~ProximityMesh() = default;
ProximityMesh::ProximityMesh(ProximityMesh&&) noexcept = default;
ProximityMesh& ProximityMesh::operator=(ProximityMesh&&) noexcept = default;

std::optional<ProximityMesh::Witness> ProximityMesh::nearest(const ProximityMesh& other, const Eigen::Isometry3d& pose,
                                                             double below) const {
  const fcl::DistanceRequestd request(true);
  fcl::DistanceResultd found;
  if (std::isfinite(below)) found.min_distance = scale_ * below;
  fcl::distance(&model_->tree, fcl::Transform3d::Identity(), &other.model_->tree, scaled(pose, scale_), request, found);
  if (found.o1 == nullptr) return std::nullopt;  // the bound was never undercut
  if (found.min_distance <= 0) return Witness{};
  const Eigen::Vector3d here = found.nearest_points[0] / scale_, there = found.nearest_points[1] / scale_;
  return Witness{(there - here).norm(), here, there};
}

bool ProximityMesh::touches(const ProximityMesh& other, const Eigen::Isometry3d& pose) const {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd found;
  return fcl::collide(&model_->tree, fcl::Transform3d::Identity(), &other.model_->tree, scaled(pose, scale_), request,
                      found) > 0;
}

}  // namespace partwise
