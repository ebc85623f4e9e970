// What cameras saw of shapes, many views in memory: the normals and parts of every pixel, from the shards of data sets.
// Materials and light are put on later, as often and as different as one likes.
//
// Five bytes a pixel: the normal's x and y in steps of 1/32767 and the part. Normals that lean away from the viewer are
// moved to the rim. A pixel counts as object where more than half of it is covered. Errors: InputError for shards that
// cannot be read, hold no normals or masks, or views of different sizes.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/progress.h"

namespace partwise {

struct Image;

class StoredViews {
 public:
  explicit StoredViews(const std::vector<std::filesystem::path>& folders, const Progress& progress = {});

  std::int64_t size() const { return static_cast<std::int64_t>(views_.size()); }
  int side() const { return side_; }  // pixels; views are square

  // 3 x S x S, unit vectors in camera space, zero in the background. Mirrored: left and right exchanged.
  at::Tensor normals(std::int64_t view, bool mirrored = false) const;
  // S x S of bytes: part + 1, 0 in the background.
  at::Tensor parts(std::int64_t view, bool mirrored = false) const;

 private:
  struct View {
    std::vector<std::int16_t> x, y;
    std::vector<std::uint8_t> part;
  };
  void add(const std::string& place, const Image& normals, const Image& mask, const Image& parts);

  int side_ = 0;
  std::vector<View> views_;
};

}  // namespace partwise
