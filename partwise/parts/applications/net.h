// Surfaces unfolded into the plane: nets to cut out, fold and glue.
//
// A net is a tree of faces that hang together along folds. The tree is chosen by the steepest-edge rule
// (Schlickenrieder 1997): seen along a direction, every vertex is cut free along its steepest edge; several directions
// are tried until no faces overlap. If none serves, the faces of the best net are taken one after another, and those
// that would overlap begin nets of their own. So a surface always unfolds; a convex one nearly always in one piece.
//
// Two faces overlap when their interiors meet: decided for the coordinates as they are delivered, by exact orientation
// tests, with no tolerance. Neighbours across a fold share the two corners to the bit.
//
// Every cut edge gets a number, and a tab on one of its two sides where there is room: trapezoids that overlap no face
// and no other tab, by the same test, narrower where they must be. Folds between faces that lie in one plane are flat.
//
// Input: a triangle mesh whose edges have one or two faces, turned alike; closed or open. Lengths in model units.
// Deterministic. Time O(m^2) for the overlap tests. Errors: InputError for an edge of more than two faces or faces
// without area; Cancelled, between the directions.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct NetFace {
  int face = 0;      // of the mesh
  int parent = -1;   // the index in Net::faces that it hangs from; -1 for the first
  int fold = -1;     // corner k of the face where the side to the parent starts
  double angle = 0;  // radians by which it folds up towards the inside from its parent's plane: positive at ridges
  std::array<Eigen::Vector2d, 3> corners{};  // counter-clockwise, printed side up: the outside of the surface
};

struct NetEdge {               // a side of a face that is cut
  int net_face = 0, side = 0;  // from corner `side` to the next
  int number = -1;             // the same for the two sides that are glued together; -1 on the border of the surface
  std::vector<Eigen::Vector2d> tab{};  // four corners, or empty
};

struct Net {
  std::vector<NetFace> faces;  // parents before children
  std::vector<NetEdge> cuts;
};

struct UnfoldSettings {
  double tab = 0.15;    // height of tabs, a share of the mean edge length
  int directions = 60;  // tried
};

struct Unfolding {
  std::vector<Net> nets;
  int overlaps = 0;     // pairs of faces that overlap, 0 by construction, counted once more at the end
  int glued = 0;        // pairs of sides to be glued
  int without_tab = 0;  // such pairs for which no tab had room
};

Unfolding unfold(const Mesh& mesh, const UnfoldSettings& settings = {}, const Progress& progress = {});

// Pairs of faces of the net whose interiors meet.
int count_overlaps(const Net& net);

// The corners of each face, folded up again from the plane by the angles alone, in the frame in which the first face
// lies in z = 0; 3 x 3 a face.
std::vector<Eigen::Matrix3d> refolded(const Net& net);

// How far the refolded nets are from the mesh: each is moved rigidly onto the face it began with, and the largest
// distance of a corner from where it belongs is taken, as a share of the bounding-sphere radius.
double refolding_error(const Unfolding& unfolding, const Mesh& mesh);

}  // namespace partwise
