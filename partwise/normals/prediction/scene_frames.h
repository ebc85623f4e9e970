// Pictures of scenes to learn normals from, in memory: frames of RGB-D data (truth/rgbd_folder.h), with the normals
// that their depth tells (truth/depth_normals.h), errors and holes and all. Of rooms that were made (scenes/
// room_dataset.h) materials and light are known as well; their exact normals are not looked at.
//
// All have one size: `width` columns and three quarters as many rows, made up to what 32 divides. Colours and normals
// are means where frames are larger; a frame of another shape is cut above and below, or has empty rows there, whose
// mask is 0. Normals are kept where half of a pixel or more has one, in steps of 1/127. Eight bytes a pixel.
//
// Varied batches are mirrored half of the time, and brighter or darker by up to 2^0.5. Row i of batch b depends on the
// seed, b and i alone. Errors: InputError for frames that cannot be read; Cancelled.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/learning/rows.h"

namespace partwise {

struct SceneBatch {
  at::Tensor pictures;         // B x 4 x H x W: colours as display_values has them, and mask
  at::Tensor normals;          // B x 3 x H x W, zero where the depth tells none
  at::Tensor materials;        // B x 32 x H x W, of the shipped basis (appearance/material/dsbrdf_basis.h)
  at::Tensor materials_known;  // B x 1 x H x W, 1 where they are
  at::Tensor log_radiance;     // B x 3 x 8 x 16 (editing/editing_networks.h)
  at::Tensor light_known;      // B x 1 x 1 x 1

  at::Tensor mask() const { return pictures.narrow(1, 3, 1); }
};

struct RgbdFrame;

class SceneFrames {
 public:
  SceneFrames(const std::vector<std::filesystem::path>& folders, int width, const Progress& progress = {});

  std::int64_t size() const { return static_cast<std::int64_t>(frames_.size()); }
  SceneBatch batch(std::uint64_t seed, std::uint64_t number, const Rows& rows, bool varied) const;

 private:
  struct Frame {
    at::Tensor colours;    // bytes, 3 x H x W
    at::Tensor mask;       // bytes, 1 x H x W
    at::Tensor normals;    // signed bytes, 3 x H x W
    at::Tensor which;      // bytes, H x W: 1 + the material's number, 0 unknown
    at::Tensor materials;  // M + 1 x 32, the first zero
    at::Tensor radiance;   // 3 x 8 x 16; undefined where unknown
  };
  Frame read(const std::filesystem::path& colour, const RgbdFrame& frame) const;

  int width_, height_;
  std::vector<Frame> frames_;
};

}  // namespace partwise
