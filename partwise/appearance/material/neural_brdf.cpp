#include "partwise/appearance/material/neural_brdf.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

constexpr int kLayers = 3, kInputs = 6, kOutputs = 3;
constexpr const char* kRemedy = "give a network of Neural-BRDF as Keras stores it";

// An identifier of the HDF5 library, closed with its owner.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  explicit operator bool() const { return id_ >= 0; }
  hid_t operator*() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

herr_t collect_kernel(hid_t, const char* name, const H5L_info_t* info, void* names) {
  const std::string link = name;
  if (info->type == H5L_TYPE_HARD && link.ends_with("/kernel:0"))
    static_cast<std::vector<std::string>*>(names)->push_back(link);
  return 0;
}

// Layers are numbered: dense_9 comes before dense_10.
std::vector<std::string> kernels_of(hid_t file, const std::string& name) {
  std::vector<std::string> kernels;
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, collect_kernel, &kernels);
  std::ranges::sort(kernels, {}, [](const std::string& kernel) { return std::pair(kernel.size(), kernel); });
  if (kernels.size() != kLayers) {
    throw InputError(name, fmt::format("holds {} dense layers, not {}", kernels.size(), kLayers), kRemedy);
  }
  return kernels;
}

// A dataset of one or two dimensions as a matrix; HDF5 is row-major.
Eigen::MatrixXf read_matrix(hid_t file, const std::string& link, int dimensions, const std::string& name) {
  const std::string place = name + ": " + link;
  const Handle set(H5Dopen2(file, link.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) throw InputError(place, "is missing or damaged", kRemedy);
  const Handle space(H5Dget_space(*set), H5Sclose), type(H5Dget_type(*set), H5Tclose);
  std::array<hsize_t, 2> size = {1, 1};
  if (!space || !type || H5Tget_class(*type) != H5T_FLOAT || H5Sget_simple_extent_ndims(*space) != dimensions ||
      H5Sget_simple_extent_dims(*space, size.data() + 2 - dimensions, nullptr) < 0 || size[0] < 1 || size[1] < 1 ||
      size[0] > NeuralBrdf::widest || size[1] > NeuralBrdf::widest) {
    throw InputError(
        place,
        fmt::format("is no {} of at most {} numbers a side", dimensions == 1 ? "vector" : "matrix", NeuralBrdf::widest),
        kRemedy);
  }
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(size[0], size[1]);
  if (H5Dread(*set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw InputError(place, "cannot be read", "copy the file again, whole");
  }
  if (!values.allFinite()) throw InputError(place, "holds a number that is not finite", kRemedy);
  return values;
}

bool fit_together(const std::vector<NeuralBrdf::Layer>& layers) {
  Eigen::Index width = kInputs;
  for (const NeuralBrdf::Layer& layer : layers) {
    if (layer.weights.cols() != width || layer.bias.size() != layer.weights.rows() ||
        layer.bias.size() > NeuralBrdf::widest)
      return false;
    width = layer.weights.rows();
  }
  return layers.size() == kLayers && width == kOutputs;
}

}  // namespace

NeuralBrdf::NeuralBrdf(std::vector<Layer> layers) : layers_(std::move(layers)) {
  PARTWISE_CHECK(fit_together(layers_), ==, true);
}

Eigen::Vector3f NeuralBrdf::operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const {
  if (!(to_light.z() > 0 && to_viewer.z() > 0)) return Eigen::Vector3f::Zero();
  const HalfAngles angles = half_angles(to_light.cast<double>(), to_viewer.cast<double>());
  Eigen::Matrix<float, Eigen::Dynamic, 1, 0, widest, 1> values(kInputs), next;  // on the stack
  const double across = std::sin(angles.theta_d);
  values << std::sin(angles.theta_h), 0, std::cos(angles.theta_h), across * std::cos(angles.phi_d),
      across * std::sin(angles.phi_d), std::cos(angles.theta_d);
  for (const Layer& layer : layers_) {
    next = layer.bias;
    next.noalias() += layer.weights.lazyProduct(values);
    values = &layer == &layers_.back() ? next : next.cwiseMax(0.0f);
  }
  return Eigen::Vector3f(values).unaryExpr([](float x) { return std::max(std::expm1(x), 0.0f); });
}

NeuralBrdf decode_neural_brdf(const std::string& file, std::string_view bytes) {
  static std::mutex one_at_a_time;  // the library need not have been built for threads
  const std::lock_guard lock(one_at_a_time);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told by us, in one line
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(*access, 1 << 16, 0);
  H5Pset_file_image(*access, const_cast<char*>(bytes.data()), bytes.size());  // NOLINT: it is copied
  const Handle opened(bytes.empty() ? H5I_INVALID_HID : H5Fopen("in memory", H5F_ACC_RDONLY, *access), H5Fclose);
  if (!opened) throw InputError(file, "is no HDF5 file, or is damaged", kRemedy);
  std::vector<NeuralBrdf::Layer> layers;
  for (const std::string& kernel : kernels_of(*opened, file)) {
    const std::string bias = kernel.substr(0, kernel.rfind('/')) + "/bias:0";
    layers.push_back(
        {read_matrix(*opened, kernel, 2, file).transpose(), read_matrix(*opened, bias, 1, file).transpose()});
  }
  if (!fit_together(layers)) throw InputError(file, "has layers that do not lead from 6 numbers to 3", kRemedy);
  return NeuralBrdf(std::move(layers));
}

NeuralBrdf read_neural_brdf(const std::filesystem::path& path) {
  return decode_neural_brdf(path.string(), read_bytes(path));
}

}  // namespace partwise
