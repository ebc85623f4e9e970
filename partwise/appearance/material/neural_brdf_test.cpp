#include "partwise/appearance/material/neural_brdf.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

void write_set(hid_t file, const std::string& name, const std::vector<hsize_t>& size,
               const std::vector<float>& values) {
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name.c_str(), H5T_IEEE_F32LE, space, links, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(links);
}

// A network of widths 6, 2, 2, 3 that can be followed by hand. Its layers are numbered across 9 and 10, as Keras does
// when a session makes several networks.
void write_network(const std::filesystem::path& path) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  // Inputs: h.x h.y h.z d.x d.y d.z; outputs: h.x - d.y and d.z - 0.25.
  write_set(file, "/dense_9/dense_9/kernel:0", {6, 2}, {1, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 1});
  write_set(file, "/dense_9/dense_9/bias:0", {2}, {0, -0.25});
  write_set(file, "/dense_10/dense_10/kernel:0", {2, 2}, {1, 1, 1, -1});  // the sum and the difference
  write_set(file, "/dense_10/dense_10/bias:0", {2}, {0, 0});
  write_set(file, "/dense_11/dense_11/kernel:0", {2, 3}, {1, 0, -1, 0, 1, 0});  // sum, difference, minus the sum
  write_set(file, "/dense_11/dense_11/bias:0", {3}, {0, 0.125, 0});
  H5Fclose(file);
}

TEST(NeuralBrdf, IsTheArithmeticOfItsLayers) {
  const TestFolder folder;
  write_network(folder.path() / "small.h5");
  const NeuralBrdf brdf = read_neural_brdf(folder.path() / "small.h5");
  for (const double phi : {-2.0, -0.5, 0.0, 1.0, 2.5}) {
    const HalfAngles angles{0.6, 0.4, phi};
    const DirectionPair pair = directions_of(angles);
    const double first = std::max(std::sin(0.6) - std::sin(0.4) * std::sin(phi), 0.0), second = std::cos(0.4) - 0.25;
    const double sum = first + second, difference = std::max(first - second, 0.0);
    const Eigen::Vector3f value = brdf(pair.to_light.cast<float>(), pair.to_viewer.cast<float>());
    EXPECT_NEAR(value[0], std::expm1(sum), 1e-5);
    EXPECT_NEAR(value[1], std::expm1(difference + 0.125), 1e-5);
    EXPECT_EQ(value[2], 0);  // what is negative counts as zero
  }
  const Eigen::Vector3f up(0, 0, 1), below(0.6f, 0, -0.8f);
  EXPECT_EQ(brdf(up, below), Eigen::Vector3f::Zero());
  EXPECT_EQ(brdf(below, up), Eigen::Vector3f::Zero());
}

TEST(NeuralBrdf, CutAnywhereIsAMessage) {
  const TestFolder folder;
  write_network(folder.path() / "small.h5");
  const std::string bytes = read_bytes(folder.path() / "small.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    EXPECT_THROW(decode_neural_brdf("small.h5", std::string_view(bytes).substr(0, size)), InputError) << size;
  }
}

TEST(NeuralBrdf, RefusesLayersThatDoNotFit) {
  const auto layer = [](int outputs, int inputs) {
    return NeuralBrdf::Layer{Eigen::MatrixXf::Zero(outputs, inputs), Eigen::VectorXf::Zero(outputs)};
  };
  EXPECT_NO_THROW(NeuralBrdf({layer(4, 6), layer(5, 4), layer(3, 5)}));
  EXPECT_THROW(NeuralBrdf({layer(4, 6), layer(5, 3), layer(3, 5)}), CheckFailed);
  EXPECT_THROW(NeuralBrdf({layer(4, 6), layer(3, 4)}), CheckFailed);
  EXPECT_THROW(NeuralBrdf({layer(4, 6), layer(5, 4), layer(1, 5)}), CheckFailed);
  EXPECT_THROW(NeuralBrdf({layer(65, 6), layer(5, 65), layer(3, 5)}), CheckFailed);
}

}  // namespace
}  // namespace partwise
