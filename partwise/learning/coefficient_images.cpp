#include "partwise/learning/coefficient_images.h"

#include <tbb/parallel_for.h>
#include <torch/csrc/autograd/custom_function.h>
#include <torch/types.h>

#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/base/error.h"
#include "partwise/learning/coefficient_sum.h"

namespace partwise {
namespace {

using torch::autograd::AutogradContext, torch::autograd::tensor_list;

// An image of a batch with its channels as columns, in place. Tensors are contiguous here.
template <typename Scalar>
auto columns(const at::Tensor& batch, std::int64_t image) {
  const std::int64_t channels = batch.size(1), rows = batch.size(2) * batch.size(3);
  return Eigen::Map<Numbers<Scalar>>(batch.data_ptr<Scalar>() + image * channels * rows, rows, channels);
}

// work(image, sum) for every image, in parallel.
template <typename Scalar, typename Work>
void for_images(const tensor_list& inputs, const Work& work) {
  const at::Tensor &light = inputs[2], &mean = inputs[3], &components = inputs[4];
  const auto grid = light_grid<Scalar>(static_cast<int>(light.size(2)), static_cast<int>(light.size(3)));
  const Eigen::Map<const Coefficients<Scalar>> mean_material(mean.data_ptr<Scalar>());
  const Eigen::Map<const Numbers<Scalar>> basis(components.data_ptr<Scalar>(), dsbrdf_size, components.size(0));
  tbb::parallel_for(std::int64_t(0), light.size(0), [&](std::int64_t i) {
    const CoefficientSum<Scalar> sum(grid, mean_material, basis, columns<Scalar>(light, i));
    work(i, sum);
  });
}

template <typename Work>
void with_scalar(const at::Tensor& tensor, const Work& work) {
  tensor.scalar_type() == at::kFloat ? work(0.0f) : work(0.0);
}

struct CoefficientImages : torch::autograd::Function<CoefficientImages> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& normals, const at::Tensor& psi,
                            const at::Tensor& light, const at::Tensor& mean, const at::Tensor& components) {
    const tensor_list inputs{normals, psi, light, mean, components};
    context->save_for_backward(inputs);
    at::Tensor images = at::empty_like(normals);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      for_images<Scalar>(inputs, [&](std::int64_t i, const CoefficientSum<Scalar>& sum) {
        columns<Scalar>(images, i) = sum.colours(columns<Scalar>(normals, i), columns<Scalar>(psi, i));
      });
    });
    return images;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& of_results) {
    const tensor_list inputs = context->get_saved_variables();
    const at::Tensor &normals = inputs[0], &psi = inputs[1], of_images = of_results[0].contiguous();
    const at::Tensor of_normals = at::empty_like(normals), of_psi = at::empty_like(psi),
                     of_light = at::empty_like(inputs[2]);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      for_images<Scalar>(inputs, [&](std::int64_t i, const CoefficientSum<Scalar>& sum) {
        const auto found =
            sum.gradient(columns<Scalar>(normals, i), columns<Scalar>(psi, i), columns<Scalar>(of_images, i));
        columns<Scalar>(of_normals, i) = found.normals;
        columns<Scalar>(of_psi, i) = found.psi;
        columns<Scalar>(of_light, i) = found.radiance;
      });
    });
    return {of_normals, of_psi, of_light, at::Tensor(), at::Tensor()};
  }
};

}  // namespace

CoefficientBasis CoefficientBasis::of(const DsbrdfBasis& basis, at::ScalarType type) {
  const auto tensor = [&](const double* values, std::int64_t rows) {
    at::Tensor result = at::empty({rows, dsbrdf_size}, at::kDouble);
    std::copy_n(values, result.numel(), result.data_ptr<double>());
    return result.to(type);
  };
  return {tensor(basis.mean.data(), 1)[0], tensor(basis.components.data(), basis.size())};
}

at::Tensor coefficient_images(const at::Tensor& normals, const at::Tensor& psi, const at::Tensor& light,
                              const CoefficientBasis& basis) {
  for (const at::Tensor& each : {normals, psi, light}) {
    PARTWISE_CHECK(each.dim(), ==, 4);
    PARTWISE_CHECK(each.size(0), ==, normals.size(0));
  }
  PARTWISE_CHECK(normals.size(1), ==, 3);
  PARTWISE_CHECK(light.size(1), ==, 3);
  for (const int side : {2, 3}) PARTWISE_CHECK(psi.size(side), ==, normals.size(side));
  PARTWISE_CHECK(basis.mean.dim(), ==, 1);
  PARTWISE_CHECK(basis.mean.size(0), ==, dsbrdf_size);
  PARTWISE_CHECK(basis.components.dim(), ==, 2);
  PARTWISE_CHECK(basis.components.size(0), ==, psi.size(1));
  PARTWISE_CHECK(basis.components.size(1), ==, dsbrdf_size);
  for (const at::Tensor& each : {normals, psi, light, basis.mean, basis.components}) {
    PARTWISE_CHECK(each.is_cpu(), ==, true);
    PARTWISE_CHECK(each.scalar_type() == at::kFloat || each.scalar_type() == at::kDouble, ==, true);
    PARTWISE_CHECK(each.scalar_type() == normals.scalar_type(), ==, true);
  }
  return CoefficientImages::apply(normals.contiguous(), psi.contiguous(), light.contiguous(), basis.mean.contiguous(),
                                  basis.components.contiguous());
}

}  // namespace partwise
