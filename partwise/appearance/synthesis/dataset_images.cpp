#include "partwise/appearance/synthesis/dataset_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/channel_files.h"
#include "partwise/appearance/rendering/part_colours.h"
#include "partwise/appearance/rendering/tabulated_material.h"
#include "partwise/appearance/synthesis/lazy_list.h"
#include "partwise/appearance/synthesis/recent_values.h"
#include "partwise/appearance/synthesis/sample_plan.h"
#include "partwise/appearance/synthesis/sample_scene.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/imaging/exr.h"

namespace partwise {
namespace {

constexpr std::size_t most_view_bytes = std::size_t{256} << 20, most_table_bytes = std::size_t{256} << 20;

// What a camera sees of a shape, whatever it wears.
struct View {
  GBuffer seen;
  std::string normals, mask, parts;  // PNG files

  std::size_t bytes() const {
    return sizeof(*this) + seen.parts.size() * (sizeof(Eigen::Vector3f) + sizeof(float) + sizeof(int)) +
           normals.size() + mask.size() + parts.size();
  }
};

}  // namespace

struct DatasetImages::State {
  DatasetConfig config;
  std::filesystem::path parts_folder;
  SamplePlan plan;
  LazyList<RenderScene> shapes;
  LazyList<std::shared_ptr<const Brdf>> materials;
  LazyList<EnvironmentLight> lights;
  RecentValues<std::pair<int, int>, View> views{most_view_bytes};
  RecentValues<int, TabulatedMaterial> tables{most_table_bytes};

  State(DatasetConfig given, std::filesystem::path folder)
      : config(std::move(given)),
        parts_folder(std::move(folder)),
        plan{.seed = config.seed,
             .shapes = static_cast<int>(config.shapes.size()),
             .materials = static_cast<int>(config.materials.size()),
             .lights = static_cast<int>(config.lights.size()),
             .parts = [this](int shape) { return shapes[shape].parts(); },
             .viewpoints = config.viewpoints,
             .views = config.views},
        shapes(config.shapes.size(), [this](int i) { return shape(i); }),
        materials(
            config.materials.size(),
            [this](int i) { return find_material(config.materials[static_cast<std::size_t>(i)], config.folder); }),
        lights(config.lights.size(), [this](int i) {
          return named_light(config.lights[static_cast<std::size_t>(i)], config.folder)
              .resized(config.light_width, config.light_height);
        }) {}

  RenderScene shape(int i) const {
    ShapeFile file = config.shapes[static_cast<std::size_t>(i)];
    file.file = config.folder / file.file;
    if (!file.labels.empty()) file.labels = config.folder / file.labels;
    RenderMesh mesh{read_shape(file), {}, config.crease_degrees};
    mesh.parts = parts(i, file, mesh.mesh);
    return RenderScene({&mesh, 1});
  }

  std::vector<int> parts(int i, const ShapeFile& file, const Mesh& mesh) const {
    const bool slow = config.parts.rule == PartRule::corise || config.parts.rule == PartRule::cvf;
    if (!slow || parts_folder.empty()) return worn_parts(file, mesh, config.parts);
    const std::filesystem::path kept = parts_folder / fmt::format("{:05}.seg", i);
    if (std::filesystem::exists(kept)) {
      std::vector<int> labels = read_labels(kept);
      if (static_cast<Eigen::Index>(labels.size()) == mesh.faces.rows()) return labels;
    }
    std::vector<int> labels = worn_parts(file, mesh, config.parts);
    write_labels(kept, labels);
    return labels;
  }

  std::shared_ptr<const View> view(int shape, int viewpoint) {
    const auto make = [&] {
      const RenderScene& scene = shapes[shape];
      const double aspect = static_cast<double>(config.size.width) / config.size.height;
      GBuffer seen = scene.view(frame_share(scene, sample_view(config, viewpoint), aspect), config.size);
      auto made = std::make_shared<View>();
      made->normals = encode_normals(seen);
      made->mask = encode_mask(seen);
      made->parts = encode_parts(seen);
      made->seen = std::move(seen);
      return made;
    };
    return views.get({shape, viewpoint}, make);
  }

  void add_image(std::uint64_t number, const Sample& sample, const PartColours& colours,
                 std::vector<NamedBytes>& files) {
    const std::shared_ptr<const View> seen = view(sample.shape, sample.viewpoint);
    const Image image = colours.image(seen->seen);
    const std::string key = fmt::format("{:08}", number);
    if (config.format == ImageFormat::exr) {
      files.push_back({key + ".image.exr", encode_exr(image)});
    } else {
      files.push_back({key + ".image.png", encode_tone_mapped(image, seen->seen.mask_image())});
    }
    files.push_back({key + ".normal.png", seen->normals});
    files.push_back({key + ".mask.png", seen->mask});
    files.push_back({key + ".part.png", seen->parts});
    files.push_back({key + ".json", sample_scene(config, number, sample)});
  }

  std::shared_ptr<const Brdf> ready_material(int i) {
    const auto* dsbrdf = dynamic_cast<const Dsbrdf*>(materials[i].get());
    if (dsbrdf == nullptr || config.path == RenderPath::exact) return materials[i];
    return tables.get(i, [&] { return std::make_shared<const TabulatedMaterial>(*dsbrdf); });
  }

  std::unique_ptr<const PartColours> colours(const Sample& sample) {
    std::vector<std::shared_ptr<const Brdf>> worn;
    for (const int material : sample.materials) worn.push_back(ready_material(material));
    const EnvironmentLight light = lights[sample.light].rotated(light_rotation(sample));
    return std::make_unique<const PartColours>(worn, light_samples(light), config.path, config.map_size);
  }
};

DatasetImages::DatasetImages(DatasetConfig config, std::filesystem::path parts_folder)
    : state_(std::make_unique<State>(std::move(config), std::move(parts_folder))) {}
DatasetImages::~DatasetImages() = default;

std::vector<NamedBytes> DatasetImages::render(std::uint64_t first, int count) const {
  std::vector<NamedBytes> files;
  std::unique_ptr<const PartColours> colours;
  const auto views = static_cast<std::uint64_t>(state_->config.views);
  for (std::uint64_t number = first; number < first + static_cast<std::uint64_t>(count); ++number) {
    const Sample each = sample(state_->plan, number);
    if (colours == nullptr || number % views == 0) colours = state_->colours(each);
    state_->add_image(number, each, *colours, files);
  }
  return files;
}

}  // namespace partwise
