// What is seen, as images: a pixel is the mean of its samples.
#include <algorithm>
#include <map>

#include "partwise/appearance/rendering/g_buffer.h"

namespace partwise {
namespace {

// visit(pixel, first sample, end of samples)
template <typename Visit>
void each_pixel(const GBuffer& seen, const Visit& visit) {
  const auto samples = static_cast<std::size_t>(seen.size.samples);
  for (std::size_t i = 0; i < seen.parts.size(); i += samples) visit(i / samples, i, i + samples);
}

}  // namespace

Image GBuffer::normal_image() const {
  Image image(size.width, size.height, 3);
  each_pixel(*this, [&](std::size_t pixel, std::size_t first, std::size_t end) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = first; i < end; ++i) sum += normals[i];
    if (sum.norm() > 1e-6f) sum.normalize();
    std::copy_n(sum.data(), 3, &image.values[3 * pixel]);
  });
  return image;
}

Image GBuffer::depth_image() const {
  Image image(size.width, size.height, 1);
  each_pixel(*this, [&](std::size_t pixel, std::size_t first, std::size_t end) {
    double sum = 0, count = 0;
    for (std::size_t i = first; i < end; ++i) {
      if (parts[i] >= 0) sum += static_cast<double>(depths[i]), ++count;
    }
    if (count > 0) image.values[pixel] = static_cast<float>(sum / count);
  });
  return image;
}

Image GBuffer::mask_image() const {
  Image image(size.width, size.height, 1);
  each_pixel(*this, [&](std::size_t pixel, std::size_t first, std::size_t end) {
    const auto seen = std::count_if(&parts[first], &parts[first] + (end - first), [](int part) { return part >= 0; });
    image.values[pixel] = static_cast<float>(seen) / static_cast<float>(end - first);
  });
  return image;
}

std::vector<int> GBuffer::part_of_pixels() const {
  std::vector<int> result;
  each_pixel(*this, [&](std::size_t, std::size_t first, std::size_t end) {
    std::map<int, int> votes;
    for (std::size_t i = first; i < end; ++i) ++votes[parts[i]];
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    result.push_back(std::max_element(votes.begin(), votes.end(), fewer)->first);
  });
  return result;
}

double GBuffer::foreground() const {
  const auto seen = std::count_if(parts.begin(), parts.end(), [](int part) { return part >= 0; });
  return static_cast<double>(seen) / static_cast<double>(parts.size());
}

}  // namespace partwise
