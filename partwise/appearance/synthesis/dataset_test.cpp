#include "partwise/appearance/synthesis/dataset.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "partwise/appearance/rendering/channel_files.h"
#include "partwise/appearance/rendering/scene_file.h"
#include "partwise/appearance/synthesis/dataset_images.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

using nlohmann::json;
using Files = std::map<std::string, std::string>;

class Datasets : public testing::Test {
 protected:
  // 22 small images in 4 shards, two views a combination, so that combinations cross from shard to shard.
  json settings() const {
    const std::string models = std::string(PARTWISE_TEST_DATA) + "/data/models/";
    return {{"shapes", {models + "table.obj", models + "ch*r.off"}},
            {"materials", {"chrome", "white-fabric", "nickel"}},
            {"lights", {"studio", "sky"}},
            {"light_size", {16, 8}},
            {"size", {24, 20}},
            {"samples", 1},
            {"map_size", 16},
            {"views", 2},
            {"images", 22},
            {"images_per_shard", 7}};
  }

  DatasetConfig config(const json& settings, const std::string& output = "out") const {
    write_file(folder_.path() / "config.json", settings.dump());
    DatasetConfig config = read_dataset_config(folder_.path() / "config.json");
    config.output = folder_.path() / output;
    return config;
  }

  // The shards, by name; nothing else is in the folder but what shards were made from.
  Files shards(const std::string& output = "out") const {
    Files found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / output)) {
      const std::string name = entry.path().filename().string();
      if (name != "dataset.json" && name != "parts") found[name] = read_bytes(entry.path());
    }
    return found;
  }

  std::string refusal(const json& settings) const {
    try {
      make_dataset(config(settings), {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TestFolder folder_;
};

TEST_F(Datasets, AreTheSameForAnyNumberOfThreadsAndRanks) {
  const DatasetReport report = make_dataset(config(settings()), {});
  EXPECT_EQ(report.images, 22);
  EXPECT_EQ(report.shards, 4);
  const Files expected = shards();
  EXPECT_EQ(expected.size(), 4u);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    make_dataset(config(settings(), "one"), {});
  }
  EXPECT_TRUE(shards("one") == expected);
  EXPECT_EQ(make_dataset(config(settings(), "ranks"), {1, 3}).shards, 1);
  EXPECT_EQ(make_dataset(config(settings(), "ranks"), {0, 3}).shards, 2);
  EXPECT_EQ(make_dataset(config(settings(), "ranks"), {2, 3}).shards, 1);
  EXPECT_TRUE(shards("ranks") == expected);
}

TEST_F(Datasets, GoOnWhereTheyWereStopped) {
  make_dataset(config(settings()), {});
  const Files expected = shards();
  // Stopped in the second shard, and once more killed, which leaves a file.
  int calls = 0;
  const Progress stop{.report = {}, .cancelled = [&] { return ++calls > 6; }};
  EXPECT_THROW(make_dataset(config(settings(), "again"), {}, stop), Cancelled);
  EXPECT_EQ(shards("again").size(), 1u);
  write_file(folder_.path() / "again" / "shard-000001.tar.123.tmp", "half a shard");
  const DatasetReport report = make_dataset(config(settings(), "again"), {});
  EXPECT_EQ(report.skipped, 1);
  EXPECT_EQ(report.shards, 3);
  EXPECT_TRUE(shards("again") == expected);
  EXPECT_EQ(make_dataset(config(settings(), "again"), {}).shards, 0);
}

TEST_F(Datasets, OtherSettingsAreNotMixedIn) {
  make_dataset(config(settings()), {});
  for (const auto& [name, value] : std::map<std::string, json>{{"seed", 1},
                                                               {"images", 23},
                                                               {"size", {24, 24}},
                                                               {"materials", "test"},
                                                               {"lights", "all"},
                                                               {"parts", "whole"}}) {
    json other = settings();
    other[name] = value;
    EXPECT_THAT(refusal(other), testing::HasSubstr(name));
  }
  EXPECT_EQ(refusal(settings()), "");
}

// Every scene, rendered by itself, gives the files that are beside it.
void expect_rendered_again(const TestFolder& folder, const std::vector<NamedBytes>& files, const std::string& ending) {
  Files by_name;
  for (const auto& [name, bytes] : files) by_name[name] = bytes;
  ASSERT_EQ(by_name.size(), files.size());
  int scenes = 0;
  for (const auto& [name, bytes] : by_name) {
    if (!name.ends_with(".json")) continue;
    ++scenes;
    const std::string key = name.substr(0, name.size() - 4);
    write_file(folder.path() / "scene.json", bytes);
    const RenderedScene again = render(read_scene(folder.path() / "scene.json"));
    EXPECT_TRUE(by_name.at(key + "normal.png") == encode_normals(again.seen)) << name;
    EXPECT_TRUE(by_name.at(key + "mask.png") == encode_mask(again.seen)) << name;
    EXPECT_TRUE(by_name.at(key + "part.png") == encode_parts(again.seen)) << name;
    EXPECT_TRUE(by_name.at(key + "image." + ending) ==
                (ending == "exr" ? encode_exr(again.image) : encode_tone_mapped(again.image, again.seen.mask_image())))
        << name;
  }
  EXPECT_EQ(scenes * 5u, files.size());
}

TEST_F(Datasets, EveryImageIsRenderedAgainByItsScene) {
  expect_rendered_again(folder_, DatasetImages(config(settings())).render(3, 6), "exr");
  json other = settings();
  other["path"] = "exact";
  other["format"] = "png";
  other["parts"] = "corise";
  other["groups"] = 2;
  other["tolerance"] = 0.3;
  expect_rendered_again(folder_, DatasetImages(config(other)).render(0, 3), "png");
}

TEST_F(Datasets, PartsOfPixelsAreThoseOfTheScene) {
  json large = settings();
  large["size"] = {96, 96};
  for (const auto& [name, bytes] : DatasetImages(config(large)).render(0, 8)) {
    if (!name.ends_with(".json")) continue;
    const json scene = json::parse(bytes);
    write_file(folder_.path() / "scene.json", bytes);
    const RenderedScene again = render(read_scene(folder_.path() / "scene.json"));
    const std::set<int> seen(again.seen.parts.begin(), again.seen.parts.end());
    const int parts = scene["about"]["parts"];
    EXPECT_EQ(static_cast<int>(scene["meshes"][0]["material"].size()), parts);
    EXPECT_GE(parts, 2);
    EXPECT_EQ(*seen.begin(), -1) << name;
    EXPECT_LT(*seen.rbegin(), parts) << name;
    EXPECT_GE(static_cast<int>(seen.size()) - 1, parts - 1) << name;  // the rest hides at most one, from some sides
  }
}

TEST_F(Datasets, AreTheSameWhereverTheFolderLies) {
  json inside = settings();
  inside["shapes"] = {"*.off"};
  const std::string chair = read_bytes(std::string(PARTWISE_TEST_DATA) + "/data/models/chair.off");
  std::vector<Files> made;
  for (const char* place : {"a", "b[1]/c"}) {
    const std::filesystem::path folder = folder_.path() / place;
    std::filesystem::create_directories(folder);
    write_file(folder / "chair.off", chair);
    write_file(folder / "config.json", inside.dump());
    Files files;
    for (const auto& [name, bytes] : DatasetImages(read_dataset_config(folder / "config.json")).render(0, 2))
      files[name] = bytes;
    made.push_back(files);
  }
  EXPECT_TRUE(made[0] == made[1]);
}

TEST_F(Datasets, SlowPartsAreKeptAndUsed) {
  json slow = settings();
  slow["shapes"] = {std::string(PARTWISE_TEST_DATA) + "/examples/notch.obj"};
  slow["parts"] = "corise";
  slow["images"] = 1;
  make_dataset(config(slow), {});
  const std::filesystem::path kept = folder_.path() / "out" / "parts" / "00000.seg";
  const std::string labels = read_bytes(kept);
  const Files expected = shards();
  std::filesystem::remove(folder_.path() / "out" / "shard-000000.tar");
  make_dataset(config(slow), {});
  EXPECT_TRUE(shards() == expected);
  std::filesystem::remove(folder_.path() / "out" / "shard-000000.tar");
  write_file(kept, "0\n");  // of another mesh
  make_dataset(config(slow), {});
  EXPECT_TRUE(shards() == expected);
  EXPECT_EQ(read_bytes(kept), labels);
}

}  // namespace
}  // namespace partwise
