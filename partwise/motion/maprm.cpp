#include "partwise/motion/maprm.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "partwise/motion/directions.h"

namespace partwise {
namespace {

std::vector<Tangent> directions(int count, int degrees_of_freedom, Draw& draw) {
  std::vector<Tangent> result;
  const double phase = draw.unit();
  for (int i = 0; i < count; ++i) {
    if (degrees_of_freedom == 2) {
      const double angle = 2 * std::numbers::pi * (i + phase) / count;
      result.push_back(Tangent{{std::cos(angle), std::sin(angle)}});
    } else {
      result.push_back(drawn_direction(degrees_of_freedom, draw));
    }
  }
  return result;
}

}  // namespace

Maprm::Maprm(const Scene& scene, const MaprmSettings& settings) : scene_(scene), settings_(settings) {
  const ConfigurationSpace& space = scene.space();
  const double diagonal = space.bounds().sizes().head(position_axes(space.kind())).norm();
  if (settings_.resolution <= 0) settings_.resolution = diagonal / 2000;
}

Maprm::Witness Maprm::first_change(const Configuration& q, int rays, bool inside, Retraction& walk, Draw& draw) const {
  const ConfigurationSpace& space = scene_.space();
  const std::vector<Tangent> all = directions(rays, space.degrees_of_freedom(), draw);
  for (int tick = 1; tick <= settings_.most_ticks; ++tick) {
    const double distance = tick * settings_.resolution;
    for (const Tangent& direction : all) {
      const Configuration at = space.moved(q, distance * direction);
      ++walk.collision_checks;
      const int obstacle = scene_.collision(at);
      if ((obstacle >= 0) != inside) return {obstacle, distance, inside ? direction : Tangent(-direction)};
    }
  }
  return {};
}

Maprm::Witness Maprm::nearest(const Configuration& q, Retraction& walk) const {
  ++walk.distance_queries;
  const std::vector<Near> near = scene_.nearest(q, 1);
  const double steepness = near.front().gradient.norm();
  if (steepness == 0) return {};
  return {near.front().obstacle, near.front().distance, near.front().gradient / steepness};
}

Maprm::Witness Maprm::clearance(const Configuration& q, Retraction& walk, Draw& draw) const {
  return settings_.exact ? nearest(q, walk) : first_change(q, settings_.clearance_rays, false, walk, draw);
}

bool Maprm::leave(Retraction& walk, Draw& draw) const {
  const ConfigurationSpace& space = scene_.space();
  ++walk.collision_checks;
  if (scene_.free(walk.q)) return true;
  if (settings_.exact && !space.rotates()) {
    const Witness out = nearest(walk.q, walk);
    if (out.distance == 0) return false;
    // Beyond the boundary by as much as it lay inside of it, or where that is taken, by less.
    for (double beyond = 1; beyond > 1e-3; beyond /= 4) {
      const Configuration at = space.moved(walk.q, -(1 + beyond) * out.distance * out.away);
      ++walk.collision_checks;
      if (!scene_.free(at)) continue;
      walk.q = at;
      return true;
    }
    return false;
  }
  const Witness out = first_change(walk.q, settings_.penetration_rays, true, walk, draw);
  if (out.distance == 0) return false;
  walk.q = space.moved(walk.q, out.distance * out.away);
  return true;
}

Retraction Maprm::operator()(const Configuration& q, Draw& draw) const {
  constexpr int most_marches = 60;
  const ConfigurationSpace& space = scene_.space();
  Retraction walk{.q = q};
  if (!leave(walk, draw)) return walk;
  const Witness from = clearance(walk.q, walk, draw);
  if (from.distance == 0) return walk;
  const Configuration start = walk.q;
  const auto at = [&](double along) { return space.moved(start, along * from.away); };
  // Whether `from` is still the nearest.
  Witness there = from;
  const auto same = [&](double along) {
    const Configuration here = at(along);
    if (!scene_.within_bounds(here)) return false;
    ++walk.collision_checks;
    if (!scene_.free(here)) return false;
    there = clearance(here, walk, draw);
    return there.obstacle == from.obstacle;
  };
  double low = 0, high = from.distance;
  for (; walk.steps < most_marches && same(high); ++walk.steps) {
    low = high;
    high += there.distance;
  }
  const double precision = std::max(settings_.precision * from.distance, 1e-9);
  while (high - low > precision && walk.steps++ < 2 * most_marches) {
    const double middle = (low + high) / 2;
    (same(middle) ? low : high) = middle;
  }
  walk.q = at(low);
  walk.done = scene_.free(walk.q) && scene_.within_bounds(at(high));
  ++walk.collision_checks;
  return walk;
}

}  // namespace partwise
