#include "partwise/parts/surface/visible_region.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace partwise {
namespace {

constexpr float kInPlane = 1e-6f;  // of R: so near to a face's plane counts as in it, and single precision tells it

VisibleRegion::Planes face_planes(const Mesh& mesh) {
  VisibleRegion::Planes planes(mesh.faces.rows(), 4);
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Point a = mesh.vertices.row(mesh.faces(f, 0));
    const Point across = (mesh.vertices.row(mesh.faces(f, 1)) - a).cross(mesh.vertices.row(mesh.faces(f, 2)) - a);
    const double length = across.norm();
    const Point normal = length > 0 ? Point(across / length) : Point(Point::Zero());
    planes.row(f) << normal.cast<float>(), static_cast<float>(normal.dot(a)) + kInPlane;
  }
  return planes;
}

// Of each face in face_list the two corners that are not the vertex it is listed at.
std::vector<std::array<int, 2>> other_corners(const SurfaceGraph& graph) {
  std::vector<std::array<int, 2>> result;
  result.reserve(graph.face_list.size());
  for (int v = 0; v < graph.size(); ++v) {
    for (const int f : graph.faces(v)) {
      const auto corners = graph.mesh.faces.row(f);
      const int k = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      result.push_back({corners[(k + 1) % 3], corners[(k + 2) % 3]});
    }
  }
  return result;
}

}  // namespace

VisibleRegion::VisibleRegion(const SurfaceGraph& graph, const InnerVisibility& visibility)
    : graph_(graph),
      visibility_(visibility),
      planes_(face_planes(graph.mesh)(graph.face_list, Eigen::all)),
      first_planes_(planes_(Eigen::Map<const Eigen::ArrayXi>(graph.first_face.data(), graph.size()), Eigen::all)),
      other_corners_(other_corners(graph)),
      state_(static_cast<std::size_t>(graph.size())),
      traced_(static_cast<std::size_t>(graph.mesh.faces.rows()), 0),
      parent_(static_cast<std::size_t>(graph.size())) {}

void VisibleRegion::find(int viewpoint, VisibilityMethod method, const std::vector<std::pair<int, int>>* hints) {
  viewpoint_ = viewpoint;
  eye_ = graph_.mesh.vertices.row(viewpoint).cast<float>();
  std::fill(state_.begin(), state_.end(), std::uint16_t{0});
  forget_traces();
  edge_pairs_.clear();
  region_.clear();
  state_[viewpoint] = kPositive | kVisible | kCertain;
  switch (method) {
    case VisibilityMethod::bfs_plain:
      search(false);
      break;
    case VisibilityMethod::bfs:
      search(true);
      fill_islands();
      break;
    case VisibilityMethod::filter_printed:
      filter_printed();
      break;
    case VisibilityMethod::filter:
      filter(hints);
      break;
  }
}

void VisibleRegion::forget_traces() {
  for (const int face : traced_faces_) traced_[face] = 0;
  traced_faces_.clear();
}

bool VisibleRegion::inside(const Planes& planes, std::ptrdiff_t i) const {
  const float* plane = planes.data() + 4 * i;
  return plane[0] * eye_[0] + plane[1] * eye_[1] + plane[2] * eye_[2] <= plane[3];
}

bool VisibleRegion::positive(int v) {
  if (is(v, kPositive | kNegative)) return is(v, kPositive);
  bool any = inside(first_planes_, v);
  for (int i = graph_.first_face[v] + 1; i < graph_.first_face[v + 1] && !any; ++i) any = inside(planes_, i);
  set(v, any ? kPositive : kNegative);
  return any;
}

bool VisibleRegion::visible(int v) {
  if (is(v, kVisible | kHidden)) return is(v, kVisible);
  bool seen = false;
  if (positive(v)) {
    ++tests_;
    seen = visibility_.sees(viewpoint_, v);
  }
  set(v, seen ? kVisible : kHidden);
  return seen;
}

void VisibleRegion::search(bool only_positive) {
  for (const int v : region_) clear(v, kInRegion);
  region_.assign(1, viewpoint_);
  set(viewpoint_, kInRegion);
  for (std::size_t i = 0; i < region_.size(); ++i) {
    for (const int w : graph_.neighbours(region_[i])) {
      if (!is(w, kVisible | kHidden)) {
        ++tests_;
        const bool seen = visibility_.sees(viewpoint_, w);
        set(w, seen && (!only_positive || positive(w)) ? kVisible : kHidden);
      }
      if (is(w, kInRegion) || !is(w, kVisible)) continue;
      set(w, kInRegion);
      region_.push_back(w);
    }
  }
}

void VisibleRegion::fill_islands() {
  const std::size_t reached = region_.size();
  for (std::size_t i = 0; i < reached; ++i)
    for (const int start : graph_.neighbours(region_[i])) fill_if_island(start);
}

// Takes in what is joined to `start` outside the region, unless it holds a vertex that is not positive.
void VisibleRegion::fill_if_island(int start) {
  if (is(start, kInRegion | kOutside)) return;
  const bool outside = reaches_negative(start, kInRegion);
  for (const int v : walk_) set(v, outside ? kOutside : kInRegion);
  if (!outside) region_.insert(region_.end(), walk_.begin(), walk_.end());
}

// The positive vertices that are joined to the viewpoint without the blocked ones.
void VisibleRegion::flood() {
  for (const int v : region_) clear(v, kInRegion);
  boundary_.clear();
  region_.assign(1, viewpoint_);
  set(viewpoint_, kInRegion);
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const int v = region_[i];
    for (const int w : graph_.neighbours(v)) {
      if (is(w, kInRegion)) continue;
      if (is(w, kBlocked) || !positive(w)) {
        boundary_.emplace_back(v, w);
        continue;
      }
      set(w, kInRegion);
      parent_[w] = v;
      region_.push_back(w);
    }
  }
}

// Follows the faces that have visible and hidden corners, from those at an edge that has one of each. Every face is
// followed once a viewpoint.
VisibleRegion::Contour VisibleRegion::trace(int start_visible, int start_hidden) {
  Contour contour;
  std::vector<std::pair<int, int>> edges{{start_visible, start_hidden}};
  while (!edges.empty()) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    for (int i = graph_.first_face[a]; i < graph_.first_face[a + 1]; ++i) {
      const auto [p, q] = other_corners_[i];
      const int f = graph_.face_list[i], c = p == b ? q : p;
      if ((p != b && q != b) || traced_[f]) continue;
      traced_[f] = 1;
      traced_faces_.push_back(f);
      if (c == a || c == b) continue;  // no area
      if (visible(c)) {
        contour.visible.push_back(c);
        edges.emplace_back(c, b);
      } else {
        contour.hidden.push_back(c);
        edges.emplace_back(a, c);
      }
    }
  }
  contour.visible.push_back(start_visible);
  contour.hidden.push_back(start_hidden);
  return contour;
}

void VisibleRegion::block(const Contour& contour) {
  for (const int v : contour.hidden) set(v, kBlocked);
}

void VisibleRegion::start_from(const std::vector<std::pair<int, int>>& hints) {
  for (const auto& [inner, outer] : hints) {
    if (is(inner, kVisible | kHidden) || is(outer, kVisible | kHidden)) continue;
    if (visible(inner) && !visible(outer) && positive(outer)) block(trace(inner, outer));
  }
}

bool VisibleRegion::way_is_blocked(int v) const {
  while (v != viewpoint_ && !is(v, kBlocked)) v = parent_[v];
  return v != viewpoint_;
}

// Hidden vertices at the boundary of the flood: each is joined to a vertex that is not positive, so it is truly
// outside, and the flood has come to it through the region's contour, which is traced from where the way back is seen
// again. Those whose way a contour of this round has cut are left to the next flood, which may not come to them.
bool VisibleRegion::cut_leaks() {
  bool found = false;
  for (const auto& [inner, outer] : boundary_) {
    if ((found && way_is_blocked(inner)) || visible(inner)) continue;
    int hidden = inner;
    while (!visible(parent_[hidden])) hidden = parent_[hidden];
    block(trace(parent_[hidden], hidden));
    found = true;
  }
  return found;
}

void VisibleRegion::spread_certainty(int from) {
  set(from, kCertain);
  walk_.assign(1, from);
  while (!walk_.empty()) {
    const int v = walk_.back();
    walk_.pop_back();
    for (const int w : graph_.neighbours(v)) {
      if (is(w, kCertain) || !is(w, kVisible)) continue;
      set(w, kCertain);
      walk_.push_back(w);
    }
  }
}

// Whether a vertex that is not positive is joined to `start` without passing the walls. Those walked over are in walk_.
bool VisibleRegion::reaches_negative(int start, State walls) {
  walk_.assign(1, start);
  set(start, kSearched);
  bool found = false;
  for (std::size_t i = 0; i < walk_.size() && !found; ++i) {
    found = is(walk_[i], kOutside) || !positive(walk_[i]);
    for (const int w : graph_.neighbours(walk_[i])) {
      if (is(w, kSearched | walls)) continue;
      set(w, kSearched);
      walk_.push_back(w);
    }
  }
  for (const int v : walk_) clear(v, kSearched);
  return found;
}

// Makes sure that a visible vertex is joined to the viewpoint by visible vertices.
VisibleRegion::Certified VisibleRegion::certify(int boundary) {
  while (!is(boundary, kCertain)) {
    int hidden = -1;  // the first on the way from where it is certain
    int v = boundary;
    for (; !is(v, kCertain); v = parent_[v])
      if (!visible(v)) hidden = v;
    if (hidden < 0) {
      for (v = boundary; !is(v, kCertain); v = parent_[v]) set(v, kCertain);
      spread_certainty(boundary);
      return Certified::yes;
    }
    for (v = parent_[hidden]; !is(v, kCertain); v = parent_[v]) set(v, kCertain);
    const Contour contour = trace(parent_[hidden], hidden);
    spread_certainty(parent_[hidden]);
    const bool island = !reaches_negative(hidden, kCertain);
    if (!island) {
      block(contour);
      return Certified::changed;
    }
    // The way goes on behind the island.
    v = boundary;
    while (!is(v, kCertain) && v != hidden) v = parent_[v];
    if (v == hidden) return Certified::failed;
  }
  return Certified::yes;
}

// Floods the positive region with the contours found so far in the way, until the boundary of the flood proves that it
// is the region: all its vertices are visible and joined to the viewpoint by visible ones, and whatever is cut off
// holds a vertex that is not positive. For then no path leads from the flood to the outside, and nothing inside is
// missing.
void VisibleRegion::filter(const std::vector<std::pair<int, int>>* hints) {
  if (hints) start_from(*hints);
  for (;;) {  // Each round blocks a vertex more.
    flood();
    if (cut_leaks()) continue;
    spread_certainty(viewpoint_);
    Certified all = Certified::yes;
    for (std::size_t i = 0; i < boundary_.size() && all == Certified::yes; ++i) all = certify(boundary_[i].first);
    if (all == Certified::yes) break;
    if (all == Certified::failed) {
      search(true);
      fill_islands();
      return;
    }
  }
  for (const auto& [inner, outer] : boundary_) {
    if (is(outer, kNegative | kInRegion)) continue;
    edge_pairs_.emplace_back(inner, outer);
    fill_if_island(outer);
  }
}

void VisibleRegion::filter_printed() {
  flood();
  const auto boundary = boundary_;
  for (const auto& [inner, outer] : boundary) {
    if (!is(inner, kInRegion) || is(inner, kVisible | kHidden)) continue;
    forget_traces();
    std::vector<int> path;
    for (int v = inner; v != viewpoint_; v = parent_[v]) path.push_back(v);
    std::reverse(path.begin(), path.end());
    int last = viewpoint_, first = outer;
    for (const int v : path) {
      if (!visible(v)) {
        first = v;
        break;
      }
      last = v;
    }
    visible(inner);
    const Contour contour = trace(last, first);
    for (const int v : contour.visible) set(v, kBlocked);
    walk_.assign(1, outer);
    set(outer, kSearched);
    for (std::size_t i = 0; i < walk_.size(); ++i) {
      clear(walk_[i], kInRegion);
      for (const int w : graph_.neighbours(walk_[i])) {
        if (is(w, kSearched | kBlocked)) continue;
        set(w, kSearched);
        walk_.push_back(w);
      }
    }
    for (const int v : walk_) clear(v, kSearched);
    for (const int v : contour.visible) clear(v, kBlocked);
  }
  std::erase_if(region_, [&](int v) { return !is(v, kInRegion); });
}

}  // namespace partwise
