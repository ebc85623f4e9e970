// How far a feature's segmentations are from people's, for many settings at once: the feature is computed once a mesh.
//
// segmentation_sweep FEATURE MESHES_DIR SEG_DIR --clusters 2,3,4 --smoothness 10,20: for each DIR/N.off that has
// SEG_DIR/N/*.seg a JSON line with the mesh's number, clusters, smoothness, rand_error (mean over the people) and
// parts. fit_segmentation.py chooses from these.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/contingency_table.h"
#include "partwise/parts/surface/segmentation.h"

namespace {

using namespace partwise;

const std::map<std::string, SurfaceFeature> features = {{"cvf", SurfaceFeature::visibility},
                                                        {"cvf-avg", SurfaceFeature::visibility_average},
                                                        {"cvf-strong", SurfaceFeature::visibility_strong},
                                                        {"cvf-weak", SurfaceFeature::visibility_weak},
                                                        {"sdf", SurfaceFeature::shape_diameter}};

struct Options {
  std::string feature;
  std::filesystem::path meshes, people;
  std::vector<int> clusters;
  std::vector<double> smoothness;
};

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void sweep_mesh(const std::filesystem::path& file, const Options& options) {
  const std::string name = file.stem().string();
  std::vector<std::vector<int>> people;
  for (const auto& segmentation : files_in(options.people / name, ".seg")) people.push_back(read_labels(segmentation));
  if (people.empty()) return;
  const Mesh mesh = read_mesh(file);
  const std::vector<double> areas(static_cast<std::size_t>(mesh.faces.rows()), 1.0);  // Rand errors count faces
  SegmentationSettings settings{.feature = features.at(options.feature)};
  const Eigen::MatrixXd values = feature_values(mesh, settings.feature);
  for (const int clusters : options.clusters) {
    for (const double smoothness : options.smoothness) {
      settings.clusters = clusters, settings.smoothness = smoothness;
      const Segmentation result = segment_values(mesh, values, settings);
      double error = 0;
      for (const auto& reference : people) error += rand_error(contingency_table(result.labels, reference, areas));
      const nlohmann::ordered_json line = {{"mesh", name},
                                           {"feature", options.feature},
                                           {"clusters", clusters},
                                           {"smoothness", smoothness},
                                           {"rand_error", error / static_cast<double>(people.size())},
                                           {"parts", result.parts}};
      std::cout << line.dump() << std::endl;
    }
  }
}

}  // namespace

int main(int count, char** words) {
  Options options;
  CLI::App app("Rand errors of one feature's segmentations for many settings, a JSON line each");
  app.add_option("FEATURE", options.feature)->required()->check(CLI::IsMember(features));
  app.add_option("MESHES_DIR", options.meshes)->required()->check(CLI::ExistingDirectory);
  app.add_option("SEG_DIR", options.people)->required()->check(CLI::ExistingDirectory);
  app.add_option("--clusters", options.clusters)->required()->delimiter(',');
  app.add_option("--smoothness", options.smoothness)->required()->delimiter(',');
  CLI11_PARSE(app, count, words);
  try {
    for (const auto& file : files_in(options.meshes, ".off")) sweep_mesh(file, options);
  } catch (const std::exception& error) {
    std::cerr << "segmentation_sweep: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
