#include "partwise/learning/coefficient_images.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/learning/rendering_layer.h"
#include "partwise/learning/test_learning.h"
#include "partwise/learning/test_plain_rendering.h"

namespace partwise {
namespace {

// Two images whose every pixel has a material of its own, in the shipped basis.
struct Scene {
  CoefficientBasis basis;
  at::Tensor normals, psi, light;

  explicit Scene(at::ScalarType type, int rows = 4, int columns = 5, int light_rows = 5, int components = 6) {
    torch::manual_seed(8);
    std::mt19937 random(13);
    basis = CoefficientBasis::of(shipped_basis().first(components), type);
    const auto as_tensor = [&](Planes<double> planes, std::int64_t height) {
      return torch::from_blob(planes.data(), {3, height, planes.rows() / height}, torch::kDouble).clone();
    };
    std::vector<at::Tensor> some_normals, some_lights;
    for (int i = 0; i < 2; ++i) {
      some_normals.push_back(as_tensor(test::random_normals(random, rows * columns), rows));
      some_lights.push_back(as_tensor(test::random_radiance(random, 2 * light_rows * light_rows), light_rows));
    }
    normals = torch::stack(some_normals).to(type).requires_grad_();
    psi = torch::randn({2, components, rows, columns}, torch::kDouble).to(type).requires_grad_();
    light = torch::stack(some_lights).to(type).requires_grad_();
  }

  at::Tensor images() const { return coefficient_images(normals, psi, light, basis); }
  std::vector<at::Tensor> gradients(const at::Tensor& of) const {
    for (const at::Tensor& each : {normals, psi, light}) each.mutable_grad() = at::Tensor();
    (of * torch::linspace(-1, 2, of.numel(), of.options().requires_grad(false)).view_as(of)).sum().backward();
    return {normals.grad().clone(), psi.grad().clone(), light.grad().clone()};
  }
};

double difference(const at::Tensor& a, const at::Tensor& b) { return ((a - b).norm() / b.norm()).item<double>(); }

// With all 108 coefficients of every pixel, by the plain tensors.
at::Tensor plain_images(const Scene& scene) {
  const at::Tensor materials =
      torch::einsum("bkhw,kj->bjhw", {scene.psi, scene.basis.components}) + scene.basis.mean.view({1, -1, 1, 1});
  const test::PlainRendering plain(static_cast<int>(scene.light.size(2)), static_cast<int>(scene.light.size(3)),
                                   scene.light.scalar_type());
  std::vector<at::Tensor> pixels;
  for (std::int64_t i = 0; i < 2; ++i) {
    for (std::int64_t y = 0; y < scene.normals.size(2); ++y) {
      for (std::int64_t x = 0; x < scene.normals.size(3); ++x) {
        const auto at = [&](const at::Tensor& image) { return image[i].select(1, y).select(1, x); };
        pixels.push_back(plain.colours(at(scene.normals).unsqueeze(0), at(materials), scene.light[i])[0]);
      }
    }
  }
  return torch::stack(pixels).view({2, scene.normals.size(2), scene.normals.size(3), 3}).permute({0, 3, 1, 2});
}

TEST(CoefficientImages, AndTheirGradientsAreThoseOfPlainTensors) {
  const Scene scene(torch::kDouble);
  const at::Tensor plain = plain_images(scene), images = scene.images();
  EXPECT_LT(difference(images, plain), 1e-12);
  const auto expected = scene.gradients(plain), found = scene.gradients(images);
  // Of a background pixel plain tensors find how it would change were it none.
  const at::Tensor seen = (scene.normals.detach().norm(2, 1, true) > 0).to(torch::kDouble);
  EXPECT_LT(difference(found[0], expected[0] * seen), 1e-10);
  EXPECT_LT(difference(found[1], expected[1]), 1e-10);
  EXPECT_LT(difference(found[2], expected[2]), 1e-10);
}

// One material for all pixels: what the layer for objects renders.
TEST(CoefficientImages, OfOneMaterialAreExactImages) {
  const Scene scene(torch::kDouble, 6, 7, 8, 32);
  const at::Tensor psi = torch::randn({2, 32, 1, 1}, torch::kDouble);
  const at::Tensor material = psi.flatten(1).matmul(scene.basis.components) + scene.basis.mean;
  const at::Tensor images = coefficient_images(scene.normals, psi.expand({2, 32, 6, 7}), scene.light, scene.basis);
  EXPECT_LT(difference(images, exact_images(scene.normals, material, scene.light)), 1e-12);
}

TEST(CoefficientImages, FloatsAgreeWithDoubles) {
  const Scene floats(torch::kFloat, 9, 11, 8, 32), doubles(torch::kDouble, 9, 11, 8, 32);
  const at::Tensor single = floats.images(), twice = doubles.images();
  EXPECT_LT(difference(single.to(torch::kDouble), twice), 5e-5);
  const auto a = floats.gradients(single), b = doubles.gradients(twice);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(difference(a[k].to(torch::kDouble), b[k]), 5e-4) << k;
}

TEST(CoefficientImages, TheSameBitsForAnyNumberOfThreads) {
  const Scene scene(torch::kFloat, 40, 50, 8, 8);
  const auto results = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const at::Tensor images = scene.images();
    std::vector<at::Tensor> all = scene.gradients(images);
    all.push_back(images);
    return all;
  };
  const auto one = results(1), many = results(4);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_TRUE(torch::equal(one[k], many[k])) << k;
}

TEST(CoefficientImages, OtherShapesAndTypesAreRefused) {
  const Scene scene(torch::kFloat);
  EXPECT_THROW(coefficient_images(scene.normals[0], scene.psi, scene.light, scene.basis), CheckFailed);
  EXPECT_THROW(coefficient_images(scene.normals, scene.psi.narrow(1, 0, 5), scene.light, scene.basis), CheckFailed);
  EXPECT_THROW(coefficient_images(scene.normals, scene.psi.narrow(2, 0, 3), scene.light, scene.basis), CheckFailed);
  EXPECT_THROW(coefficient_images(scene.normals, scene.psi.to(torch::kDouble), scene.light, scene.basis), CheckFailed);
}

}  // namespace
}  // namespace partwise
