// The peers: medial-axis probabilistic roadmaps (Wilmarth, Amato, Stiller 1999; Lien, Thomas, Amato 2003).
//
// A sample in collision first leaves its obstacle by the shortest way. Then it marches away from the nearest obstacle,
// straight, by steps as long as its clearance, until another obstacle is the nearest, and the place of the change is
// found by bisection.
//
//   exact        clearances are queries of distance; the way out of an obstacle is known for a point
//   approximate  clearances are found by collision checks alone: rays in `clearance_rays` directions (in the plane
//                evenly spread from a random phase, else evenly random over the sphere of tangents), stepped together
//                by `resolution`, at most `most_ticks` times; the first that changes from free to not, or the way out,
//                wins. From a sample in collision `penetration_rays` leave.
//
// In both the axis is met to within `precision` of the clearance.
#pragma once

#include "partwise/motion/medial_axis.h"

namespace partwise {

struct MaprmSettings {
  bool exact = false;
  int clearance_rays = 10, penetration_rays = 20;
  double resolution = 0;  // length of a tick along tangents; 0: the bounds' diagonal over 2000
  int most_ticks = 100;
  double precision = 0.005;
};

class Maprm final : public Retractor {
 public:
  Maprm(const Scene& scene, const MaprmSettings& settings = {});  // `scene` must outlive this

  Retraction operator()(const Configuration& q, Draw& draw) const override;

 private:
  struct Witness {
    int obstacle = -1;
    double distance = 0;
    Tangent away;  // of unit length, from the obstacle
  };
  bool leave(Retraction& walk, Draw& draw) const;
  Witness clearance(const Configuration& q, Retraction& walk, Draw& draw) const;
  Witness nearest(const Configuration& q, Retraction& walk) const;
  // The first ray, `forward` of tangents of unit length, along which collisions begin (or end, from inside).
  Witness first_change(const Configuration& q, int rays, bool inside, Retraction& walk, Draw& draw) const;

  const Scene& scene_;
  MaprmSettings settings_;
};

}  // namespace partwise
