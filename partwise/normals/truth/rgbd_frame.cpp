#include "partwise/normals/truth/rgbd_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/imaging/image_io.h"
#include "partwise/imaging/netpbm.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

constexpr int usual_width = 640, usual_height = 480;
constexpr PinholeCamera primesense{525, 525, 319.5, 239.5};
constexpr PinholeCamera nyu_depth_camera{582.62448167737955, 582.69103270988637, 313.04475870804731,
                                         238.44389626620386};
constexpr std::array<PinholeCamera, 4> tum_cameras{
    {primesense, {517.3, 516.5, 318.6, 255.3}, {520.9, 521.0, 325.1, 249.7}, {535.4, 539.2, 320.1, 247.6}}};

constexpr double nyu_farthest = 10;  // metres; the sensor tells no depths apart there

// Metres of a code of 16 bits.
float metres(RgbdFormat format, std::uint32_t code) {
  switch (format) {
    case RgbdFormat::nyu: {
      constexpr double numerator = 351.3, parallel = 1092.5;  // of the toolbox that comes with the data set
      const double disparity = parallel - (code >> 8 | (code & 0xFF) << 8);
      return disparity > numerator / nyu_farthest ? static_cast<float>(numerator / disparity) : 0;
    }
    case RgbdFormat::sun:
      return static_cast<float>((code >> 3 | code << 13) & 0xFFFF) / 1000;
    case RgbdFormat::tum:
      return static_cast<float>(code) / 5000;
    case RgbdFormat::redwood:
      return static_cast<float>(code) / 1000;
  }
  return 0;
}

std::array<double, 9> nine_numbers(const std::filesystem::path& path) {
  const std::string text = read_bytes(path);
  std::array<double, 9> numbers{};
  const char *at = text.data(), *end = at + text.size();
  for (double& number : numbers) {
    while (at != end && (*at == ' ' || *at == ',' || (*at >= '\t' && *at <= '\r'))) ++at;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) {
      throw InputError(path.string(), fmt::format("number {} of 9 is missing", &number - numbers.data() + 1),
                       "write the camera's matrix, row by row");
    }
    at = after;
  }
  return numbers;
}

// Codes of 8 bits, which the readers stretch to 16, would be taken for depths far too large.
void check_depth_codes(const std::filesystem::path& path, const Image& image) {
  if (image.channels != 1) {
    throw InputError(path.string(), fmt::format("has {} channels, so it is no depth", image.channels),
                     "give the picture of depth");
  }
  const bool some = std::ranges::any_of(image.values, [](float value) { return value > 0; });
  if (some && std::ranges::all_of(image.values, [](float value) { return std::lround(65535 * value) % 257 == 0; })) {
    throw InputError(path.string(), "has 8 bits a pixel, so it is no depth", "give the picture of 16 bits");
  }
}

Image plain_codes(const std::filesystem::path& path, RgbdFormat format) {
  return format == RgbdFormat::nyu ? read_plain_netpbm(path) : read_plain_png(path);
}

std::string size_of(const Image& image) { return fmt::format("{} x {}", image.width, image.height); }

}  // namespace

Image read_rgbd_depth(const RgbdFiles& files) {
  Image image = plain_codes(files.depth, files.format);
  check_depth_codes(files.depth, image);
  for (float& value : image.values) {
    value = metres(files.format, static_cast<std::uint32_t>(std::lround(65535 * value)));
  }
  return image;
}

PinholeCamera read_rgbd_camera(const RgbdFiles& files, int width, int height) {
  if (!files.intrinsics.empty()) {
    const std::array<double, 9> matrix = nine_numbers(files.intrinsics);
    const PinholeCamera camera{matrix[0], matrix[4], matrix[2], matrix[5]};
    if (!(camera.focal_x > 0 && camera.focal_y > 0) || matrix[1] != 0 || matrix[3] != 0 || matrix[8] != 1) {
      throw InputError(files.intrinsics.string(), "is no camera's matrix",
                       "write focal_x 0 centre_x, 0 focal_y centre_y, 0 0 1");
    }
    return camera;
  }
  if (width != usual_width || height != usual_height) {
    throw InputError(files.depth.string(),
                     fmt::format("is {} x {}, the data set's camera {} x {}", width, height, usual_width, usual_height),
                     "give frames of that size, or intrinsics");
  }
  if (files.format == RgbdFormat::nyu) return nyu_depth_camera;
  if (files.format != RgbdFormat::tum) return primesense;
  PARTWISE_CHECK(files.tum_camera, >=, 0);
  PARTWISE_CHECK(files.tum_camera, <=, 3);
  return tum_cameras[static_cast<std::size_t>(files.tum_camera)];
}

RgbdFrame read_rgbd_frame(const RgbdFiles& files) {
  RgbdFrame frame;
  frame.depth = read_rgbd_depth(files);
  frame.camera = read_rgbd_camera(files, frame.depth.width, frame.depth.height);
  frame.colour = read_image(files.colour);
  if (frame.colour.width != frame.depth.width || frame.colour.height != frame.depth.height) {
    throw InputError(files.colour.string(),
                     fmt::format("is {}, its depth {}", size_of(frame.colour), size_of(frame.depth)),
                     "give a pair of one size");
  }
  if (frame.colour.channels != 3) {
    throw InputError(files.colour.string(), fmt::format("has {} channels, not 3", frame.colour.channels),
                     "give a picture in colour");
  }
  return frame;
}

}  // namespace partwise
