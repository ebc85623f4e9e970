// A peer: medial-axis PRM whose samples are spread evenly over the axis (Yeh, Denny, Lindsey, Thomas, Amato 2014,
// UMAPRM). A segment of fixed length starts at each configuration drawn, in a direction drawn evenly over tangents;
// wherever the nearest obstacle changes along its free part, the axis is met, and the place is found by bisection. The
// number of times that a segment crosses a part of the axis is as large as that part, in the mean, wherever it lies.
//
// Distances are exact, and spare looking: nowhere nearer than half the difference of the two smallest distances can the
// nearest obstacle change. Retracting one configuration, as the middle of an edge needs it, gives the first crossing of
// its segment.
#pragma once

#include "partwise/motion/medial_axis.h"

namespace partwise {

struct UmaprmSettings {
  double length = 0;         // of a segment, a displacement; 0: a tenth of the bounds' diagonal
  double resolution = 0;     // the shortest step along it; 0: the diagonal over 2000
  double precision = 0.005;  // of the place, a share of the clearance there
};

class Umaprm final : public Retractor {
 public:
  Umaprm(const Scene& scene, const UmaprmSettings& settings = {});  // `scene` must outlive this

  Retraction operator()(const Configuration& q, Draw& draw) const override;
  std::vector<Retraction> samples(const Configuration& q, Draw& draw) const override;

 private:
  // Up to `most` crossings.
  std::vector<Retraction> crossings(const Configuration& q, Draw& draw, std::size_t most) const;

  const Scene& scene_;
  UmaprmSettings settings_;
};

}  // namespace partwise
