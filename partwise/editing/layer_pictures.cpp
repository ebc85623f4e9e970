#include "partwise/editing/layer_pictures.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {

Image square_picture(const Image& photo, const PhotoLayers& layers) {
  const at::Tensor square = cropped(photo, layers.crop.x, layers.crop.y, layers.crop.side).narrow(1, 0, 3);
  return image_of(resized(square, layers.picture.size(3))[0]);
}

Image seen_picture(const PhotoLayers& layers) { return image_of(layers.picture[0]); }

Image rendered_picture(const PhotoLayers& layers, const MaterialRange& range) {
  return image_of(rendered(layers.found, range, layers.regions)[0].clamp(0, 1));
}

Image normals_picture(const PhotoLayers& layers) { return image_of((layers.found.normals[0] + 1) / 2); }

Image ball_picture(const PhotoLayers& layers, const MaterialRange& range, int region, int size) {
  const Dsbrdf material(as_material(range.coefficients(layers.found.material.narrow(0, region, 1))[0]));
  Image ball = tone_map(material_ball(material, LightTree(light_of(layers)), size), 1);
  for (float& value : ball.values) value /= 255;
  return ball;
}

}  // namespace partwise
