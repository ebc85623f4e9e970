#include "partwise/editing/edit_samples.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>

#include "partwise/base/error.h"
#include "partwise/editing/material_range.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/editing/test_editing.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {
namespace {

TEST(DisplayValues, AsTheyAreShown) {
  const at::Tensor linear = at::tensor({0.0, 0.18, 1.0, 10.0, -3.0}, at::kDouble);
  const at::Tensor shown = display_values(linear);
  EXPECT_EQ(shown[0].item<double>(), 0);
  EXPECT_NEAR(shown[1].item<double>(), std::pow(0.18, 1 / 2.2), 1e-2);
  EXPECT_DOUBLE_EQ(shown[2].item<double>(), 1);
  EXPECT_NEAR(shown[3].item<double>(), 1 + 0.1 * std::log(10), 1e-12);
  EXPECT_EQ(shown[4].item<double>(), 0);
  at::Tensor any = at::tensor({0.0, 1e-6, 0.5, 1.0, 1e6}, at::kDouble).requires_grad_();
  display_values(any).sum().backward();
  EXPECT_TRUE(any.grad().isfinite().all().item<bool>());
  EXPECT_TRUE((any.grad() > 0).all().item<bool>());
}

TEST(MaterialRange, ThereAndBack) {
  const auto materials = test::materials();
  const MaterialRange range = MaterialRange::of(materials);
  at::Tensor all = at::empty({static_cast<std::int64_t>(materials.size()), dsbrdf_size});
  for (std::size_t i = 0; i < materials.size(); ++i) all[static_cast<std::int64_t>(i)] = as_tensor(materials[i]);
  const at::Tensor scaled = range.scaled(all);
  EXPECT_NEAR(scaled.min().item<double>(), -0.95, 1e-5);
  EXPECT_NEAR(scaled.max().item<double>(), 0.95, 1e-5);
  EXPECT_LT((range.coefficients(scaled) - all).abs().max().item<double>(), 1e-4);
  EXPECT_LT((as_material(as_tensor(materials[2])) - materials[2]).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_THROW(MaterialRange::of({}), CheckFailed);
}

TEST(MaterialRange, VariationsHaveTheCovarianceOfTheMaterials) {
  const auto materials = test::materials();
  const MaterialRange range = MaterialRange::of(materials);
  const auto count = static_cast<std::int64_t>(materials.size());
  at::Tensor all = at::empty({count, dsbrdf_size});
  for (std::size_t i = 0; i < materials.size(); ++i) all[static_cast<std::int64_t>(i)] = as_tensor(materials[i]);
  const at::Tensor rows = range.variations(materials), covariance = range.scaled(all).t().cov();
  EXPECT_EQ(rows.size(0), count + dsbrdf_size);
  const at::Tensor found = rows.t().matmul(rows),
                   shrunk = 0.98 * covariance + 0.02 * covariance.trace() / 108 * at::eye(108);
  EXPECT_LT((found - shrunk).abs().max().item<double>(), 1e-5);
  EXPECT_GT(covariance.abs().max().item<double>(), 0.1);
  EXPECT_THROW(range.variations({materials.data(), 1}), CheckFailed);
}

TEST(EditSamples, AreWhatTheLayerRenders) {
  const EditSamples plain = test::samples(false);
  const EditBatch batch = plain.batch(3, {0, 8, 8});
  const auto error = [&](const at::Tensor& image, const at::Tensor& material) {
    const at::Tensor rendered = mapped_images(batch.normals, material, batch.radiance, 64);
    return (rendered - image).abs().mean({1, 2, 3}) / image.abs().mean({1, 2, 3});
  };
  // Tables of the material and texel centres differ a little; mirrors are not among the materials.
  EXPECT_LT(error(batch.image, batch.material).max().item<double>(), 0.03);
  EXPECT_LT(error(batch.target, batch.target_material).max().item<double>(), 0.03);
  EXPECT_GT(error(batch.target, batch.material).max().item<double>(), 0.1);
  const at::Tensor mask = batch.mask();
  for (int i = 0; i < 8; ++i) {
    const at::Tensor object = batch.image[i].masked_select(mask[i].expand({3, -1, -1}) > 0);
    EXPECT_NEAR(object.median().item<double>(), 0.18, 1e-4);
    const double share = mask[i].mean().item<double>();
    EXPECT_GT(share, 0.1);
    EXPECT_LT(share, 0.8);
  }
  EXPECT_TRUE((batch.pictures.narrow(1, 0, 3) * (1 - mask)).eq(0).all().item<bool>());
  EXPECT_LE(batch.pictures.max().item<double>(), 1);
  const at::Tensor lengths = batch.normals.square().sum(1, true).sqrt();
  EXPECT_LT((lengths - mask).abs().max().item<double>(), 1e-3);
}

// Where parts differ too, image and target are those of the maps that are handed over.
TEST(EditSamples, PartsWearOneOfTwoMaterialsAndTheTargetTheOther) {
  for (const bool varied : {false, true}) {
    const EditBatch batch = test::samples(varied, 4, 0.8).batch(1, {0, 12, 12});
    const at::Tensor other = batch.other_parts;
    const auto rendered = [&](int here, int there) {
      return looked_up_images(batch.normals * (1 - other), batch.maps.select(1, here), batch.map_size) +
             looked_up_images(batch.normals * other, batch.maps.select(1, there), batch.map_size);
    };
    const auto error = [](const at::Tensor& a, const at::Tensor& b) {
      return ((a - b).norm() / b.norm()).item<double>();
    };
    EXPECT_LT(error(rendered(0, 1), batch.image), 1e-5);
    EXPECT_LT(error(rendered(1, 0), batch.target), 1e-5);
    EXPECT_TRUE(other.mul(other - 1).eq(0).all().item<bool>());
    EXPECT_TRUE((other <= batch.mask()).all().item<bool>());
    const at::Tensor share = other.sum({1, 2, 3}) / batch.mask().sum({1, 2, 3});
    const int mixed = (share > 0).logical_and(share < 1).sum().item<int>();
    EXPECT_GE(mixed, 4);  // of 12
    EXPECT_LT(mixed, 12);
  }
  const EditBatch plain = test::samples(true).batch(1, {0, 4, 4}),
                  mixed = test::samples(true, 4, 1).batch(1, {0, 4, 4});
  EXPECT_FALSE(plain.other_parts.any().item<bool>());
  EXPECT_TRUE(plain.normals.equal(mixed.normals));
}

TEST(EditSamples, PairsExchangeTheirMaterials) {
  const EditBatch batch = test::samples(true).batch(0, {0, 4, 4});
  for (int i = 0; i < 4; i += 2) {
    EXPECT_TRUE(batch.material[i].equal(batch.target_material[i + 1]));
    EXPECT_TRUE(batch.material[i + 1].equal(batch.target_material[i]));
  }
  EXPECT_FALSE(batch.material[0].equal(batch.material[1]));
  // One light, up to exposure.
  const at::Tensor ratio = batch.radiance[0] / batch.radiance[1];
  EXPECT_NEAR(ratio.max().item<double>(), ratio.min().item<double>(), 1e-3 * ratio.max().item<double>());
}

TEST(EditSamples, RowsDependOnTheirNumbersAlone) {
  const EditSamples varied = test::samples(true);
  const EditBatch whole = varied.batch(7, {0, 8, 8});
  for (const Rows& rows : {Rows{0, 4, 8}, Rows{4, 4, 8}, Rows{2, 3, 8}}) {
    const EditBatch part = varied.batch(7, rows);
    EXPECT_TRUE(part.pictures.equal(whole.pictures.narrow(0, rows.first, rows.count)));
    EXPECT_TRUE(part.target.equal(whole.target.narrow(0, rows.first, rows.count)));
    EXPECT_TRUE(part.radiance.equal(whole.radiance.narrow(0, rows.first, rows.count)));
  }
  EXPECT_FALSE(varied.batch(8, {0, 8, 8}).pictures.equal(whole.pictures));
}

TEST(StoredViews, MirroringExchangesLeftAndRight) {
  const at::Tensor plain = test::views().normals(0), mirrored = test::views().normals(0, true);
  EXPECT_TRUE(mirrored[1].equal(plain[1].flip(1)));
  EXPECT_TRUE(mirrored[0].equal(-plain[0].flip(1)));
  EXPECT_EQ(test::views().size(), 6);
  EXPECT_TRUE((test::views().parts(2) > 0).equal(test::views().normals(2).square().sum(0) > 0));
  EXPECT_TRUE(test::views().parts(2, true).equal(test::views().parts(2).flip(1)));
}

}  // namespace
}  // namespace partwise
