#include "pipeline/plan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char tetrahedron[] = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

class Plans : public testing::Test {
 protected:
  Plans() {
    for (const char* name : {"shapes/b.off", "shapes/a.OFF", "more/x/model.off", "more/y/model.off"}) {
      fs::create_directories((folder() / name).parent_path());
      write_file(folder() / name, tetrahedron);
    }
    write_file(folder() / "shapes/notes.txt", "no mesh");
    for (const char* name : {"car.png", "cat.jpg", "mask.png", "net.pt", "gold.json", "sky.exr", "bird.poly"}) {
      write_file(folder() / name, "x");
    }
    write_file(folder() / "problem.json", json{{"space", "plane"},
                                               {"obstacles", {{{"polygon", {{0, 0}, {1, 0}, {0, 1}}}}}},
                                               {"bounds", {{"low", {-2, -2}}, {"high", {2, 2}}}},
                                               {"queries", {{{"start", {-1, -1}}, {"goal", {1.5, 1.5}}}}}}
                                              .dump());
  }

  fs::path folder() const { return fs::canonical(folder_.path()); }

  Plan plan(const json& config) {
    write_file(folder() / "c.json", config.dump());
    return read_plan(folder() / "c.json", folder() / "out", 0);
  }

  static std::vector<std::string> names(const Plan& plan) {
    std::vector<std::string> result;
    for (const Job& job : plan.jobs) result.push_back(job.name);
    return result;
  }

  static std::vector<std::string> words(const Job& job) {
    std::vector<std::string> result;
    for (const Word& word : job.words) result.push_back(word.text);
    return result;
  }

  json images(const char* parts = nullptr) const {
    json section = {{"materials", {"chrome", "gold.json"}}, {"lights", {"studio", "*.exr"}}, {"images", 4}};
    if (parts != nullptr) section["parts"] = parts;
    return section;
  }

  TestFolder folder_;
};

TEST_F(Plans, FoldersPatternsAndFilesAreShapes) {
  const json parts = {{"convex", {{"tolerance", 0.1}}}};
  EXPECT_THAT(names(plan({{"shapes", {"shapes"}}, {"parts", parts}})),
              ElementsAre("parts/a.OFF/convex", "parts/b.off/convex"));
  EXPECT_THAT(names(plan({{"shapes", {"more/*/model.off", "shapes/b.off"}}, {"parts", parts}})),
              ElementsAre("parts/x/model.off/convex", "parts/y/model.off/convex", "parts/b.off/convex"));
  EXPECT_THAT(
      names(
          plan({{"shapes", {"shapes/b.off", "shapes/", "./shapes/b.off"}}, {"except", "shapes/a*"}, {"parts", parts}})),
      ElementsAre("parts/b.off/convex"));
}

TEST_F(Plans, PartsAreMadeByTheVerbsOfTheirs) {
  const Plan made = plan({{"shapes", "shapes/b.off"},
                          {"outlines", "bird.poly"},
                          {"seed", 7},
                          {"parts",
                           {{"convex", {{"tolerance", 0.25}, {"max_hulls", 5}}},
                            {"meaningful", json::object()},
                            {"planar", {{"tolerance", 0.05}}}}}});
  const std::string mesh = (folder() / "shapes/b.off").string();
  EXPECT_THAT(words(made.jobs[0]), ElementsAre("decompose", mesh, "--tolerance", "0.25", "--max-hulls", "5", "--labels",
                                               "labels.seg", "--hulls", "hulls.obj", "--glb", "parts.glb"));
  EXPECT_THAT(words(made.jobs[1]), ElementsAre("segment", mesh, "--feature", "cvf-avg", "--seed", "7", "--labels",
                                               "labels.seg", "--glb", "parts.glb"));
  EXPECT_EQ(made.jobs[2].name, "parts/bird.poly/planar");
  EXPECT_THAT(made.stages, ElementsAre("parts"));
}

TEST_F(Plans, ImagesShowThePartsThatWereMade) {
  const Plan made = plan({{"shapes", "shapes"}, {"parts", {{"meaningful", json::object()}}}, {"images", images()}});
  const Job& job = made.jobs.back();
  EXPECT_THAT(job.inputs, Contains(folder() / "out/parts/a.OFF/meaningful/labels.seg"));
  EXPECT_THAT(job.inputs, Contains(folder() / "gold.json"));
  EXPECT_THAT(job.inputs, Contains(folder() / "sky.exr"));
  EXPECT_TRUE(job.goes_on && job.wide);
  EXPECT_FALSE(job.without);
  const json config = json::parse(job.given.front().text);
  EXPECT_EQ(config["parts"], "labels");
  EXPECT_EQ(config["shapes"][1],
            (json{{"mesh", "../../shapes/b.off"}, {"labels", "../parts/b.off/meaningful/labels.seg"}}));
  EXPECT_EQ(config["materials"], (json{"chrome", "../../gold.json"}));
  EXPECT_EQ(config["lights"], (json{"studio", "../../sky.exr"}));

  const Plan plainly = plan({{"shapes", "shapes"}, {"images", images()}});
  EXPECT_EQ(json::parse(plainly.jobs[0].given[0].text)["parts"], "components");
  EXPECT_EQ(json::parse(plainly.jobs[0].given[0].text)["shapes"], (json{"../../shapes/a.OFF", "../../shapes/b.off"}));
}

TEST_F(Plans, BadShapesAreLeftOutWhereThatIsWanted) {
  const Plan made = plan({{"shapes", "shapes"},
                          {"bad_shapes", "leave_out"},
                          {"parts", {{"convex", {{"tolerance", 0.1}}}}},
                          {"images", images("convex")}});
  EXPECT_TRUE(made.leave_out_bad);
  const Job left = made.jobs.back().without({"parts/a.OFF/convex"});
  EXPECT_EQ(json::parse(left.given[0].text)["shapes"].size(), 1u);
  EXPECT_THROW(made.jobs.back().without({"parts/a.OFF/convex", "parts/b.off/convex"}), InputError);
}

TEST_F(Plans, NetworksAreTrainedLoadedOrThoseThatShip) {
  const json photos = {
      {{"photo", "*.png"}, {"except", "mask.png"}, {"materials", {"chrome", "gold.json"}}, {"normals", true}}};
  const json training = {{"editing", {{"materials", {"gold.json"}}, {"threads", 3}, {"stages", {{{"steps", 1}}}}}}};
  Plan made = plan({{"shapes", "shapes"}, {"images", images()}, {"training", training}, {"photos", photos}});
  EXPECT_THAT(names(made), ElementsAre("images", "training/editing", "photos/car.png/chrome", "photos/car.png/gold",
                                       "photos/car.png/normals"));
  const json config = json::parse(made.jobs[1].given[0].text);
  EXPECT_EQ(config["views"], (json{"../../images"}));
  EXPECT_EQ(config["materials"], (json{"../../../gold.json"}));
  EXPECT_EQ(config["network"], "editing");
  EXPECT_FALSE(config.contains("threads"));
  EXPECT_EQ(made.jobs[1].threads, 3);
  for (int i = 2; i < 5; ++i) EXPECT_THAT(made.jobs[i].inputs, Contains(folder() / "out/training/editing/best.pt"));

  made = plan({{"weights", {{"normals", "net.pt"}}}, {"photos", photos}});
  EXPECT_THAT(words(made.jobs[0]), testing::Not(Contains("--weights")));
  EXPECT_THAT(words(made.jobs[2]), Contains((folder() / "net.pt").string()));
}

TEST_F(Plans, ScenesGetRoadmapsAndPaths) {
  const Plan made = plan({{"motion",
                           {{{"scene", "problem.json"}, {"samples", 50}},
                            {{"name", "hall"},
                             {"obstacles", {"shapes"}},
                             {"robot", {"more/x/model.off"}},
                             {"space", "se3"},
                             {"bounds", {{"low", {-9, -9, -9}}, {"high", {9, 9, 9}}}},
                             {"queries", {{{"start", {-5, 0, 0, 1, 0, 0, 0}}, {"goal", {5, 0, 0, 1, 0, 0, 0}}}}}}}}});
  EXPECT_THAT(names(made),
              ElementsAre("motion/problem.json/roadmap", "motion/problem.json/path-1", "motion/hall/parts/a.OFF",
                          "motion/hall/parts/b.off", "motion/hall/roadmap", "motion/hall/path-1"));
  EXPECT_THAT(words(made.jobs[0]), Contains("roadmap.svg"));
  EXPECT_THAT(words(made.jobs[4]), Contains("roadmap.glb"));
  const json problem = json::parse(made.jobs[5].given[0].text);
  EXPECT_EQ(problem["obstacles"][1]["mesh"], "../../../../shapes/b.off");
  EXPECT_EQ(problem["robot"][0]["mesh"], "../../../../more/x/model.off");
  EXPECT_THAT(made.stages, ElementsAre("roadmaps", "paths", "parts"));
}

TEST_F(Plans, WhatIsWrongIsNamed) {
  const json parts = {{"convex", {{"tolerance", 0.1}}}}, photo = {{"photo", "car.png"}, {"normals", true}};
  const auto changed = [](json base, const json& patch) {
    base.merge_patch(patch);
    return base;
  };
  for (const auto& [config, words] : std::vector<std::pair<json, std::string>>{
           {json::object(), "asks for nothing"},
           {{{"shapes", {"gone.off"}}, {"parts", parts}}, "shapes \"gone.off\" does not exist"},
           {{{"shapes", {"*.ply"}}, {"parts", parts}}, "matches no file"},
           {{{"shapes", {"more"}}, {"parts", parts}}, "a folder without such a file"},
           {{{"shapes", {"more/x/model.off", "more/y/model.off"}}, {"parts", parts}},
            "the same; name them by one pattern"},
           {{{"shapes", "shapes"}, {"except", "shapes/*"}, {"parts", parts}}, "except leaves no file"},
           {{{"shapes", "shapes"}, {"parts", json::object()}}, "parts asks for nothing"},
           {{{"shapes", "shapes"}, {"parts", {{"convex", json::object()}}}}, "parts.convex.tolerance is missing"},
           {{{"shapes", "shapes"}, {"parts", {{"convex", {{"tolerance", "fine"}}}}}}, "parts.convex.tolerance"},
           {{{"shapes", "shapes"}, {"parts", {{"concave", 1}}}}, "parts.concave is not a field that is known"},
           {{{"parts", parts}}, "parts.convex has no meshes"},
           {{{"shapes", "shapes"}, {"images", images("cvf")}}, "images.parts is \"cvf\""},
           {{{"shapes", "shapes"}, {"images", images("convex")}}, "which nobody makes"},
           {{{"shapes", "shapes"}, {"images", changed(images(), {{"images", 0}})}}, "images.images"},
           {{{"shapes", "shapes"}, {"images", changed(images(), {{"shapes", "x"}})}},
            "images.shapes is the pipeline's"},
           {{{"shapes", "shapes"}, {"images", changed(images(), {{"materials", {"jelly"}}})}},
            "images.materials \"jelly\""},
           {{{"training", {{"editing", json::object()}}}}, "training.editing.views is missing"},
           {{{"training", {{"oracle", json::object()}}}}, "training.oracle"},
           {{{"weights", {{"editing", "none.pt"}}}, {"photos", {photo}}}, "weights.editing \"none.pt\""},
           {{{"photos", {{{"photo", "car.png"}}}}}, "photos[0] asks for nothing"},
           {{{"photos", {{{"photo", "car.png"}, {"materials", {"jelly"}}}}}}, "photos[0].materials \"jelly\""},
           {{{"photos", {{{"photo", "*.png"}, {"mask", "mask.png"}, {"normals", true}}}}}, "photos[0].mask"},
           {{{"photos", {photo, photo}}}, "asks twice for photos/car.png/normals"},
           {{{"motion", {{{"samples", 3}}}}}, "motion[0] has not one of scene and obstacles"},
           {{{"motion", {{{"scene", "problem.json"}, {"limit", 3}}}}}, "motion[0].limit"},
           {{{"motion", {{{"name", "hall"}, {"obstacles", {"shapes"}}, {"space", "se3"}}}}},
            "motion[0].robot is missing"},
           {{{"motion", {{{"name", "hall"}, {"obstacles", {"shapes"}}, {"space", "space"}, {"time", 3}}}}},
            "motion[0].time"},
           {{{"colour", 1}, {"photos", {photo}}}, "colour is not a field that is known; see docs/pipeline.md"},
       }) {
    try {
      plan(config);
      ADD_FAILURE() << config << " was taken";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith((folder() / "c.json").string() + ": ")) << config;
      EXPECT_THAT(error.what(), HasSubstr(words)) << config;
    }
  }
}

TEST_F(Plans, TheOutputFolderIsNeeded) {
  write_file(folder() / "c.json", R"({"photos": [{"photo": "car.png", "normals": true}]})");
  EXPECT_THROW(read_plan(folder() / "c.json", "", 0), InputError);
  write_file(folder() / "c.json", R"({"photos": [{"photo": "car.png", "normals": true}], "output": "made/"})");
  EXPECT_EQ(read_plan(folder() / "c.json", "", 0).output, folder() / "made");
  write_file(folder() / "c.json", "{");
  EXPECT_THROW(read_plan(folder() / "c.json", folder() / "out", 0), InputError);
}

}  // namespace
}  // namespace partwise::pipeline
