#include <gtest/gtest.h>

#include <filesystem>

#include "partwise/base/shared_files.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/test_editing.h"

namespace partwise {
namespace {

// That they are small is a promise; that they were trained, what they see of shapes that no training of theirs had.
TEST(ShippedNetworks, AreSmallAndSeeShapes) {
  const EditBatch batch = test::samples(false).batch(1, {0, 8, 8});
  std::uintmax_t bytes = std::filesystem::file_size(shared_file("models/networks/vgg16_start.pt"));
  for (const char* name : {"models/networks/editing.pt", "models/networks/photos.pt"}) {
    bytes += std::filesystem::file_size(shared_file(name));
    const EditingNetworks networks = read_editing_networks(shared_file(name));
    EXPECT_EQ(networks.settings().size, 128);
    const at::NoGradGuard no_gradient;
    const PictureLayers found = networks(batch.pictures);
    const double cosine = ((found.normals * batch.normals).sum() / batch.mask().sum()).item<double>();
    EXPECT_GT(cosine, 0.85) << name;
    EXPECT_TRUE(found.log_radiance.isfinite().all().item<bool>());
    EXPECT_LE(found.material.abs().max().item<double>(), 1);
  }
  EXPECT_LT(bytes, 10'000'000u);
}

}  // namespace
}  // namespace partwise
