// The figures of normals as benchmarks print them.
#pragma once

#include <nlohmann/json.hpp>

#include "partwise/normals/truth/normal_measures.h"

namespace partwise::bench {

inline nlohmann::ordered_json normal_figures(const NormalMeasure& measure) {
  const NormalErrors errors = measure.errors();
  return {{"pixels", errors.pixels}, {"mean", errors.mean},         {"median", errors.median},
          {"rmse", errors.rmse},     {"below", errors.share_below}, {"cosine", errors.cosine}};
}

}  // namespace partwise::bench
