// The continuously visible region of a vertex (Liu 2017, sections 2.2.2 and 2.2.3): the vertices that are reached from
// it over the surface through vertices that it sees.
//
// A face is positive for a viewpoint that lies on its inner side or in its plane, a vertex when one of its faces is.
// Four ways, in `VisibilityMethod`:
//   bfs_plain       search in breadth from the viewpoint through the vertices that it sees, as section 2.2.3.1 says.
//   bfs             the same through vertices that it sees and that are positive; then islands are filled: what was not
//                   reached and is connected without what was reached, and has no vertex that is not positive, counts
//                   as visible. On a continuous surface there are none.
//   filter_printed  Algorithm 1 (section 2.2.3.2), its lines 4 and 10 as they are meant: from the positive region take
//                   away what lies beyond a contour of the visible region on the way to each end of the positive one.
//                   It takes islands for the end of the visible region, and misses others.
//   filter          the region that bfs gives, on every viewpoint, by few tests.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "partwise/geometry/inner_visibility.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/surface_graph.h"

namespace partwise {

// One viewpoint at a time; keeps its arrays from one to the next. One a thread.
class VisibleRegion {
 public:
  using Planes = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;  // rows n, d: n . x <= d inside

  VisibleRegion(const SurfaceGraph& graph, const InnerVisibility& visibility);

  // Finds the region of a viewpoint. `hints` (of filter): another viewpoint's edge_pairs(); the nearer, the fewer
  // tests.
  void find(int viewpoint, VisibilityMethod method, const std::vector<std::pair<int, int>>* hints = nullptr);

  const std::vector<int>& vertices() const { return region_; }  // in no particular order, the viewpoint among them
  bool contains(int v) const { return (state_[v] & kInRegion) != 0; }
  std::uint64_t tests() const { return tests_; }  // made by this object so far

  // After filter: neighbours of which the first is in the region and the second, positive but hidden, is not.
  const std::vector<std::pair<int, int>>& edge_pairs() const { return edge_pairs_; }

 private:
  enum State : std::uint16_t {
    kInRegion = 1,
    kPositive = 2,
    kNegative = 4,  // neither: not asked yet
    kVisible = 8,
    kHidden = 16,     // neither: not tested yet
    kBlocked = 32,    // hidden: the flood does not pass
    kCertain = 64,    // visible, and joined to the viewpoint by visible vertices
    kSearched = 128,  // in a walk
    kOutside = 256    // cut off, with a vertex that is not positive
  };
  struct Contour {  // of a set of visible vertices that hang together
    std::vector<int> visible, hidden;
  };

  bool is(int v, int states) const { return (state_[v] & states) != 0; }
  void set(int v, State state) { state_[v] = static_cast<std::uint16_t>(state_[v] | state); }
  void clear(int v, State state) { state_[v] = static_cast<std::uint16_t>(state_[v] & ~state); }
  bool inside(const Planes& planes, std::ptrdiff_t i) const;  // the viewpoint, or in the plane
  bool positive(int v);
  bool visible(int v);  // asks a ray at most once

  void search(bool only_positive);
  void fill_islands();
  void fill_if_island(int start);
  void filter(const std::vector<std::pair<int, int>>* hints);
  void filter_printed();

  void flood();
  Contour trace(int visible, int hidden);
  void forget_traces();
  void block(const Contour& contour);
  void start_from(const std::vector<std::pair<int, int>>& hints);
  bool way_is_blocked(int v) const;
  bool cut_leaks();
  enum class Certified { yes, changed, failed };
  Certified certify(int boundary);
  void spread_certainty(int from);
  bool reaches_negative(int start, State walls);

  const SurfaceGraph& graph_;
  const InnerVisibility& visibility_;
  Planes planes_, first_planes_;  // as in face_list; the first of each vertex again, so that most tests stay in cache
  std::vector<std::array<int, 2>> other_corners_;  // as in face_list
  std::vector<std::uint16_t> state_;               // of vertices
  std::vector<char> traced_;                       // of faces
  std::vector<int> parent_, region_, walk_, traced_faces_;
  std::vector<std::pair<int, int>> boundary_;  // in the region, and a neighbour that is not
  std::vector<std::pair<int, int>> edge_pairs_;
  Eigen::RowVector3f eye_;
  int viewpoint_ = 0;
  std::uint64_t tests_ = 0;
};

}  // namespace partwise
