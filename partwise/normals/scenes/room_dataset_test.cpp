#include "partwise/normals/scenes/room_dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/png.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/normal_files.h"
#include "partwise/normals/truth/normal_measures.h"
#include "partwise/normals/truth/registration.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace partwise {
namespace {

using testing::HasSubstr;

class RoomDataset : public testing::Test {
 protected:
  RoomDatasetConfig config(int images, const nlohmann::json& changes = {}) {
    nlohmann::json json = {{"shapes", {std::string(PARTWISE_TEST_DATA) + "/data/models/chair.off"}},
                           {"height", 0.9},
                           {"materials", {"pink-felt", "nylon", "chrome"}},
                           {"lights", {"studio", "park"}},
                           {"size", {64, 48}},
                           {"map_size", 12},
                           {"images", images}};
    if (!changes.is_null()) json.update(changes);
    write_file(folder_.path() / "rooms.json", json.dump());
    RoomDatasetConfig result = read_room_dataset_config(folder_.path() / "rooms.json");
    result.output = folder_.path() / "rooms";
    return result;
  }

  std::map<std::string, std::string> files() {
    std::map<std::string, std::string> result;
    for (const auto& each : std::filesystem::recursive_directory_iterator(folder_.path() / "rooms"))
      if (each.is_regular_file())
        result[std::filesystem::relative(each.path(), folder_.path()).string()] = read_bytes(each.path());
    return result;
  }

  std::string refusal(const nlohmann::json& changes) {
    try {
      config(2, changes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "was read";
  }

  TestFolder folder_;
};

TEST_F(RoomDataset, IsReadAsRgbdDataAndKeepsItsTruth) {
  EXPECT_EQ(make_room_dataset(config(3)).made, 3);
  const std::vector<RgbdFiles> frames = find_rgbd_frames(folder_.path() / "rooms");
  ASSERT_EQ(frames.size(), 3u);
  NormalMeasure measured;
  for (const RgbdFiles& each : frames) {
    const RgbdFrame frame = read_registered_frame(each);
    EXPECT_NEAR(frame.camera.focal_x, 24 / std::tan(22.5 * 3.14159265358979 / 180), 1e-4);
    EXPECT_EQ(frame.colour.width, 64);
    const Image exact = read_normals(room_normals_file(each.colour));
    const Image noisy = normals_from_depth(frame.depth, frame.camera);
    measured.add(noisy, exact, known_normals(noisy));
    ASSERT_TRUE(has_room_truth(each.colour));
    const RoomTruth truth = read_room_truth(each.colour);
    ASSERT_EQ(truth.names.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::VectorXd numbers =
          shipped_basis().first(default_components).project(shipped_material(truth.names[i]).brdf);
      for (int k = 0; k < default_components; ++k)
        EXPECT_NEAR(truth.materials[i][static_cast<std::size_t>(k)], numbers[k], 1e-5);
    }
    const std::vector<int> shown = read_room_materials(each.colour, 64, 48);
    EXPECT_EQ(shown.size(), 64u * 48u);
    const std::set<int> different(shown.begin(), shown.end());
    EXPECT_GE(*different.begin(), 0);
    EXPECT_LT(*different.rbegin(), 3);
  }
  EXPECT_LT(measured.errors().median, 8);
}

// What white walls would show under a light, less what the picture shows: mean over pixels, in shares of the mean.
double deviation(const RgbdFiles& files, const Image& about) {
  const Dsbrdf white = shipped_material("white-diffuse-bball").brdf;
  const LightSamples light = light_samples(EnvironmentLight(about));
  const LightSum sum(white, light);
  const Image normals = read_normals(room_normals_file(files.colour)), colour = read_png(files.colour);
  double apart = 0, whole = 0;
  for (std::size_t i = 0; i < normals.values.size(); i += 21) {
    const auto shown = static_cast<double>(colour.values[i + 1]);
    const auto expected =
        static_cast<double>(sum.colour({normals.values[i], normals.values[i + 1], normals.values[i + 2]}).y());
    if (shown >= 0.99) continue;
    apart += std::abs(shown - expected);
    whole += expected;
  }
  return apart / whole;
}

// The light about the camera is that under which the picture was made, as bright, and not its mirror image.
TEST_F(RoomDataset, LightIsThatOfThePicture) {
  make_room_dataset(
      config(4, {{"materials", {"white-diffuse-bball"}}, {"patterned", 0}, {"most_pieces", 0}, {"least_pieces", 0}}));
  double right = 0, mirrored = 0, inverted = 0;
  for (const RgbdFiles& each : find_rgbd_frames(folder_.path() / "rooms")) {
    const Image light = read_room_truth(each.colour).light;
    Image turned = light, upside = light;
    for (int y = 0; y < light.height; ++y) {
      for (int x = 0; x < light.width; ++x) {
        std::copy_n(light.pixel(light.width - 1 - x, y), 3, turned.pixel(x, y));
        std::copy_n(light.pixel(x, light.height - 1 - y), 3, upside.pixel(x, y));
      }
    }
    right += deviation(each, light) / 4;
    mirrored += deviation(each, turned) / 4;
    inverted += deviation(each, upside) / 4;
  }
  EXPECT_LT(right, 0.12);
  EXPECT_GT(mirrored, 2 * right);
  EXPECT_GT(inverted, 2 * right);
}

TEST_F(RoomDataset, GoesOnWhereItStoppedWithTheSameBytes) {
  make_room_dataset(config(4));
  const auto whole = files();
  for (const char* each : {"color", "truth"})
    std::filesystem::remove_all(folder_.path() / "rooms" / each /
                                (std::string(each) == "color" ? "000002.png" : "000002.json"));
  const RoomDatasetReport report = make_room_dataset(config(4));
  EXPECT_EQ(report.made, 1);
  EXPECT_EQ(report.kept, 3);
  EXPECT_EQ(files(), whole);
  EXPECT_EQ(make_room_dataset(config(5)).made, 1);  // more of the same
  EXPECT_THROW(make_room_dataset(config(4, {{"patterned", 0.9}})), InputError);
}

TEST_F(RoomDataset, RefusesWhatItCannotMake) {
  EXPECT_THAT(refusal({{"materials", {"unobtainium"}}}), HasSubstr("unobtainium"));
  EXPECT_THAT(refusal({{"shapes", {"none.obj"}}}), HasSubstr("shapes[0] \"none.obj\" does not exist"));
  EXPECT_THAT(refusal({{"field_of_view", 190}}), HasSubstr("field_of_view"));
  EXPECT_THAT(refusal({{"least_pieces", 5}, {"most_pieces", 2}}), HasSubstr("most_pieces"));
  EXPECT_THAT(refusal({{"parts", "labels"}}), HasSubstr("parts are labels"));
  EXPECT_THAT(refusal({{"views", 3}}), HasSubstr("views is not a field that is known; see docs/rooms.md"));
  make_room_dataset(config(1));
  const auto colour = folder_.path() / "rooms" / "color" / "000000.png";
  write_file(folder_.path() / "rooms" / "truth" / "000000.json", "{\"materials\": [], \"light\": 3}");
  EXPECT_THROW(read_room_truth(colour), InputError);
  EXPECT_THROW(read_room_materials(colour, 48, 64), InputError);
}

}  // namespace
}  // namespace partwise
