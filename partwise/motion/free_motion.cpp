#include "partwise/motion/free_motion.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace partwise {
namespace {

struct Place {
  Configuration q;
  double clearance;
};

// Of a configuration that touches nothing.
double clearance_of_free(const Scene& scene, const Configuration& q, double room, double margin) {
  return std::max(0.0, std::min(room, scene.nearest(q, 1).front().distance - margin));
}

bool is_free(const Scene& scene, const Configuration& q) { return scene.within_bounds(q) && scene.free(q); }

// Whether the motion is free at a few places, about as many as it would take balls like those at its ends to cover it:
// far fewer than distances, should it be free all along.
bool seems_free(const Scene& scene, const Place& a, const Place& b) {
  constexpr int most = 15;
  const double length = scene.space().displacement(a.q, b.q);
  const int places = static_cast<int>(std::min<double>(most, length / (a.clearance + b.clearance)));
  for (int i = 1; i <= places; ++i) {
    if (!is_free(scene, scene.space().between(a.q, b.q, static_cast<double>(i) / (places + 1)))) return false;
  }
  return true;
}

}  // namespace

double clearance(const Scene& scene, const Configuration& q, double margin) {
  const double room = scene.room(q);
  return room > 0 && scene.free(q) ? clearance_of_free(scene, q, room, margin) : 0;
}

MotionCheck free_motion(const Scene& scene, const Configuration& a, double clearance_a, const Configuration& b,
                        double clearance_b, double resolution, double margin) {
  const ConfigurationSpace& space = scene.space();
  MotionCheck check;
  if (clearance_a <= 0 || clearance_b <= 0 || !seems_free(scene, {a, clearance_a}, {b, clearance_b})) return check;
  std::vector<std::pair<Place, Place>> open{{{a, clearance_a}, {b, clearance_b}}};  // pieces of one length
  while (true) {
    std::erase_if(open, [&](const auto& piece) {
      const auto& [from, to] = piece;
      return space.displacement(from.q, to.q) < from.clearance + to.clearance;
    });
    if (open.empty()) break;
    std::vector<Configuration> middles;
    for (const auto& [from, to] : open) {
      if (space.displacement(from.q, to.q) < resolution) return check;
      middles.push_back(space.between(from.q, to.q, 0.5));
      if (!is_free(scene, middles.back())) return check;
    }
    std::vector<std::pair<Place, Place>> halves;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Configuration& q = middles[i];
      const Place middle{q, clearance_of_free(scene, q, scene.room(q), margin)};
      ++check.distance_queries;
      check.least = std::min(check.least, middle.clearance);
      if (middle.clearance <= 0) return check;
      halves.emplace_back(std::move(open[i].first), middle);
      halves.emplace_back(middle, std::move(open[i].second));
    }
    open = std::move(halves);
  }
  check.free = true;
  return check;
}

}  // namespace partwise
