#include "partwise/learning/disk_lookup.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "partwise/appearance/rendering/normal_disk.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

using Index = Eigen::Index;
constexpr Index pixel_block = 4096;

// work(block, first row, last row) for every block of rows, in parallel.
template <typename Work>
void for_pixel_blocks(Index rows, const Work& work) {
  tbb::parallel_for(Index(0), (rows + pixel_block - 1) / pixel_block,
                    [&](Index block) { work(block, block * pixel_block, std::min(rows, (block + 1) * pixel_block)); });
}

}  // namespace

// One pixel's 16 texels, how much of each it takes, and how that changes to the right and downwards.
template <typename Scalar>
struct DiskLookup<Scalar>::Lookup {
  std::array<Index, 16> texel;
  std::array<Scalar, 16> weight, right, down;

  Lookup(const DiskLookup& map, const Eigen::Matrix<Scalar, 3, 1>& normal) {
    const DiskPlace<Scalar> at(disk_point<Scalar>(normal), map.size_);
    const auto in_row = cubic_weights(at.right), in_column = cubic_weights(at.below);
    const auto row_slopes = cubic_slopes(at.right), column_slopes = cubic_slopes(at.below);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const int row = at.y - 1 + static_cast<int>(j), column = at.x - 1 + static_cast<int>(i);
        texel[4 * j + i] = map.texel_[static_cast<std::size_t>(row * map.size_ + column)];
        weight[4 * j + i] = in_column[j] * in_row[i];
        right[4 * j + i] = in_column[j] * row_slopes[i];
        down[4 * j + i] = column_slopes[j] * in_row[i];
      }
    }
  }

  Scalar sum(const std::array<Scalar, 16>& factors, const PlanesRef<Scalar>& texels, int channel) const {
    Scalar total = 0;
    for (std::size_t k = 0; k < 16; ++k) {
      if (texel[k] >= 0) total += factors[k] * texels(texel[k], channel);
    }
    return total;
  }
};

template <typename Scalar>
DiskLookup<Scalar>::DiskLookup(int size) : size_(size) {
  PARTWISE_CHECK(size, >=, 8);
  const DiskTexels texels = disk_texels(size);
  normals_.resize(std::ssize(texels.normals), 3);
  texel_.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), -1);
  for (std::size_t i = 0; i < texels.normals.size(); ++i) {
    normals_.row(static_cast<Index>(i)) = texels.normals[i].transpose().array().template cast<Scalar>();
    texel_[static_cast<std::size_t>(texels.index[i])] = static_cast<int>(i);
  }
}

template <typename Scalar>
Planes<Scalar> DiskLookup<Scalar>::colours(const PlanesRef<Scalar>& texels, const PlanesRef<Scalar>& normals) const {
  PARTWISE_CHECK(texels.rows(), ==, normals_.rows());
  Planes<Scalar> result = Planes<Scalar>::Zero(normals.rows(), 3);
  for_pixel_blocks(normals.rows(), [&](Index, Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      if ((normals.row(i) == 0).all()) continue;
      const Lookup lookup(*this, normals.row(i).matrix().transpose());
      for (int channel = 0; channel < 3; ++channel) {
        result(i, channel) = std::max(lookup.sum(lookup.weight, texels, channel), Scalar(0));
      }
    }
  });
  return result;
}

template <typename Scalar>
LookupGradient<Scalar> DiskLookup<Scalar>::gradient(const PlanesRef<Scalar>& texels, const PlanesRef<Scalar>& normals,
                                                    const PlanesRef<Scalar>& of_colours) const {
  PARTWISE_CHECK(texels.rows(), ==, normals_.rows());
  PARTWISE_CHECK(of_colours.rows(), ==, normals.rows());
  const auto steps = static_cast<Scalar>(disk_steps(size_)) / 2;  // texels a unit of the disk
  LookupGradient<Scalar> result{Planes<Scalar>::Zero(texels.rows(), 3), Planes<Scalar>::Zero(normals.rows(), 3)};
  std::vector<Planes<Scalar>> parts(static_cast<std::size_t>((normals.rows() + pixel_block - 1) / pixel_block));
  for_pixel_blocks(normals.rows(), [&](Index block, Index first, Index last) {
    Planes<Scalar>& of_texels = parts[static_cast<std::size_t>(block)];
    of_texels = Planes<Scalar>::Zero(texels.rows(), 3);
    for (Index i = first; i < last; ++i) {
      if ((normals.row(i) == 0).all()) continue;
      const Eigen::Matrix<Scalar, 3, 1> normal = normals.row(i).matrix().transpose();
      const Lookup lookup(*this, normal);
      Eigen::Matrix<Scalar, 2, 1> of_point(0, 0);
      for (int channel = 0; channel < 3; ++channel) {
        if (!(lookup.sum(lookup.weight, texels, channel) > 0)) continue;
        const Scalar given = of_colours(i, channel);
        of_point.x() += given * steps * lookup.sum(lookup.right, texels, channel);
        of_point.y() -= given * steps * lookup.sum(lookup.down, texels, channel);
        for (std::size_t k = 0; k < 16; ++k) {
          if (lookup.texel[k] >= 0) of_texels(lookup.texel[k], channel) += given * lookup.weight[k];
        }
      }
      result.normals.row(i) = (of_point.transpose() * disk_point_slopes<Scalar>(normal)).array();
    }
  });
  for (const Planes<Scalar>& part : parts) result.texels += part;
  return result;
}

template class DiskLookup<float>;
template class DiskLookup<double>;

}  // namespace partwise
