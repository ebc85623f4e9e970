#include "partwise/appearance/colouring.h"

#include <algorithm>
#include <cmath>

#include "partwise/appearance/palette.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

// Where a value lies between the least and the most, in [0, 1].
class Scale {
 public:
  explicit Scale(std::span<const double> values) {
    if (values.empty()) return;
    const auto [least, most] = std::ranges::minmax(values);
    least_ = least, range_ = most - least;
  }
  float at(double value) const { return range_ > 0 ? static_cast<float>((value - least_) / range_) : 0; }

 private:
  double least_ = 0, range_ = 0;
};

}  // namespace

PreviewMesh coloured_by_part(const Mesh& mesh, std::span<const int> labels) {
  PARTWISE_CHECK(static_cast<Eigen::Index>(labels.size()), ==, mesh.faces.rows());
  PreviewMesh coloured{mesh, {}};
  for (const int label : labels) coloured.face_colours.push_back(part_colour(label));
  return coloured;
}

PreviewMesh coloured_by_value(const Mesh& mesh, const Eigen::VectorXd& values) {
  PARTWISE_CHECK(values.size(), ==, mesh.faces.rows());
  const Scale scale({values.data(), static_cast<std::size_t>(values.size())});
  PreviewMesh coloured{mesh, {}};
  for (const double value : values) coloured.face_colours.push_back(value_colour(scale.at(value)));
  return coloured;
}

std::vector<PreviewPoints> coloured_by_value(const Vertices& points, std::span<const double> values, double radius) {
  PARTWISE_CHECK(static_cast<Eigen::Index>(values.size()), ==, points.rows());
  constexpr int levels = 64;
  const Scale scale(values);
  std::vector<std::vector<Eigen::Index>> members(levels);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto level = static_cast<std::size_t>(std::lround(scale.at(values[i]) * (levels - 1)));
    members[level].push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<PreviewPoints> coloured;
  for (std::size_t level = 0; level < levels; ++level) {
    if (members[level].empty()) continue;
    const Eigen::Vector3f colour = value_colour(static_cast<float>(level) / (levels - 1));
    coloured.push_back({points(members[level], Eigen::all), radius, colour});
  }
  return coloured;
}

}  // namespace partwise
