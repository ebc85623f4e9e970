// Pieces of a surface and what lies between them, as sums that add up when two pieces become one.
//
// For merging pieces until what is left are parts: of any two neighbours it tells, in nine numbers, how much the border
// between them looks like one that people would draw. The numbers have no unit and do not depend on the mesh's size,
// nor, but for sampling, on how finely it is meshed.
#pragma once

#include <Eigen/Core>

#include <map>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/topology.h"

namespace partwise {

// What BorderTerms holds.
enum BorderTerm {
  one,            // 1
  flatness,       // mean of -log(t angle / pi) along the border (face_clustering.h), over 5
  width,          // length of the border over the root of the smaller area: small at a neck
  visible_step,   // difference of the mean visibilities, scaled to [0, 1] over the mesh
  thick_step,     // difference of the mean logarithms of the thickness
  seen_across,    // share of pairs of points, one on either side, that see each other, over what it is within the sides
  seen_together,  // the same share among all pairs of points of both
  smaller,        // logarithm of the smaller area over the component's
  together,       // and of both areas
  border_terms
};
using BorderTerms = Eigen::Vector<double, border_terms>;

class PieceGraph {
 public:
  // visibility, thickness: of each face, any unit. Who sees whom is tested for the pairs of about 700 corners of faces
  // a component, 4 at least a piece.
  PieceGraph(const Mesh& mesh, const Eigen::VectorXd& visibility, const Eigen::VectorXd& thickness,
             const Components& pieces);

  int pieces() const { return static_cast<int>(area_.size()); }  // at the start; those joined keep the lower number
  struct Border {
    double length = 0, flatness = 0;  // sum, and sum weighted by length
  };
  const std::map<int, Border>& neighbours(int piece) const { return borders_[piece]; }
  double share(int piece) const { return area_[piece]; }  // of its component's area

  BorderTerms terms(int a, int b) const;
  void join(int a, int b);  // a < b, neighbours; b's neighbours become a's

 private:
  std::vector<int> components() const;
  void test_sight(const Mesh& mesh, const Components& pieces, const std::vector<double>& face_areas);

  std::vector<double> area_, visible_, thick_;  // sums over the faces, weighted by area
  std::vector<std::map<int, Border>> borders_;  // lengths over the root of the component's area
  std::vector<int> row_;                        // of each piece in sight_, -1 for one that is a component
  Eigen::MatrixXd sight_;                       // share of pairs that see each other, times both areas
};

}  // namespace partwise
