#include "partwise/parts/surface/fitted_borders.h"

namespace partwise {

BorderModel fitted_borders() {
  BorderModel model;
  model.weights << 1.9793, -1.9840, -0.1953, 2.5164, 0.7336, -1.8583, 1.6256, 0.2451, 0.1405;
  model.threshold = 0.5;
  return model;
}

}  // namespace partwise
