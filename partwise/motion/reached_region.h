// Where a search has come from its ends: the samples that edges join to starts or goals, as something to go on from.
//
// A configuration is drawn by walking from one of these samples, and ends where contact is near, so that what is drawn
// lies on the same side of obstacles as the sample. The walk goes
//
//   towards a place   drawn within the bounds or within the box of the samples, from the sample that is nearest to it,
//                     a part of the way from all of it down to a 64th, short ways as often as long ones: as trees that
//                     explore rapidly do (LaValle 1998)
//   as samples lie    from one that came last, along the difference of two of its neighbours, stretched: along a
//                     passage where samples lie along one, as by their principal components (Dalibard, Laumond 2009)
#pragma once

#include <memory>
#include <vector>

#include "partwise/motion/roadmap.h"

namespace partwise {

class ReachedRegion {
 public:
  // `scene` must outlive it. `ends`: samples, at least one; what one component joins counts once. Samples from `old` on
  // came last.
  ReachedRegion(const Scene& scene, const std::vector<AxisSample>& samples, const Roadmap& roadmap,
                const std::vector<int>& ends, std::size_t old);
  ~ReachedRegion();

  // Free and within the bounds. Takes up to 17 queries of distance and of collision.
  Configuration drawn(Draw& draw) const;

 private:
  struct Component;
  Configuration walked(Configuration at, const Configuration& towards) const;

  const Scene& scene_;
  std::vector<std::unique_ptr<Component>> components_;
};

}  // namespace partwise
