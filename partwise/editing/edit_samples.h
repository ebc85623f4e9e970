// Pictures to learn editing from, made as they are asked for: views of shapes from disk, put into materials and light
// that are drawn by chance, so that no picture comes twice (dissertation, sections 3.3.3 and 3.4.1).
//
// A batch comes in groups. Of each group a light and two materials are drawn, of each row a view and an exposure; odd
// rows wear the first material and are to be changed into the second, even ones the other way round. A reflectance map
// (appearance/rendering) of each of the two materials shows all of the group, which is what makes this fast.
//   materials   one of those given, or half of the time a blend of two; channels in any order
//   light       photographed maps made over, or lamps (drawn_light.h)
//   view        any, mirrored half of the time; three times in four stretched, turned by up to 15 degrees and leaned,
//               which makes other shapes of those there are (learning/view_warp.h)
//   exposure    the median of the object to 0.18, times 2^-0.75 to 2^0.75
//   parts       of a share of the rows, each wears one or the other of the two materials
// `varied` off: materials, lights, views and exposure as they are, for validation and tests.
//
// Row i of batch b depends on the seed, b and i alone. All on the CPU, on all threads. Errors: CheckFailed where there
// is nothing to draw from.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/learning/rows.h"
#include "partwise/learning/stored_views.h"

namespace partwise {

// Linear colours and radiance are exposed: a picture's value 1 is the largest that it shows.
struct EditBatch {
  at::Tensor pictures;         // B x 4 x S x S: image, as display_values has it, and mask
  at::Tensor normals;          // B x 3 x S x S
  at::Tensor material;         // B x 108, coefficients
  at::Tensor radiance;         // B x 3 x 64 x 128
  at::Tensor image;            // B x 3 x S x S, linear
  at::Tensor target_material;  // B x 108
  at::Tensor target;           // B x 3 x S x S, linear: the same in the target material
  at::Tensor other_parts;      // B x 1 x S x S, 1 where the two materials are exchanged, in image and target alike
  at::Tensor maps;             // B x 2 x 3 x T: what image and target were looked up in (rendering_layer.h)
  int map_size = 0;            // of these

  at::Tensor mask() const { return pictures.narrow(1, 3, 1); }
};

struct EditSamplesSettings {
  std::uint64_t seed = 0;
  int group = 4;      // rows
  int map_size = 64;  // of reflectance maps
  bool varied = true;
  double parts = 0;  // share of rows whose parts differ in material
};

class EditSamples {
 public:
  // What is drawn from; views must outlive this. Lights are resized to 128 x 64.
  EditSamples(const StoredViews& views, std::vector<DsbrdfCoefficients> materials,
              const std::vector<EnvironmentLight>& lights, const EditSamplesSettings& settings);

  EditBatch batch(std::uint64_t number, const Rows& rows) const;

 private:
  struct Group;
  Group group(std::uint64_t batch, std::int64_t number) const;
  void add_row(std::uint64_t batch, std::int64_t row, std::int64_t first, const Group& group, EditBatch& result) const;

  const StoredViews& views_;
  std::vector<DsbrdfCoefficients> materials_;
  std::vector<EnvironmentLight> lights_;
  EditSamplesSettings settings_;
  std::vector<int> texels_;  // of a reflectance map, that lookups reach
};

}  // namespace partwise
