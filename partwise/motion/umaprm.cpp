#include "partwise/motion/umaprm.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "partwise/motion/directions.h"

namespace partwise {
namespace {

// What is nearest along a segment.
struct Look {
  int obstacle = -1;  // -1: in collision, or outside
  double distance = 0, second = std::numeric_limits<double>::infinity();
};

Look look_at(const Scene& scene, const Configuration& q, Retraction& counts) {
  ++counts.collision_checks;
  if (!scene.within_bounds(q) || !scene.free(q)) return {};
  ++counts.distance_queries;
  const std::vector<Near> near = scene.nearest(q, 2);
  Look look{near[0].obstacle, near[0].distance};
  if (near.size() > 1) look.second = near[1].distance;
  return look;
}

}  // namespace

Umaprm::Umaprm(const Scene& scene, const UmaprmSettings& settings) : scene_(scene), settings_(settings) {
  const ConfigurationSpace& space = scene.space();
  const double diagonal = space.bounds().sizes().head(position_axes(space.kind())).norm();
  if (settings_.length <= 0) settings_.length = diagonal / 10;
  if (settings_.resolution <= 0) settings_.resolution = diagonal / 2000;
}

std::vector<Retraction> Umaprm::crossings(const Configuration& q, Draw& draw, std::size_t most) const {
  const ConfigurationSpace& space = scene_.space();
  const Tangent forward = drawn_direction(space.degrees_of_freedom(), draw);
  const auto at = [&](double along) { return space.moved(q, along * forward); };
  std::vector<Retraction> found;
  Retraction walk{.q = q};
  double here = 0;
  Look now = look_at(scene_, q, walk);
  while (here < settings_.length && found.size() < most) {
    ++walk.steps;
    // A displacement is at most sqrt(2) times a tangent's length (translation and turn are added).
    const double sure = (now.second - now.distance) / (2 * std::numbers::sqrt2);
    const double there = std::min(settings_.length, here + std::max(settings_.resolution, now.obstacle < 0 ? 0 : sure));
    const Look next = look_at(scene_, at(there), walk);
    if (now.obstacle >= 0 && next.obstacle >= 0 && next.obstacle != now.obstacle) {
      double low = here, high = there;
      while (high - low > std::max(settings_.precision * std::min(now.distance, next.distance), 1e-9)) {
        const double middle = (low + high) / 2;
        (look_at(scene_, at(middle), walk).obstacle == now.obstacle ? low : high) = middle;
      }
      walk.q = at(low);
      walk.done = true;
      found.push_back(walk);
      walk = {.q = q};
    }
    here = there;
    now = next;
  }
  if (found.empty()) return {walk};
  found.back().steps += walk.steps;
  found.back().distance_queries += walk.distance_queries;
  found.back().collision_checks += walk.collision_checks;
  return found;
}

Retraction Umaprm::operator()(const Configuration& q, Draw& draw) const { return crossings(q, draw, 1).front(); }

std::vector<Retraction> Umaprm::samples(const Configuration& q, Draw& draw) const {
  return crossings(q, draw, std::numeric_limits<std::size_t>::max());
}

}  // namespace partwise
