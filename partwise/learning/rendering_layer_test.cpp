#include "partwise/learning/rendering_layer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/reflectance_map.h"
#include "partwise/base/error.h"
#include "partwise/learning/disk_lookup.h"
#include "partwise/learning/test_learning.h"
#include "partwise/learning/test_plain_rendering.h"

namespace partwise {
namespace {

// A batch of two: a cloth and a glossy material, each with its own light and normals.
struct Batch {
  at::Tensor normals, material, light;

  explicit Batch(at::ScalarType type, int rows = 5, int columns = 7, int light_rows = 6) {
    std::mt19937 random(21);
    const auto as_tensor = [&](Planes<double> planes, std::int64_t height) {
      return torch::from_blob(planes.data(), {3, height, planes.rows() / height}, torch::kDouble).clone();
    };
    std::vector<at::Tensor> some_normals, some_materials, some_lights;
    for (const bool cloth : {true, false}) {
      Coefficients<double> coefficients = test::random_material(random, cloth);
      some_normals.push_back(as_tensor(test::random_normals(random, rows * columns), rows));
      some_materials.push_back(torch::from_blob(coefficients.data(), {dsbrdf_size}, torch::kDouble).clone());
      some_lights.push_back(as_tensor(test::random_radiance(random, 2 * light_rows * light_rows), light_rows));
    }
    normals = torch::stack(some_normals).to(type).requires_grad_();
    material = torch::stack(some_materials).to(type).requires_grad_();
    light = torch::stack(some_lights).to(type).requires_grad_();
  }

  std::vector<at::Tensor> gradients(const at::Tensor& images) const {
    for (const at::Tensor& each : {normals, material, light}) each.mutable_grad() = at::Tensor();
    (images * torch::linspace(-1, 2, images.numel(), images.options().requires_grad(false)).view_as(images))
        .sum()
        .backward();
    return {normals.grad().clone(), material.grad().clone(), light.grad().clone()};
  }
};

double difference(const at::Tensor& a, const at::Tensor& b) { return ((a - b).norm() / b.norm()).item<double>(); }

// By the plain tensors, pixel by pixel or texel by texel.
at::Tensor plain_colours(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light) {
  const test::PlainRendering plain(static_cast<int>(light.size(1)), static_cast<int>(light.size(2)),
                                   light.scalar_type());
  return plain.colours(normals, material, light);
}

at::Tensor plain_images(const Batch& batch) {
  std::vector<at::Tensor> images;
  for (int i = 0; i < 2; ++i) {
    const at::Tensor colours = plain_colours(batch.normals[i].reshape({3, -1}).t(), batch.material[i], batch.light[i]);
    images.push_back(colours.t().reshape_as(batch.normals[i]));
  }
  return torch::stack(images);
}

TEST(RenderingLayer, ExactImagesAndTheirGradientsAreThoseOfPlainTensors) {
  const Batch batch(torch::kDouble);
  const at::Tensor plain = plain_images(batch), images = exact_images(batch.normals, batch.material, batch.light);
  EXPECT_LT(difference(images, plain), 1e-12);
  EXPECT_EQ(images[0].select(1, 0).select(1, 0).abs().sum().item<double>(), 0);  // background
  const auto expected = batch.gradients(plain), found = batch.gradients(images);
  // Of a background pixel plain tensors find how it would change were it none.
  const at::Tensor seen = (batch.normals.detach().norm(2, 1, true) > 0).to(torch::kDouble);
  EXPECT_LT(difference(found[0], expected[0] * seen), 1e-10);
  EXPECT_LT(difference(found[1], expected[1]), 1e-10);
  EXPECT_LT(difference(found[2], expected[2]), 1e-10);
}

TEST(RenderingLayer, MappedImagesAndTheirGradientsAreThoseOfLookupsInPlainTensors) {
  const Batch batch(torch::kDouble);
  const int size = 12;
  const DiskLookup<double> lookup(size);
  Planes<double> disk = lookup.normals();
  const at::Tensor texel_normals = torch::from_blob(disk.data(), {3, disk.rows()}, torch::kDouble).t();
  const at::Tensor images = mapped_images(batch.normals, batch.material, batch.light, size);
  const auto found = batch.gradients(images);
  // Lookups are linear in texels: the gradient through the map is theirs, taken on by plain tensors.
  const at::Tensor factors = torch::linspace(-1, 2, images.numel(), torch::kDouble).view_as(images).contiguous();
  const at::Tensor normals = batch.normals.detach().contiguous();
  for (int i = 0; i < 2; ++i) {
    const at::Tensor material = batch.material[i].detach().requires_grad_(),
                     light = batch.light[i].detach().requires_grad_();
    const at::Tensor texels = plain_colours(texel_normals, material, light);
    const at::Tensor texel_planes = texels.detach().t().contiguous();
    const auto planes = [&](const at::Tensor& tensor) {
      return Eigen::Map<const Planes<double>>(tensor.data_ptr<double>(), tensor.numel() / 3, 3);
    };
    const at::Tensor own = normals[i].contiguous(), own_factors = factors[i].contiguous();
    const Planes<double> colours = lookup.colours(planes(texel_planes), planes(own));
    EXPECT_LT((planes(images[i].detach().contiguous()) - colours).abs().maxCoeff(), 1e-12 * colours.maxCoeff());
    Planes<double> of_texels = lookup.gradient(planes(texel_planes), planes(own), planes(own_factors)).texels;
    texels.backward(torch::from_blob(of_texels.data(), {3, disk.rows()}, torch::kDouble).t());
    EXPECT_LT(difference(found[1][i], material.grad()), 1e-10);
    EXPECT_LT(difference(found[2][i], light.grad()), 1e-10);
  }
}

TEST(RenderingLayer, TransportedMapsAndTheirGradientsToLightAreThoseOfReflectanceMaps) {
  for (const at::ScalarType type : {torch::kDouble, torch::kFloat}) {
    const Batch batch(type);
    const double tolerance = type == torch::kDouble ? 1e-12 : 1e-5;
    const int size = 13;
    const at::Tensor transport = map_transport(batch.material, 6, 12, size);
    EXPECT_FALSE(transport.requires_grad());
    const auto maps_and_gradient = [&](const at::Tensor& maps, const at::Tensor& light) {
      (maps * torch::linspace(-1, 2, maps.numel(), type).view_as(maps)).sum().backward();
      const at::Tensor gradient = light.grad().clone();
      light.mutable_grad() = at::Tensor();
      return std::pair(maps.detach(), gradient);
    };
    const auto expected = maps_and_gradient(reflectance_maps(batch.material, batch.light, size), batch.light),
               found = maps_and_gradient(transported_maps(transport, batch.light), batch.light);
    ASSERT_EQ(found.first.sizes(), expected.first.sizes());
    EXPECT_LT(difference(found.first, expected.first), tolerance);
    EXPECT_LT(difference(found.second, expected.second), tolerance);
    // One light on both materials.
    const at::Tensor one = batch.light.detach().narrow(0, 0, 1);
    EXPECT_LT(difference(transported_maps(transport, one),
                         reflectance_maps(batch.material, one.expand({2, -1, -1, -1}), size)),
              tolerance);
    EXPECT_THROW(transported_maps(transport, one.narrow(2, 0, 5)), CheckFailed);
  }
}

// Which takes its texels from a table of the material, good to half a percent.
TEST(RenderingLayer, MappedImagesAreThoseOfAReflectanceMap) {
  const Batch batch(torch::kFloat, 20, 20, 16);
  const at::Tensor normals = batch.normals[0].detach().reshape({3, -1}).t().contiguous();
  const EnvironmentLight light = shipped_light("studio").resized(64, 32);
  at::Tensor radiance = torch::empty({1, 32, 64, 3});
  std::ranges::copy(light.radiance().values, radiance.data_ptr<float>());
  for (const char* name : {"pink-felt", "yellow-plastic", "nickel"}) {
    const Dsbrdf material = shipped_material(name).brdf;
    DsbrdfCoefficients coefficients = material.coefficients();
    const at::Tensor images =
        mapped_images(batch.normals.detach().narrow(0, 0, 1),
                      torch::from_blob(coefficients.data(), {1, dsbrdf_size}, torch::kDouble).to(torch::kFloat),
                      radiance.permute({0, 3, 1, 2}), 48);
    const at::Tensor colours = images[0].reshape({3, -1}).t().contiguous();
    const ReflectanceMap map(material, light_samples(light), 48);
    for (std::int64_t k = 1; k < normals.size(0); ++k) {
      const Eigen::Vector3f expected = map.colour(Eigen::Map<const Eigen::Vector3f>(normals.data_ptr<float>() + 3 * k));
      const Eigen::Vector3f found = Eigen::Map<const Eigen::Vector3f>(colours.data_ptr<float>() + 3 * k);
      EXPECT_LT((found - expected).norm(), 5e-3f * expected.norm()) << name << " pixel " << k;
    }
  }
}

TEST(RenderingLayer, GradientsMeetFiniteDifferences) {
  const Batch batch(torch::kDouble, 3, 4, 4);
  const auto both = {exact_images, +[](const at::Tensor& n, const at::Tensor& m, const at::Tensor& l) {
                       return mapped_images(n, m, l, 10);
                     }};
  for (const auto& render : both) {
    const auto loss = [&] {
      const at::NoGradGuard guard;
      const at::Tensor images = render(batch.normals, batch.material, batch.light);
      return (images * torch::linspace(-1, 2, images.numel(), torch::kDouble).view_as(images)).sum().item<double>();
    };
    const auto gradients = batch.gradients(render(batch.normals, batch.material, batch.light));
    const at::Tensor inputs[] = {batch.normals, batch.material, batch.light};
    for (std::size_t k = 0; k < 3; ++k) {
      using Flat = Eigen::Map<Eigen::ArrayXd>;
      at::Tensor input = inputs[k].detach();  // the same memory
      Flat values(input.data_ptr<double>(), input.numel());
      Eigen::ArrayXd gradient = Flat(gradients[k].data_ptr<double>(), input.numel());
      if (k > 0) {
        test::expect_gradient(values, gradient, loss);
        continue;
      }
      // Background is left as it is: all components but those of the first pixel of each image.
      for (Eigen::Index image = 0; image < 2; ++image) {
        for (Eigen::Index plane = 0; plane < 3; ++plane) {
          const Eigen::Index from = 36 * image + 12 * plane + 1;
          Flat part(values.data() + from, 11);
          test::expect_gradient(part, gradient.segment(from, 11).eval(), loss);
        }
      }
    }
  }
}

TEST(RenderingLayer, FloatsAgreeWithDoublesInEitherForm) {
  const Batch floats(torch::kFloat, 16, 16, 16), doubles(torch::kDouble, 16, 16, 16);
  const auto compare = [&](const auto& render, double tolerance) {
    const at::Tensor single = render(floats.normals, floats.material, floats.light),
                     twice = render(doubles.normals, doubles.material, doubles.light);
    EXPECT_EQ(single.scalar_type(), torch::kFloat);
    EXPECT_LT(difference(single.to(torch::kDouble), twice), tolerance);
    const auto a = floats.gradients(single), b = doubles.gradients(twice);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(difference(a[k].to(torch::kDouble), b[k]), 10 * tolerance) << k;
  };
  compare(exact_images, 2e-5);
  compare([](const auto& n, const auto& m, const auto& l) { return mapped_images(n, m, l, 24); }, 2e-5);
}

TEST(RenderingLayer, WhatNeedsNoGradientGetsNone) {
  Batch batch(torch::kFloat);
  const at::Tensor normals = batch.normals.detach(), light = batch.light.detach();
  exact_images(batch.normals, batch.material, batch.light).sum().backward();
  const at::Tensor all = batch.material.grad().clone();
  batch.material.mutable_grad() = at::Tensor();
  exact_images(normals, batch.material, light).sum().backward();
  EXPECT_TRUE(torch::equal(batch.material.grad(), all));
  EXPECT_FALSE(normals.grad().defined());
}

TEST(RenderingLayer, StridesDoNotMatter) {
  const Batch batch(torch::kFloat);
  const at::Tensor turned = batch.normals.detach().transpose(2, 3).contiguous().transpose(2, 3);
  ASSERT_FALSE(turned.is_contiguous());
  EXPECT_TRUE(torch::equal(exact_images(turned, batch.material, batch.light),
                           exact_images(batch.normals, batch.material, batch.light)));
}

TEST(RenderingLayer, TheSameBitsForAnyNumberOfThreads) {
  const Batch batch(torch::kFloat, 50, 60, 20);
  const auto results = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<at::Tensor> all = batch.gradients(exact_images(batch.normals, batch.material, batch.light));
    for (const at::Tensor& each : batch.gradients(mapped_images(batch.normals, batch.material, batch.light, 32))) {
      all.push_back(each);
    }
    return all;
  };
  const auto one = results(1), many = results(4);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_TRUE(torch::equal(one[k], many[k])) << k;
}

TEST(RenderingLayer, OtherShapesAndTypesAreRefused) {
  const Batch batch(torch::kFloat);
  EXPECT_THROW(exact_images(batch.normals[0], batch.material, batch.light), CheckFailed);
  EXPECT_THROW(exact_images(batch.normals, batch.material.narrow(1, 0, 107), batch.light), CheckFailed);
  EXPECT_THROW(exact_images(batch.normals, batch.material.narrow(0, 0, 1), batch.light), CheckFailed);
  EXPECT_THROW(exact_images(batch.normals.to(torch::kDouble), batch.material, batch.light), CheckFailed);
  EXPECT_THROW(exact_images(batch.normals.to(torch::kHalf), batch.material, batch.light), CheckFailed);
  EXPECT_THROW(mapped_images(batch.normals, batch.material, batch.light, 7), CheckFailed);
  const at::Tensor maps = reflectance_maps(batch.material, batch.light, 12);
  EXPECT_THROW(looked_up_images(batch.normals, maps, 13), CheckFailed);
  EXPECT_THROW(looked_up_images(batch.normals, maps.narrow(0, 0, 1), 12), CheckFailed);
}

}  // namespace
}  // namespace partwise
