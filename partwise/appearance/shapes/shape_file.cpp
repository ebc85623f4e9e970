#include "partwise/appearance/shapes/shape_file.h"

#include "partwise/appearance/shapes/model_archive.h"
#include "partwise/appearance/shapes/part_groups.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/decompose.h"
#include "partwise/parts/surface/segmentation.h"

namespace partwise {
namespace {

std::string name_of(const ShapeFile& shape) {
  return shape.file.string() + (shape.model.empty() ? "" : ":" + shape.model);
}

std::vector<int> material_of_faces(const ShapeFile& shape) {
  if (is_archive(shape.file)) {
    const ModelArchive archive(shape.file);
    return read_obj_materials(name_of(shape), archive.bytes(shape.model)).of_face;
  }
  const std::string ending = shape.file.extension().string();
  if (ending != ".obj" && ending != ".OBJ") {
    throw InputError(name_of(shape), "is no OBJ file, whose faces would name their materials",
                     "tell parts apart by something else");
  }
  return read_obj_materials(name_of(shape), read_bytes(shape.file)).of_face;
}

std::vector<int> labels_of_faces(const ShapeFile& shape, const Mesh& mesh) {
  std::vector<int> labels = read_labels(shape.labels);
  if (static_cast<Eigen::Index>(labels.size()) != mesh.faces.rows()) {
    throw InputError(shape.labels.string(),
                     fmt::format("has {} labels, {} has {} faces", labels.size(), name_of(shape), mesh.faces.rows()),
                     "give the labels of this mesh");
  }
  return labels;
}

std::vector<int> parts_by_rule(const ShapeFile& shape, const Mesh& mesh, const PartSettings& settings) {
  switch (settings.rule) {
    case PartRule::whole:
      return std::vector<int>(static_cast<std::size_t>(mesh.faces.rows()), 0);
    case PartRule::components:
      return face_components_by_vertex(mesh).label;
    case PartRule::corise:
      return decompose(mesh, {.tolerance = settings.tolerance}).labels;
    case PartRule::cvf:
      return segment(mesh).labels;
    case PartRule::materials:
      return material_of_faces(shape);
    case PartRule::labels:
      return labels_of_faces(shape, mesh);
  }
  throw CheckFailed("no such rule");
}

}  // namespace

bool is_archive(const std::filesystem::path& file) { return file.extension() == ".sh3f"; }

Mesh read_shape(const ShapeFile& shape) {
  Mesh mesh = weld(is_archive(shape.file) ? ModelArchive(shape.file).read(shape.model) : read_mesh(shape.file));
  for (const double area : face_areas(mesh)) {
    if (area > 0) return mesh;
  }
  throw InputError(name_of(shape), "has no face of positive area", "give a surface");
}

std::vector<int> worn_parts(const ShapeFile& shape, const Mesh& mesh, const PartSettings& settings) {
  return group_parts(mesh, parts_by_rule(shape, mesh, settings), settings.groups).of_face;
}

}  // namespace partwise
