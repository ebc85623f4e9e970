// Binary glTF 2.0: one node, mesh and material a member, positions in single precision.
#include <fmt/format.h>

#include <limits>
#include <ostream>

#include "partwise/base/error.h"
#include "partwise/geometry/bytes.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/tinygltf_config.h"

namespace partwise {
namespace {

// Appends a view of `bytes` and an accessor of it; returns the accessor's index.
int add_accessor(tinygltf::Model& model, const std::string& bytes, int target, int component_type, int type,
                 std::size_t count) {
  tinygltf::Buffer& buffer = model.buffers.front();
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.data.size();
  view.byteLength = bytes.size();
  view.target = target;
  buffer.data.insert(buffer.data.end(), bytes.begin(), bytes.end());
  model.bufferViews.push_back(view);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_positions(tinygltf::Model& model, const Vertices& vertices) {
  std::string bytes;
  for (const double coordinate : vertices.reshaped<Eigen::RowMajor>()) store(bytes, static_cast<float>(coordinate));
  const int index = add_accessor(model, bytes, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                 TINYGLTF_TYPE_VEC3, static_cast<std::size_t>(vertices.rows()));
  // The bounds are required, and of the numbers as they are stored.
  for (int axis = 0; axis < 3; ++axis) {
    model.accessors[index].minValues.push_back(static_cast<float>(vertices.col(axis).minCoeff()));
    model.accessors[index].maxValues.push_back(static_cast<float>(vertices.col(axis).maxCoeff()));
  }
  return index;
}

int add_indices(tinygltf::Model& model, const Faces& faces) {
  std::string bytes;
  for (const int vertex : faces.reshaped<Eigen::RowMajor>()) store(bytes, static_cast<std::uint32_t>(vertex));
  return add_accessor(model, bytes, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                      TINYGLTF_TYPE_SCALAR, static_cast<std::size_t>(faces.size()));
}

int add_mesh(tinygltf::Model& model, const NamedMeshView& each) {
  tinygltf::Material material;
  material.name = each.name;
  material.pbrMetallicRoughness.baseColorFactor = {each.colour[0], each.colour[1], each.colour[2], 1};
  material.pbrMetallicRoughness.metallicFactor = 0;
  model.materials.push_back(material);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = add_positions(model, each.mesh->vertices);
  primitive.indices = add_indices(model, each.mesh->faces);
  primitive.material = static_cast<int>(model.materials.size()) - 1;
  tinygltf::Mesh mesh;
  mesh.name = each.name;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

}  // namespace

void write_glb(std::ostream& out, std::span<const NamedMeshView> meshes) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Partwise";
  model.defaultScene = 0;
  model.scenes.emplace_back();
  model.buffers.emplace_back();
  for (const NamedMeshView& each : meshes) {
    tinygltf::Node node;
    node.name = each.name;
    if (each.mesh->faces.rows() > 0) node.mesh = add_mesh(model, each);  // glTF has no empty meshes.
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
  }
  if (model.buffers[0].data.empty()) model.buffers.clear();
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 8 * 7;  // leaves room for the JSON
  if (!model.buffers.empty() && model.buffers[0].data.size() > kMost) {
    throw InputError("binary glTF", "the meshes need more than 4 GB", "write several files, or use .ply");
  }
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true);
}

}  // namespace partwise
