// How well normals show detail: the figures of normal_measures.h where the true normals turn quickly.
//
// The turn of a pixel is the largest angle, in degrees, between its true normal and those of its four neighbours that
// have one. With E = edge_turn, C = curved_turn and D = edge_distance,
//   edges   all pixels at most D columns and D rows away from a pixel whose turn is at least E;
//   curved  of the others, those whose turn is at least C;
//   smooth  all that are left.
// The three share out the pixels that have a true normal. A border of the object is no edge: there is nothing to turn
// to. Turns are a pixel's, so figures compare at one resolution only. Errors: as normal_measures.h.
#pragma once

#include "partwise/normals/truth/normal_measures.h"

namespace partwise {

struct DetailSettings {
  double edge_turn = 20, curved_turn = 2;  // degrees a pixel
  int edge_distance = 2;                   // pixels
};

// Of one channel: 1 where a pixel is of that kind.
struct DetailRegions {
  Mask edges, curved, smooth;
};

DetailRegions detail_regions(const Image& truth, const DetailSettings& settings = {});

// The four figures; pools images as NormalMeasure does.
struct DetailMeasure {
  NormalMeasure all, edges, curved, smooth;

  void add(const Image& normals, const Image& truth, const DetailSettings& settings = {});
  void add(const Image& normals, const Image& truth, const Mask& mask, const DetailSettings& settings = {});
  void add(const DetailMeasure& other);
};

}  // namespace partwise
