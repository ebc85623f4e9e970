#include "partwise/editing/refinement.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>
#include <vector>

#include "partwise/editing/edit_photo.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/editing/test_editing.h"

namespace partwise {
namespace {

struct Truth {
  MaterialRange range = MaterialRange::of(test::materials());
  EditBatch batch = test::samples(false).batch(1, {0, 1, 4});
  PictureLayers layers{batch.normals, range.scaled(batch.material), log_of_radiance(batch.radiance)};
  std::vector<at::Tensor> regions = {batch.mask()};
  RefinementSettings quick{.rounds = 2, .steps = 6, .layer_light = 32, .layer_map = 32};

  at::Tensor picture() const {
    const at::Tensor image = rendered(layers, range, regions, quick).clamp_max(1);
    return at::cat({image, batch.mask()}, 1);
  }
};

TEST(Refinement, WhatExplainsThePictureStays) {
  const Truth truth;
  const Refinement result = refined(truth.layers, truth.range, truth.picture(), truth.regions, truth.quick);
  EXPECT_LT(result.before, 1e-3);
  EXPECT_LT(result.after, 1e-3);
  EXPECT_LT((result.found.normals - truth.layers.normals).abs().max().item<double>(), 1e-2);
}

TEST(Refinement, ComesNearerAndKeepsToItsStart) {
  const Truth truth;
  torch::manual_seed(3);
  PictureLayers start = truth.layers;
  start.normals = truth.layers.normals + 0.15 * torch::randn_like(truth.layers.normals) * truth.batch.mask();
  start.normals = start.normals / (start.normals.square().sum(1, true) + 1e-12).sqrt() * truth.batch.mask();
  start.material = start.material + 0.1 * torch::randn_like(start.material);
  start.log_radiance = start.log_radiance + 0.2 * torch::randn_like(start.log_radiance);
  const Refinement result = refined(start, truth.range, truth.picture(), truth.regions, truth.quick);
  EXPECT_LT(result.after, result.before / 3);
  const at::Tensor lengths = result.found.normals.square().sum(1, true).sqrt();
  EXPECT_LT((lengths - truth.batch.mask()).abs().max().item<double>(), 1e-3);
  RefinementSettings stiff = truth.quick;
  stiff.normal_weight = stiff.light_weight = 1e6;
  const Refinement held = refined(start, truth.range, truth.picture(), truth.regions, stiff);
  EXPECT_LT((held.found.normals - start.normals).abs().max().item<double>(), 1e-2);
  EXPECT_LT((held.found.log_radiance - start.log_radiance).abs().max().item<double>(), 1e-1);
}

// A photo of 90 x 70 that shows a truth's picture: what lies off the object stays, what is edited is what the truth
// looks like in the new material.
TEST(EditPhoto, TheTruthInAnotherMaterial) {
  const Truth truth;
  PhotoLayers layers;
  layers.found = truth.layers;
  layers.regions = truth.regions;
  layers.picture = truth.picture();
  layers.crop = {10, -20, 128};
  Photo photo;
  photo.shown = Image(90, 70, 3, 0.25f);
  photo.alpha = Image(90, 70, 1, 1);
  Image region(90, 70, 1);
  for (int y = 0; y < 70; ++y)
    for (int x = 10; x < 90; ++x) *region.pixel(x, y) = truth.batch.mask()[0][0][y + 20][x - 10].item<float>();
  photo.regions = {region};
  const DsbrdfCoefficients wanted = as_material(truth.batch.target_material[0]);
  const Image image = edited(photo, layers, {wanted});
  const at::Tensor expected = display_values(truth.batch.target).clamp_max(1);
  double error = 0;
  int count = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      for (int c = 0; c < 3; ++c) {
        if (*region.pixel(x, y) == 0) {
          ASSERT_EQ(image.pixel(x, y)[c], 0.25f);
        } else {
          error += std::abs(image.pixel(x, y)[c] - expected[0][c][y + 20][x - 10].item<float>());
          ++count;
        }
      }
    }
  }
  EXPECT_GT(count, 1000);
  EXPECT_LT(error / count, 0.01);
}

}  // namespace
}  // namespace partwise
