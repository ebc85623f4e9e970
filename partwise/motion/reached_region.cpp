#include "partwise/motion/reached_region.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nanoflann.hpp>
#include <utility>

#include "partwise/base/draw.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/motion/contact_samples.h"
#include "partwise/motion/free_motion.h"

namespace partwise {
namespace {

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<MotionPoints, -1, nanoflann::metric_L2>;

constexpr double far_share = 0.2, inner_share = 0.3;  // of ways towards a place; the others go on as samples lie
constexpr double shortest_way = 1.0 / 64;             // of that to the place
constexpr std::size_t neighbours = 8;                 // two of which say how samples lie
constexpr double least_stretch = 0.5, most_stretch = 8;
constexpr double nearest_to_contact = 0.02;  // where a walk ends, of its length
constexpr int most_steps = 16;               // of a walk

// Configurations whose positions are in the box of the samples, each with the room around it.
ConfigurationSpace space_about(const ConfigurationSpace& space, const std::vector<AxisSample>& samples) {
  Eigen::AlignedBox3d box;
  for (const AxisSample& each : samples) {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    position.head(position_axes(space.kind())) = each.q.head(position_axes(space.kind()));
    const Eigen::Vector3d room = Eigen::Vector3d::Constant(each.state.clearance());
    box.extend(Eigen::AlignedBox3d(position - room, position + room));
  }
  return {space.kind(), box.intersection(space.bounds()), space.rotation_scale()};
}

MotionPoints embedded(const ConfigurationSpace& space, const std::vector<AxisSample>& samples) {
  MotionPoints points(static_cast<Eigen::Index>(samples.size()), space.embedding());
  for (std::size_t i = 0; i < samples.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = space.embedded(samples[i].q).transpose();
  return points;
}

}  // namespace

struct ReachedRegion::Component {
  Component(const ConfigurationSpace& space, std::vector<AxisSample> members, int old_members)
      : samples(std::move(members)),
        old(old_members),
        about(space_about(space, samples)),
        points(embedded(space, samples)),
        tree(space.embedding(), std::cref(points)) {}

  std::vector<Eigen::Index> nearest(const MotionVector& x, std::size_t count) const {
    std::vector<Eigen::Index> found(std::min(count, samples.size()));
    std::vector<double> distances(found.size());
    tree.query(x.data(), found.size(), found.data(), distances.data());
    return found;
  }

  const Configuration& operator[](Eigen::Index i) const { return samples[static_cast<std::size_t>(i)].q; }

  // One that came last, or any where none did.
  const Configuration& drawn_fresh(Draw& draw) const {
    const int all = static_cast<int>(samples.size());
    return (*this)[old < all ? old + draw.below(all - old) : draw.below(all)];
  }

  std::vector<AxisSample> samples;
  int old;  // how many of them, which go first, are not fresh
  ConfigurationSpace about;
  MotionPoints points;  // embedded
  Tree tree;
};

ReachedRegion::ReachedRegion(const Scene& scene, const std::vector<AxisSample>& samples, const Roadmap& roadmap,
                             const std::vector<int>& ends, std::size_t old)
    : scene_(scene) {
  struct Members {
    std::vector<AxisSample> samples;
    int old = 0;
  };
  DisjointSets sets(samples.size());
  for (const RoadmapEdge& each : roadmap.edges) sets.join(each.from, each.to);
  std::map<int, Members> components;
  for (const int end : ends) components[sets.find(end)];
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto component = components.find(sets.find(static_cast<int>(i)));
    if (component == components.end()) continue;
    component->second.samples.push_back(samples[i]);
    if (i < old) ++component->second.old;
  }
  for (auto& [root, members] : components)
    components_.push_back(std::make_unique<Component>(scene.space(), std::move(members.samples), members.old));
}

ReachedRegion::~ReachedRegion() = default;

// A ball of clearance at a time.
Configuration ReachedRegion::walked(Configuration at, const Configuration& towards) const {
  const ConfigurationSpace& space = scene_.space();
  const double nearly = nearest_to_contact * space.displacement(at, towards);
  for (int step = 0; step < most_steps; ++step) {
    const double left = space.displacement(at, towards), room = clearance(scene_, at);
    if (left < room) return towards;
    if (room < nearly) break;
    at = space.between(at, towards, room / left);
  }
  return at;
}

Configuration ReachedRegion::drawn(Draw& draw) const {
  const ConfigurationSpace& space = scene_.space();
  const Component& component = *components_[static_cast<std::size_t>(draw.below(static_cast<int>(components_.size())))];
  const double kind = draw.unit();
  if (kind < far_share + inner_share || component.samples.size() < 2) {
    const Configuration place = (kind < far_share ? space : component.about).drawn(draw);
    const Configuration& from = component[component.nearest(space.embedded(place), 1).front()];
    return walked(from, space.between(from, place, std::pow(shortest_way, draw.unit())));
  }
  const Configuration& from = component.drawn_fresh(draw);
  const std::vector<Eigen::Index> about = component.nearest(space.embedded(from), neighbours);
  const std::vector<int> two = draw.different(2, static_cast<int>(about.size()));
  const auto neighbour = [&](int i) {
    return component[about[static_cast<std::size_t>(two[static_cast<std::size_t>(i)])]];
  };
  const Tangent way = space.difference(neighbour(0), neighbour(1));
  double stretch = least_stretch * std::pow(most_stretch / least_stretch, draw.unit());
  Configuration towards = space.moved(from, stretch * way);
  while (!scene_.within_bounds(towards)) towards = space.moved(from, (stretch /= 2) * way);
  return walked(from, towards);
}

}  // namespace partwise
