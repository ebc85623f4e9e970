#include "bench/picture_difference.h"

#include <ATen/TensorOperators.h>

#include "partwise/editing/image_tensors.h"
#include "partwise/imaging/image_metrics.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise::bench {

using nlohmann::ordered_json;

namespace {

ordered_json difference(const Image& image, const Image& truth, const Image& object) {
  const ImageDifference inside = compare_images(image, truth, object), whole = compare_images(image, truth);
  ordered_json json = {{"l2", inside.squared_error}};
  if (inside.ssim) json["ssim"] = *inside.ssim;
  json["l2_frame"] = whole.squared_error;
  json["ssim_frame"] = *whole.ssim;
  return json;
}

}  // namespace

// Each image exposed by itself; and, as how bright light and material are is not to be told apart, what it comes to
// with one exposure for both.
ordered_json difference(const at::Tensor& image, const at::Tensor& truth, const at::Tensor& mask) {
  const Image found = image_of(image[0].clamp_min(0)), wanted = image_of(truth[0]), object = image_of(mask[0]);
  const float exposure = exposure_by_median(wanted, object);
  const Image shown = tone_map(wanted, exposure);
  ordered_json json = difference(tone_map(found, exposure_by_median(found, object)), shown, object);
  json["same_exposure"] = difference(tone_map(found, exposure), shown, object);
  return json;
}

}  // namespace partwise::bench
