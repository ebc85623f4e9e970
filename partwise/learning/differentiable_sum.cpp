#include "partwise/learning/differentiable_sum.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstring>

#include "partwise/base/error.h"
#include "partwise/learning/lobe_lanes.h"

namespace partwise {
namespace {

using namespace lanes;
using Index = Eigen::Index;

constexpr Index normal_block = 2048, light_block = 512;

Index blocks(Index size, Index block) { return (size + block - 1) / block; }

std::size_t lobe_number(int channel, int lobe) { return static_cast<std::size_t>(dsbrdf_lobe_count * channel + lobe); }

// Every block of normals with every block of light, in parallel.
template <typename Work>
void for_blocks(Index normals, Index lights, const Work& work) {
  const tbb::blocked_range2d<Index> all(0, blocks(normals, normal_block), 1, 0, blocks(lights, light_block), 1);
  tbb::parallel_for(all, [&](const auto& range) {
    for (Index n = range.rows().begin(); n < range.rows().end(); ++n) {
      for (Index l = range.cols().begin(); l < range.cols().end(); ++l) work(n, l);
    }
  });
}

}  // namespace

// Rows of planes, filled up with zeros to whole lanes.
template <typename Scalar>
struct DifferentiableSum<Scalar>::Block {
  static constexpr Index width = Lanes<Scalar>::width;
  using Value = typename Lanes<Scalar>::Value;

  Index rows = 0;
  Planes<Scalar> values;

  explicit Block(Index count) : rows(count), values(Planes<Scalar>::Zero(blocks(count, width) * width, 3)) {}
  Block(const PlanesRef<Scalar>& planes, Index block)
      : Block(std::min(normal_block, planes.rows() - block * normal_block)) {
    values.topRows(rows) = planes.middleRows(block * normal_block, rows);
  }
  std::array<Value, 3> at(Index row) const {
    return {load(&values(row, 0)), load(&values(row, 1)), load(&values(row, 2))};
  }
};

// What one block of normals adds to the derivatives at each pixel of a block of light.
template <typename Scalar>
struct DifferentiableSum<Scalar>::LightShare {
  std::vector<PixelLobes<Scalar>> lobes;
  std::vector<std::array<Scalar, 3>> radiance;
};

template <typename Scalar>
DifferentiableSum<Scalar>::DifferentiableSum(const std::vector<LightPixel<Scalar>>& grid,
                                             const Coefficients<Scalar>& material, const PlanesRef<Scalar>& radiance)
    : grid_(grid), lobes_(pixel_lobes(grid, material)), weights_(radiance) {
  PARTWISE_CHECK(static_cast<std::size_t>(radiance.rows()), ==, grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) weights_.row(static_cast<Index>(i)) *= grid[i].solid_angle;
}

// use(row, channel, f cos) for the normals, a lane's worth from `row` on, that the light pixel lies in front of.
template <typename Scalar>
template <typename Use>
void DifferentiableSum<Scalar>::for_lit(std::size_t light, const Block& normals, const Use& use) const {
  using Value = typename Block::Value;
  const LightPixel<Scalar>& pixel = grid_[light];
  const LobeLanes<Scalar> lobes(lobes_[light]);
  for (Index row = 0; row < normals.values.rows(); row += Block::width) {
    const std::array<Value, 3> normal = normals.at(row);
    const Value cosine = dot(normal, pixel.direction);
    if (!any_positive(cosine)) continue;
    const HalfCosines<Scalar> half(normal, pixel.half_vector);
    for (int channel = 0; channel < 3; ++channel) {
      Value value{};
      for (int r = 0; r < dsbrdf_lobe_count; ++r) {
        LobeValue<Value> at;
        if (lobes.evaluate(lobe_number(channel, r), half.log(r), at)) value += at.value;
      }
      use(row, channel, value * largest(cosine, Value{}));
    }
  }
}

template <typename Scalar>
void DifferentiableSum<Scalar>::add_colours(std::size_t light, const Block& normals, Block& colours) const {
  const auto weight = weights_.row(static_cast<Index>(light));
  if ((weight == 0).all()) return;
  for_lit(light, normals, [&](Index row, int channel, const typename Block::Value& reflected) {
    add_to(&colours.values(row, channel), reflected * weight[channel]);
  });
}

template <typename Scalar>
void DifferentiableSum<Scalar>::find_transport(const PlanesRef<Scalar>& normals, TransportRef<Scalar> result) const {
  using Value = typename Block::Value;
  const Index lights = std::ssize(grid_);
  PARTWISE_CHECK(result.rows(), ==, normals.rows());
  PARTWISE_CHECK(result.cols(), ==, 3 * lights);
  result.setZero();
  for_blocks(normals.rows(), lights, [&](Index n, Index l) {
    const Block some(normals, n);
    for (Index i = l * light_block; i < std::min(lights, (l + 1) * light_block); ++i) {
      const Scalar solid_angle = grid_[static_cast<std::size_t>(i)].solid_angle;
      for_lit(static_cast<std::size_t>(i), some, [&](Index row, int channel, const Value& reflected) {
        const Value arriving = reflected * solid_angle;
        const Index rows = std::min(Block::width, some.rows - row);
        std::memcpy(&result(n * normal_block + row, channel * lights + i), &arriving,
                    static_cast<std::size_t>(rows) * sizeof(Scalar));
      });
    }
  });
}

template <typename Scalar>
Planes<Scalar> DifferentiableSum<Scalar>::colours(const PlanesRef<Scalar>& normals) const {
  const Index lights = std::ssize(grid_), light_blocks = blocks(lights, light_block);
  std::vector<Planes<Scalar>> parts(static_cast<std::size_t>(blocks(normals.rows(), normal_block) * light_blocks));
  for_blocks(normals.rows(), lights, [&](Index n, Index l) {
    const Block some(normals, n);
    Block sum(some.rows);
    for (Index i = l * light_block; i < std::min(lights, (l + 1) * light_block); ++i) {
      add_colours(static_cast<std::size_t>(i), some, sum);
    }
    parts[static_cast<std::size_t>(n * light_blocks + l)] = std::move(sum.values);
  });
  Planes<Scalar> result = Planes<Scalar>::Zero(normals.rows(), 3);
  for (Index n = 0; n * normal_block < normals.rows(); ++n) {
    auto rows = result.middleRows(n * normal_block, std::min(normal_block, normals.rows() - n * normal_block));
    for (Index l = 0; l < light_blocks; ++l) {
      rows += parts[static_cast<std::size_t>(n * light_blocks + l)].topRows(rows.rows());
    }
  }
  return result;
}

template <typename Scalar>
void DifferentiableSum<Scalar>::add_gradient(std::size_t light, const Block& normals, const Block& of_colours,
                                             GradientWanted wanted, Block& of_normals, LightShare& of_light) const {
  using Value = typename Block::Value;
  const LightPixel<Scalar>& pixel = grid_[light];
  const auto weight = weights_.row(static_cast<Index>(light));
  std::array<Value, lobe_total> of_log_kappa{}, of_gamma{};
  std::array<Value, 3> of_radiance{};
  const LobeLanes<Scalar> lobes(lobes_[light]);
  for (Index row = 0; row < normals.values.rows(); row += Block::width) {
    const std::array<Value, 3> normal = normals.at(row);
    const Value cosine = dot(normal, pixel.direction);
    if (!any_positive(cosine)) continue;
    const HalfCosines<Scalar> half(normal, pixel.half_vector);
    Value of_cosine{}, of_half_cosine{};
    for (int channel = 0; channel < 3; ++channel) {
      const Value upstream = load(&of_colours.values(row, channel));
      const Value given = cosine > 0 ? upstream : Value{};
      const Value arriving = given * cosine * weight[channel];
      Value value{}, steepness{};
      for (int r = 0; r < dsbrdf_lobe_count; ++r) {
        const std::size_t lobe = lobe_number(channel, r);
        LobeValue<Value> at;
        if (!lobes.evaluate(lobe, half.log(r), at)) continue;
        const Value change = arriving * at.slope;
        value += at.value;
        of_log_kappa[lobe] += change;
        of_gamma[lobe] += change * half.log(r);
        steepness += at.slope * lobes_[light].gamma[lobe] * half.log_slope(r);
      }
      of_radiance[static_cast<std::size_t>(channel)] += given * cosine * value;
      of_cosine += given * weight[channel] * value;
      of_half_cosine += arriving * steepness;
    }
    if (!wanted.normals) continue;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      add_to(&of_normals.values(row, k), of_cosine * pixel.direction[at] + of_half_cosine * pixel.half_vector[at]);
    }
  }
  PixelLobes<Scalar> of_lobes;
  for (std::size_t at = 0; at < lobe_total; ++at) {
    of_lobes.log_kappa[at] = sum(of_log_kappa[at]);
    of_lobes.gamma[at] = sum(of_gamma[at]);
  }
  of_light.lobes.push_back(of_lobes);
  of_light.radiance.push_back({pixel.solid_angle * sum(of_radiance[0]), pixel.solid_angle * sum(of_radiance[1]),
                               pixel.solid_angle * sum(of_radiance[2])});
}

template <typename Scalar>
SumGradient<Scalar> DifferentiableSum<Scalar>::gradient(const PlanesRef<Scalar>& normals,
                                                        const PlanesRef<Scalar>& of_colours,
                                                        GradientWanted wanted) const {
  PARTWISE_CHECK(normals.rows(), ==, of_colours.rows());
  const Index lights = std::ssize(grid_), light_blocks = blocks(lights, light_block),
              normal_blocks = blocks(normals.rows(), normal_block);
  std::vector<Planes<Scalar>> normal_parts(static_cast<std::size_t>(normal_blocks * light_blocks));
  std::vector<LightShare> light_parts(normal_parts.size());
  for_blocks(normals.rows(), lights, [&](Index n, Index l) {
    const Block some(normals, n), given(of_colours, n);
    Block of_some(some.rows);
    const auto part = static_cast<std::size_t>(n * light_blocks + l);
    for (Index i = l * light_block; i < std::min(lights, (l + 1) * light_block); ++i) {
      add_gradient(static_cast<std::size_t>(i), some, given, wanted, of_some, light_parts[part]);
    }
    normal_parts[part] = std::move(of_some.values);
  });

  SumGradient<Scalar> result;
  if (wanted.normals) result.normals = Planes<Scalar>::Zero(normals.rows(), 3);
  if (wanted.radiance) result.radiance = Planes<Scalar>::Zero(lights, 3);
  std::vector<PixelLobes<Scalar>> of_lobes(grid_.size());
  for (Index n = 0; n < normal_blocks; ++n) {
    for (Index l = 0; l < light_blocks; ++l) {
      const auto part = static_cast<std::size_t>(n * light_blocks + l);
      if (wanted.normals) {
        const Index rows = std::min(normal_block, normals.rows() - n * normal_block);
        result.normals.middleRows(n * normal_block, rows) += normal_parts[part].topRows(rows);
      }
      const LightShare& share = light_parts[part];
      for (std::size_t k = 0; k < share.lobes.size(); ++k) {
        const Index light = l * light_block + static_cast<Index>(k);
        if (wanted.radiance) {
          result.radiance.row(light) += Eigen::Map<const Eigen::Array<Scalar, 1, 3>>(share.radiance[k].data());
        }
        PixelLobes<Scalar>& of = of_lobes[static_cast<std::size_t>(light)];
        for (std::size_t at = 0; at < lobe_total; ++at) {
          of.log_kappa[at] += share.lobes[k].log_kappa[at];
          of.gamma[at] += share.lobes[k].gamma[at];
        }
      }
    }
  }
  if (wanted.material) result.material = coefficient_gradient(grid_, lobes_, of_lobes);
  return result;
}

template class DifferentiableSum<float>;
template class DifferentiableSum<double>;

}  // namespace partwise
