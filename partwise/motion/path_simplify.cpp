#include "partwise/motion/path_simplify.h"

#include <algorithm>
#include <vector>

#include "partwise/motion/free_motion.h"

namespace partwise {
namespace {

constexpr std::uint64_t shortcut_purpose = 5;

class Shortener {
 public:
  Shortener(const Scene& scene, const MotionPath& path, double margin, double resolution)
      : scene_(scene), margin_(margin), resolution_(resolution) {
    for (const Configuration& q : path.configurations) stops_.push_back(stop(q));
  }

  MotionPath path() const {
    MotionPath result;
    for (const Stop& each : stops_) result.configurations.push_back(each.q);
    return result;
  }

  // Straight from one share of the length to a later one; whether that is allowed and shorter.
  bool shortcut(double from, double to) {
    const Place first = at(from), last = at(to);
    if (first.after == last.after) return false;  // on one motion
    const Stop a = stop(first.q), b = stop(last.q);
    double way = 0;
    Configuration previous = a.q;
    for (std::size_t i = first.after + 1; i <= last.after; ++i) {
      way += scene_.space().displacement(previous, stops_[i].q);
      previous = stops_[i].q;
    }
    way += scene_.space().displacement(previous, b.q);
    constexpr double gain = 1e-6;
    if (scene_.space().displacement(a.q, b.q) > (1 - gain) * way) return false;
    if (!free_motion(scene_, a.q, a.clearance, b.q, b.clearance, resolution_, margin_).free) return false;
    const auto begin = stops_.begin() + static_cast<std::ptrdiff_t>(first.after) + 1;
    const auto at = stops_.erase(begin, stops_.begin() + static_cast<std::ptrdiff_t>(last.after) + 1);
    stops_.insert(at, {a, b});
    return true;
  }

  // Stops that a straight motion may pass by.
  void drop_stops() {
    for (std::size_t i = 1; i + 1 < stops_.size();) {
      const Stop &a = stops_[i - 1], &b = stops_[i + 1];
      if (free_motion(scene_, a.q, a.clearance, b.q, b.clearance, resolution_, margin_).free)
        stops_.erase(stops_.begin() + static_cast<std::ptrdiff_t>(i));
      else
        ++i;
    }
  }

 private:
  struct Stop {
    Configuration q;
    double clearance = 0;  // less the margin
  };
  struct Place {
    Configuration q;
    std::size_t after = 0;  // the stop before it
  };

  Stop stop(const Configuration& q) const { return {q, clearance(scene_, q, margin_)}; }

  Place at(double share) const {
    double left = share * path_length(scene_.space(), path());
    for (std::size_t i = 1; i < stops_.size(); ++i) {
      const double length = scene_.space().displacement(stops_[i - 1].q, stops_[i].q);
      if (left < length) return {scene_.space().between(stops_[i - 1].q, stops_[i].q, left / length), i - 1};
      left -= length;
    }
    return {stops_.back().q, stops_.size() - 2};
  }

  const Scene& scene_;
  double margin_, resolution_;
  std::vector<Stop> stops_;
};

}  // namespace

MotionPath simplified(const Scene& scene, const MotionPath& path, const PathSimplifySettings& settings,
                      const Progress& progress) {
  if (path.configurations.size() < 3) return path;
  const double margin = settings.keep * path_clearance(scene, path).minimum;
  const double resolution = settings.resolution * scene.space().bounds().diagonal().norm();
  Shortener shortener(scene, path, margin, resolution);
  shortener.drop_stops();
  int failures = 0;
  for (int i = 0; i < settings.most_shortcuts && failures < settings.most_failures; ++i) {
    progress("simplify", static_cast<double>(i) / settings.most_shortcuts);
    Draw draw(settings.seed, static_cast<std::uint64_t>(i), shortcut_purpose);
    const auto [from, to] = std::minmax({draw.unit(), draw.unit()});
    failures = shortener.shortcut(from, to) ? 0 : failures + 1;
  }
  shortener.drop_stops();
  return shortener.path();
}

}  // namespace partwise
