// Fewer parts, from pieces that are small enough: neighbours are merged, the pair whose common hull takes in the least
// air first, as long as the merged part keeps its promise. Then parts are dissolved: the pieces of one are handed to
// its neighbours, if every one of them can take its share and keep its promise.
//
// A part's promise is what `accept` says: for the `hull` measure that the hull stays within the tolerance of the solid,
// for `valley` that no valley of the part is deep.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/parts/solid/hull_part.h"
#include "partwise/parts/solid/space_samples.h"

namespace partwise {

// Whether two parts may become this one. Called in a fixed order from one thread.
using AcceptMerge = std::function<bool(const HullPart& merged)>;

// The most air that a merge may take in: `factor` times the square of the tolerance (in R), as a share of the solid.
// Where parts are long and thin a merge can keep its promise and yet be mostly air. Infinite where there is no solid.
double largest_air(const SpaceSamples& space, double tolerance, double factor);

struct MergeSettings {
  double minimum_thickness = 1e-4;  // of hulls, model units
  double largest_air = 1e300;       // no merge takes in more air, model units cubed
};

class PartMerging {
 public:
  // Pieces are neighbours when they share a vertex; each should be connected. The references must outlive this.
  PartMerging(const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart> pieces, AcceptMerge accept,
              const MergeSettings& settings);

  // Merges until no pair is accepted, or `at_least` parts are left.
  void merge(const Progress& progress, int at_least = 1);

  // Makes parts neighbours that share no vertex, each of the nearest few, so that all can be merged into one.
  void connect_all();

  // Tries once to dissolve each part, smallest volume first. Returns how many went.
  int dissolve(const Progress& progress);

  // Halves every piece; the parts stay. Halves find room in neighbours where whole pieces did not.
  void refine();

  std::vector<HullPart> parts() const;

 private:
  struct Part {
    HullPart body;
    std::vector<int> pieces;
    std::vector<int> air;                          // the sample points in the hull
    int version = 0;                               // counts its changes
    std::set<int> refused;                         // parts that it may not be merged with; what grows stays refused
    std::set<int> refused_pieces;                  // pieces of others that it may not take
    std::vector<std::pair<int, int>> stuck_among;  // surroundings in which it could not be dissolved
  };
  struct Growth {
    double cost;
    int piece, part;
  };

  double cost_of(const HullPart& a, const HullPart& b) const;
  bool joined(const HullPart& a, const HullPart& b, HullPart& result);  // false: not accepted
  void replace(int part, HullPart body);
  std::vector<int> neighbours(int part) const;
  std::vector<std::pair<int, int>> surroundings(int part) const;  // it and its neighbours, with their versions
  bool dissolve_part(int part);

  const Mesh& mesh_;
  const SpaceSamples& space_;
  AcceptMerge accept_;
  MergeSettings settings_;
  std::vector<HullPart> pieces_;
  std::vector<std::vector<int>> piece_neighbours_;
  std::vector<int> part_of_;  // of each piece
  std::vector<Part> parts_;   // those without pieces are gone
  std::vector<int> covered_;  // how many hulls each air point is in
  std::set<std::uint64_t>
      refused_joins_;  // hashes of the faces of joins; that two agree would cost no more than a merge
};

}  // namespace partwise
