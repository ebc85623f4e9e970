#include "partwise/learning/rendering_layer.h"

#include <tbb/parallel_for.h>
#include <torch/csrc/autograd/custom_function.h>
#include <torch/types.h>

#include "partwise/base/error.h"
#include "partwise/learning/disk_lookup.h"

namespace partwise {
namespace {

using torch::autograd::AutogradContext, torch::autograd::tensor_list;

// An image of a batch as planes, in place. Tensors are contiguous here.
template <typename Scalar>
auto planes(const at::Tensor& batch, std::int64_t image) {
  const auto rows = static_cast<Eigen::Index>(batch[image].numel() / 3);
  return Eigen::Map<Planes<Scalar>>(batch.data_ptr<Scalar>() + image * 3 * rows, rows, 3);
}

template <typename Scalar>
auto coefficients(const at::Tensor& batch, std::int64_t image) {
  return Eigen::Map<Coefficients<Scalar>>(batch.data_ptr<Scalar>() + image * dsbrdf_size);
}

// work(0.0f) or work(0.0), as the tensor's type is.
template <typename Work>
void with_scalar(const at::Tensor& tensor, const Work& work) {
  tensor.scalar_type() == at::kFloat ? work(0.0f) : work(0.0);
}

template <typename Scalar>
auto grid_of(const at::Tensor& light) {
  return light_grid<Scalar>(static_cast<int>(light.size(2)), static_cast<int>(light.size(3)));
}

void check(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light) {
  PARTWISE_CHECK(normals.dim(), ==, 4);
  PARTWISE_CHECK(normals.size(1), ==, 3);
  PARTWISE_CHECK(material.dim(), ==, 2);
  PARTWISE_CHECK(material.size(0), ==, normals.size(0));
  PARTWISE_CHECK(material.size(1), ==, dsbrdf_size);
  PARTWISE_CHECK(light.dim(), ==, 4);
  PARTWISE_CHECK(light.size(0), ==, normals.size(0));
  PARTWISE_CHECK(light.size(1), ==, 3);
  for (const at::Tensor& each : {normals, material, light}) {
    PARTWISE_CHECK(each.is_cpu(), ==, true);
    PARTWISE_CHECK(each.scalar_type() == at::kFloat || each.scalar_type() == at::kDouble, ==, true);
    PARTWISE_CHECK(each.scalar_type() == normals.scalar_type(), ==, true);
  }
}

GradientWanted wanted_of(AutogradContext* context) {
  return {context->needs_input_grad(0), context->needs_input_grad(1), context->needs_input_grad(2)};
}

// Tensors like those of the inputs, for what is wanted of their derivatives.
struct Gradients {
  at::Tensor normals, material, light;

  Gradients(const tensor_list& inputs, GradientWanted wanted)
      : normals(wanted.normals ? at::zeros_like(inputs[0]) : at::Tensor()),
        material(wanted.material ? at::zeros_like(inputs[1]) : at::Tensor()),
        light(wanted.radiance ? at::zeros_like(inputs[2]) : at::Tensor()) {}

  template <typename Scalar>
  void set_material_and_light(std::int64_t image, const SumGradient<Scalar>& found) {
    if (material.defined()) coefficients<Scalar>(material, image) = found.material;
    if (light.defined()) planes<Scalar>(light, image) = found.radiance;
  }
};

struct ExactImages : torch::autograd::Function<ExactImages> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& normals, const at::Tensor& material,
                            const at::Tensor& light) {
    context->save_for_backward({normals, material, light});
    at::Tensor images = at::empty_like(normals);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        planes<Scalar>(images, i) = sum.colours(planes<Scalar>(normals, i));
      });
    });
    return images;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& of_results) {
    const tensor_list inputs = context->get_saved_variables();
    const at::Tensor &normals = inputs[0], &material = inputs[1], &light = inputs[2];
    const at::Tensor of_images = of_results[0].contiguous();
    const GradientWanted wanted = wanted_of(context);
    Gradients gradients(inputs, wanted);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        const auto found = sum.gradient(planes<Scalar>(normals, i), planes<Scalar>(of_images, i), wanted);
        if (wanted.normals) planes<Scalar>(gradients.normals, i) = found.normals;
        gradients.set_material_and_light(i, found);
      });
    });
    return {gradients.normals, gradients.material, gradients.light};
  }
};

struct MappedImages : torch::autograd::Function<MappedImages> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& normals, const at::Tensor& material,
                            const at::Tensor& light, std::int64_t map_size) {
    at::Tensor images = at::empty_like(normals), maps;
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      const DiskLookup<Scalar> lookup(static_cast<int>(map_size));
      maps = at::empty({normals.size(0), 3, lookup.normals().rows()}, normals.options());
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        auto texels = planes<Scalar>(maps, i);
        texels = sum.colours(lookup.normals());
        planes<Scalar>(images, i) = lookup.colours(texels, planes<Scalar>(normals, i));
      });
    });
    context->save_for_backward({normals, material, light, maps});
    context->saved_data["map_size"] = map_size;
    return images;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& of_results) {
    const tensor_list inputs = context->get_saved_variables();
    const at::Tensor &normals = inputs[0], &material = inputs[1], &light = inputs[2], &maps = inputs[3];
    const at::Tensor of_images = of_results[0].contiguous();
    const GradientWanted wanted = wanted_of(context);
    Gradients gradients(inputs, wanted);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      const DiskLookup<Scalar> lookup(static_cast<int>(context->saved_data["map_size"].toInt()));
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const auto looked_up =
            lookup.gradient(planes<Scalar>(maps, i), planes<Scalar>(normals, i), planes<Scalar>(of_images, i));
        if (wanted.normals) planes<Scalar>(gradients.normals, i) = looked_up.normals;
        if (!wanted.material && !wanted.radiance) return;
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        const auto found = sum.gradient(lookup.normals(), looked_up.texels, {false, wanted.material, wanted.radiance});
        gradients.set_material_and_light(i, found);
      });
    });
    return {gradients.normals, gradients.material, gradients.light, at::Tensor()};
  }
};

}  // namespace

at::Tensor exact_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light) {
  check(normals, material, light);
  return ExactImages::apply(normals.contiguous(), material.contiguous(), light.contiguous());
}

at::Tensor mapped_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light, int map_size) {
  check(normals, material, light);
  PARTWISE_CHECK(map_size, >=, 8);
  return MappedImages::apply(normals.contiguous(), material.contiguous(), light.contiguous(),
                             static_cast<std::int64_t>(map_size));
}

}  // namespace partwise
