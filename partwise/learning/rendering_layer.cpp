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

void check_number(const at::Tensor& tensor, const at::Tensor& like) {
  PARTWISE_CHECK(tensor.is_cpu(), ==, true);
  PARTWISE_CHECK(tensor.scalar_type() == at::kFloat || tensor.scalar_type() == at::kDouble, ==, true);
  PARTWISE_CHECK(tensor.scalar_type() == like.scalar_type(), ==, true);
}

// Of a batch of `images`.
void check_normals(const at::Tensor& normals, std::int64_t images) {
  PARTWISE_CHECK(normals.dim(), ==, 4);
  PARTWISE_CHECK(normals.size(0), ==, images);
  PARTWISE_CHECK(normals.size(1), ==, 3);
}

void check_material(const at::Tensor& material) {
  PARTWISE_CHECK(material.dim(), ==, 2);
  PARTWISE_CHECK(material.size(1), ==, dsbrdf_size);
  check_number(material, material);
}

void check_material_and_light(const at::Tensor& material, const at::Tensor& light) {
  check_material(material);
  PARTWISE_CHECK(light.dim(), ==, 4);
  PARTWISE_CHECK(light.size(0), ==, material.size(0));
  PARTWISE_CHECK(light.size(1), ==, 3);
  check_number(light, material);
}

// Tensors like those of material and light, for what is wanted of their derivatives.
struct SourceGradients {
  at::Tensor material, light;

  SourceGradients(const at::Tensor& of_material, const at::Tensor& of_light, GradientWanted wanted)
      : material(wanted.material ? at::zeros_like(of_material) : at::Tensor()),
        light(wanted.radiance ? at::zeros_like(of_light) : at::Tensor()) {}

  template <typename Scalar>
  void set(std::int64_t image, const SumGradient<Scalar>& found) {
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
    const GradientWanted wanted{context->needs_input_grad(0), context->needs_input_grad(1),
                                context->needs_input_grad(2)};
    const at::Tensor of_normals = wanted.normals ? at::zeros_like(normals) : at::Tensor();
    SourceGradients sources(material, light, wanted);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        const auto found = sum.gradient(planes<Scalar>(normals, i), planes<Scalar>(of_images, i), wanted);
        if (wanted.normals) planes<Scalar>(of_normals, i) = found.normals;
        sources.set(i, found);
      });
    });
    return {of_normals, sources.material, sources.light};
  }
};

struct ReflectanceMaps : torch::autograd::Function<ReflectanceMaps> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& material, const at::Tensor& light,
                            std::int64_t map_size) {
    context->save_for_backward({material, light});
    context->saved_data["map_size"] = map_size;
    at::Tensor maps;
    with_scalar(material, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      const DiskLookup<Scalar> lookup(static_cast<int>(map_size));
      maps = at::empty({material.size(0), 3, lookup.normals().rows()}, material.options());
      tbb::parallel_for(std::int64_t(0), material.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        planes<Scalar>(maps, i) = sum.colours(lookup.normals());
      });
    });
    return maps;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& of_results) {
    const tensor_list inputs = context->get_saved_variables();
    const at::Tensor &material = inputs[0], &light = inputs[1], of_maps = of_results[0].contiguous();
    const GradientWanted wanted{false, context->needs_input_grad(0), context->needs_input_grad(1)};
    SourceGradients sources(material, light, wanted);
    with_scalar(material, [&]<typename Scalar>(Scalar) {
      const auto grid = grid_of<Scalar>(light);
      const DiskLookup<Scalar> lookup(static_cast<int>(context->saved_data["map_size"].toInt()));
      tbb::parallel_for(std::int64_t(0), material.size(0), [&](std::int64_t i) {
        const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(material, i), planes<Scalar>(light, i));
        sources.set(i, sum.gradient(lookup.normals(), planes<Scalar>(of_maps, i), wanted));
      });
    });
    return {sources.material, sources.light, at::Tensor()};
  }
};

struct LookedUpImages : torch::autograd::Function<LookedUpImages> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& normals, const at::Tensor& maps,
                            std::int64_t map_size) {
    context->save_for_backward({normals, maps});
    context->saved_data["map_size"] = map_size;
    at::Tensor images = at::empty_like(normals);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const DiskLookup<Scalar> lookup(static_cast<int>(map_size));
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        planes<Scalar>(images, i) = lookup.colours(planes<Scalar>(maps, i), planes<Scalar>(normals, i));
      });
    });
    return images;
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& of_results) {
    const tensor_list inputs = context->get_saved_variables();
    const at::Tensor &normals = inputs[0], &maps = inputs[1], of_images = of_results[0].contiguous();
    const at::Tensor of_normals = at::empty_like(normals), of_maps = at::empty_like(maps);
    with_scalar(normals, [&]<typename Scalar>(Scalar) {
      const DiskLookup<Scalar> lookup(static_cast<int>(context->saved_data["map_size"].toInt()));
      tbb::parallel_for(std::int64_t(0), normals.size(0), [&](std::int64_t i) {
        const auto found =
            lookup.gradient(planes<Scalar>(maps, i), planes<Scalar>(normals, i), planes<Scalar>(of_images, i));
        planes<Scalar>(of_normals, i) = found.normals;
        planes<Scalar>(of_maps, i) = found.texels;
      });
    });
    return {of_normals, of_maps, at::Tensor()};
  }
};

}  // namespace

at::Tensor exact_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light) {
  check_material_and_light(material, light);
  check_normals(normals, material.size(0));
  check_number(normals, material);
  return ExactImages::apply(normals.contiguous(), material.contiguous(), light.contiguous());
}

at::Tensor reflectance_maps(const at::Tensor& material, const at::Tensor& light, int map_size) {
  check_material_and_light(material, light);
  PARTWISE_CHECK(map_size, >=, 8);
  return ReflectanceMaps::apply(material.contiguous(), light.contiguous(), static_cast<std::int64_t>(map_size));
}

at::Tensor map_transport(const at::Tensor& material, int rows, int columns, int map_size) {
  check_material(material);
  PARTWISE_CHECK(map_size, >=, 8);
  const at::Tensor each = material.detach().contiguous();
  at::Tensor result;
  with_scalar(material, [&]<typename Scalar>(Scalar) {
    const auto grid = light_grid<Scalar>(rows, columns);
    const DiskLookup<Scalar> lookup(map_size);
    const Planes<Scalar> any = Planes<Scalar>::Zero(std::ssize(grid), 3);
    result = at::empty({material.size(0), 3, std::ssize(grid), lookup.normals().rows()}, material.options());
    for (std::int64_t i = 0; i < material.size(0); ++i) {
      const DifferentiableSum<Scalar> sum(grid, coefficients<Scalar>(each, i), any);
      sum.find_transport(lookup.normals(),
                         Eigen::Map<Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>>(
                             result[i].data_ptr<Scalar>(), lookup.normals().rows(), 3 * std::ssize(grid)));
    }
  });
  return result;
}

at::Tensor transported_maps(const at::Tensor& transport, const at::Tensor& light) {
  PARTWISE_CHECK(transport.dim(), ==, 4);
  PARTWISE_CHECK(light.dim(), ==, 4);
  PARTWISE_CHECK(light.size(1), ==, 3);
  PARTWISE_CHECK(light.size(2) * light.size(3), ==, transport.size(2));
  return at::matmul(light.reshape({light.size(0), 3, 1, -1}), transport).squeeze(2);
}

at::Tensor looked_up_images(const at::Tensor& normals, const at::Tensor& maps, int map_size) {
  PARTWISE_CHECK(maps.dim(), ==, 3);
  PARTWISE_CHECK(maps.size(1), ==, 3);
  PARTWISE_CHECK(map_size, >=, 8);
  check_normals(normals, maps.size(0));
  for (const at::Tensor& each : {normals, maps}) check_number(each, normals);
  return LookedUpImages::apply(normals.contiguous(), maps.contiguous(), static_cast<std::int64_t>(map_size));
}

at::Tensor mapped_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light, int map_size) {
  return looked_up_images(normals, reflectance_maps(material, light, map_size), map_size);
}

}  // namespace partwise
