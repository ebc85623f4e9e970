// The borders that people draw, as bench/border_fit learnt them from the odd numbers of the Princeton benchmark.
#pragma once

#include "partwise/parts/surface/piece_merging.h"

namespace partwise {

BorderModel fitted_borders();

}  // namespace partwise
