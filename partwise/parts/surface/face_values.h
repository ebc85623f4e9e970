// Scalars on the faces of a mesh: filled in where they are missing, smoothed, normalised.
//
// Faces are neighbours when they share an edge (topology.h). All values are vectors of one entry a face.
#pragma once

#include <Eigen/Core>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/topology.h"

namespace partwise {

// Replaces NaN by the mean of the neighbours that have a value, ring by ring from those inwards. A piece of the mesh
// without any value gets the smallest value of all, and 0 if there is none at all. Returns how many were missing.
Eigen::Index fill_missing(const FaceAdjacency& adjacency, Eigen::VectorXd& values);

// Bilateral filter on the graph of faces (Tomasi and Manduchi 1998, as CGAL's documentation of mesh segmentation has
// it): the mean over the faces within `window` steps, weighted by a Gaussian of the steps (deviation window / 2) and
// one of the difference in value (deviation 1.5 times the root mean square difference within the window). Window 0
// changes nothing. Time O(m window^2).
Eigen::VectorXd smooth_bilaterally(const FaceAdjacency& adjacency, const Eigen::VectorXd& values, int window);

// The window that CGAL takes for a mesh of m faces: 1 + floor(sqrt(m / 2000)).
int default_window(Eigen::Index faces);

// Moved and scaled to [0, 1]; constant values become 0. With `bend` > 0 then x -> log(1 + bend x) / log(1 + bend),
// which tells small values apart better (Shapira et al. 2008 use 4, CGAL 5).
Eigen::VectorXd normalised(const Eigen::VectorXd& values, double bend = 0);

}  // namespace partwise
