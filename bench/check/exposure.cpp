#include "bench/check/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <random>
#include <stdexcept>
#include <string>

namespace partwise::bench {
namespace {

// Draws points of a hull, evenly over its surface or in its volume.
class HullSampler {
 public:
  explicit HullSampler(const Hull& hull) : hull_(hull) {
    std::vector<double> areas, volumes;
    for (const Triangle& f : hull.facets()) {
      areas.push_back(std::sqrt(f.squared_area()));
      volumes.push_back(std::abs(CGAL::determinant(f[0] - hull.centre(), f[1] - hull.centre(), f[2] - hull.centre())));
    }
    by_area_ = std::discrete_distribution<int>(areas.begin(), areas.end());
    by_volume_ = std::discrete_distribution<int>(volumes.begin(), volumes.end());
  }

  Point on_surface(std::mt19937_64& random) { return on_facet(by_area_(random), random); }

  Point in_volume(std::mt19937_64& random) {  // a cone over a facet, its sections growing with the square
    const Point p = on_facet(by_volume_(random), random);
    return hull_.centre() + std::cbrt(uniform_(random)) * (p - hull_.centre());
  }

 private:
  Point on_facet(int index, std::mt19937_64& random) {
    const Triangle& f = hull_.facets()[index];
    double s = uniform_(random), t = uniform_(random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    return f[0] + s * (f[1] - f[0]) + t * (f[2] - f[0]);
  }

  const Hull& hull_;
  std::discrete_distribution<int> by_area_, by_volume_;
  std::uniform_real_distribution<double> uniform_;
};

struct Box {
  double bound;
  Point centre;
  Vector half;
  int hull;
  bool operator<(const Box& other) const { return bound < other.bound; }
};

bool in_other(const std::vector<Hull>& hulls, int own, const Point& p) {
  for (int j = 0; j < static_cast<int>(hulls.size()); ++j)
    if (j != own && hulls[j].strictly_contains(p)) return true;
  return false;
}

// All distances here are in model units.
class Search {
 public:
  Search(const Solid& solid, const std::vector<Hull>& hulls, bool exposed, Exposure& result)
      : solid_(solid), hulls_(hulls), exposed_(exposed), result_(result) {}

  void run(const ExposureSettings& settings, double radius) {
    for (int i = 0; i < static_cast<int>(hulls_.size()); ++i) {
      if (hulls_[i].flat()) continue;
      const CGAL::Bbox_3 box = CGAL::bbox_3(hulls_[i].vertices().begin(), hulls_[i].vertices().end());
      const Vector half(box.x_span() / 2, box.y_span() / 2, box.z_span() / 2);
      add({0, Point(box.xmin(), box.ymin(), box.zmin()) + half, half, i});
    }
    while (!queue_.empty() && !done(settings, radius)) {
      const Box box = queue_.top();
      queue_.pop();
      double step[3] = {0, 0, 0}, half[3] = {box.half.x(), box.half.y(), box.half.z()};
      const auto axis = std::max_element(half, half + 3) - half;
      half[axis] /= 2;
      step[axis] = half[axis];
      for (const double way : {-1.0, 1.0})
        add({0, box.centre + way * Vector(step[0], step[1], step[2]), Vector(half[0], half[1], half[2]), box.hull});
    }
    result_.bound = queue_.empty() ? result_.found : std::max(result_.found, queue_.top().bound);
  }

 private:
  bool done(const ExposureSettings& settings, double radius) const {
    const double bound = queue_.top().bound;
    const double limit = settings.limit * radius;
    if (exposed_ && result_.found <= limit && limit < bound) return result_.boxes >= settings.boxes_to_decide;
    return bound <= result_.found + settings.gap * radius || result_.boxes >= settings.boxes;
  }

  void add(Box box) {
    const Hull& own = hulls_[box.hull];
    if (own.misses_box(box.centre, box.half)) return;
    if (exposed_)
      for (int j = 0; j < static_cast<int>(hulls_.size()); ++j)
        if (j != box.hull && hulls_[j].strictly_contains(box.centre, box.half)) return;
    ++result_.boxes;
    const double reach = std::sqrt(box.half.squared_length());
    const double distance = solid_.distance(box.centre);
    box.bound = distance + reach;
    if (box.bound <= result_.found) return;
    if (solid_.inside(box.centre)) {
      box.bound = reach - distance;  // the surface lies between the centre and any point outside
      if (box.bound <= result_.found) return;
    } else if (distance > result_.found && own.contains(box.centre) &&
               !(exposed_ && in_other(hulls_, box.hull, box.centre))) {
      result_.found = distance;
      result_.hull = box.hull;
    }
    queue_.push(box);
  }

  const Solid& solid_;
  const std::vector<Hull>& hulls_;
  const bool exposed_;
  Exposure& result_;
  std::priority_queue<Box> queue_;
};

// Returns the hulls of the farthest samples, strict and exposed.
std::array<int, 2> sample(const Solid& solid, const std::vector<Hull>& hulls, const ExposureSettings& settings,
                          Exposures& result) {
  std::array<int, 2> sampled_hull{-1, -1};
  double total = 0;
  for (const Hull& hull : hulls) total += hull.volume();
  std::mt19937_64 random(settings.seed);
  for (int i = 0; i < static_cast<int>(hulls.size()); ++i) {
    if (hulls[i].flat()) continue;
    HullSampler sampler(hulls[i]);
    const double share = 0.25 / static_cast<double>(hulls.size()) + 0.75 * hulls[i].volume() / total;
    const int count = static_cast<int>(std::ceil(share * settings.samples));
    for (int k = 0; k < count; ++k) {
      const Point p = k % 2 == 0 ? sampler.on_surface(random) : sampler.in_volume(random);
      ++result.samples;
      const double distance = solid.distance(p);
      const double already = std::min(result.strict.sampled, result.exposed.sampled);
      if (distance <= already || solid.inside(p)) continue;
      for (Exposure* exposure : {&result.strict, &result.exposed}) {
        if (distance <= exposure->sampled) continue;
        if (exposure == &result.exposed && in_other(hulls, i, p)) continue;
        exposure->sampled = distance;
        sampled_hull[exposure == &result.exposed] = i;
      }
    }
  }
  return sampled_hull;
}

}  // namespace

Exposures measure_exposure(const Solid& solid, const std::vector<Hull>& hulls, const ExposureSettings& settings) {
  Exposures result;
  const std::array<int, 2> sampled_hull = sample(solid, hulls, settings, result);
  const double r = solid.radius();
  for (Exposure* exposure : {&result.strict, &result.exposed}) {
    const bool exposed = exposure == &result.exposed;
    Search(solid, hulls, exposed, *exposure).run(settings, r);
    if (exposure->sampled > exposure->bound + 1e-9 * r)
      throw std::logic_error("the search missed what a sample found: " + std::to_string(exposure->sampled / r) + " > " +
                             std::to_string(exposure->bound / r));
    if (exposure->sampled > exposure->found)
      exposure->found = exposure->sampled, exposure->hull = sampled_hull[exposed];
    exposure->sampled /= r;
    exposure->found /= r;
    exposure->bound = std::max(exposure->bound / r, exposure->found);
  }
  return result;
}

}  // namespace partwise::bench
