// Pictures to judge networks of editing by, with the truth behind them: views from shards in materials and light that
// are drawn by number, the same for whoever asks. One material, or one for each part of the view.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/learning/stored_views.h"

namespace CLI {
class App;
}

namespace partwise::bench {

// Batches of one; linear images and radiance are exposed: the median of the object is 0.18.
struct EditCase {
  at::Tensor picture;               // 1 x 4 x S x S, as networks see it
  std::vector<at::Tensor> regions;  // 1 x 1 x S x S each; they make up the mask
  at::Tensor normals;               // 1 x 3 x S x S
  at::Tensor radiance;              // 1 x 3 x 64 x 128
  at::Tensor materials, targets;    // R x 108, coefficients: what is worn, and what is to be worn
  at::Tensor maps;                  // R x 3 x T: what the image was looked up in (learning/rendering_layer.h)
  at::Tensor image, target;         // 1 x 3 x S x S, linear: in either

  at::Tensor mask() const { return picture.narrow(1, 3, 1); }
};

struct EditCaseSettings {
  std::uint64_t seed = 1;
  int map_size = 64;  // of reflectance maps
  bool parts = false;
  bool targets = true;  // rendered as well
};

// What tools that judge networks are told about the pictures. Lights: those that no training of ours sees.
struct JudgedPictures {
  std::vector<std::string> views, lights = {"lobby", "night", "sunrise", "venice"};
  int count = 500;
  EditCaseSettings cases;
};

void add_options(CLI::App& app, JudgedPictures& pictures);

class EditCases {
 public:
  // Shipped materials and lights by name; light files as well.
  EditCases(const StoredViews& views, const std::vector<std::string>& materials, const std::vector<std::string>& lights,
            const EditCaseSettings& settings);

  EditCase operator()(int number) const;

 private:
  const StoredViews& views_;
  std::vector<at::Tensor> materials_;
  std::vector<EnvironmentLight> lights_;
  EditCaseSettings settings_;
};

// Each region looked up in its map: 1 x 3 x S x S, linear.
at::Tensor image_of_maps(const at::Tensor& normals, const std::vector<at::Tensor>& regions, const at::Tensor& maps,
                         int map_size);

// Each region in its material: 1 x 3 x S x S, linear.
at::Tensor image_of_regions(const at::Tensor& normals, const std::vector<at::Tensor>& regions,
                            const at::Tensor& materials, const at::Tensor& radiance, int map_size);

}  // namespace partwise::bench
