// glTF 2.0 (Khronos 2021). tinygltf reads the JSON and the buffers; what it does not check is checked here, before
// (the chunks of a .glb, the depth of the JSON) and after (indices and ranges of everything that is used).
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <limits>
#include <optional>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/bytes.h"
#include "partwise/geometry/gltf_accessor.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/text_scanner.h"
#include "partwise/geometry/tinygltf_config.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr const char* kExportAgain = "export the file again";

// tinygltf follows nested JSON by recursion, so that depth is stack.
void check_depth(const std::string& file, std::string_view json) {
  constexpr int kDeepest = 256;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) {
        throw InputError(fmt::format("{}: byte {}", file, i), fmt::format("JSON is nested deeper than {}", kDeepest),
                         kExportAgain);
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// The .glb without what may follow it, its JSON chunk and an optional binary chunk lying within.
std::string_view check_chunks(const std::string& file, std::string_view bytes) {
  const auto word = [&](std::size_t at) { return std::size_t{load<std::uint32_t>(&bytes[at])}; };
  const auto cut_short = [&](std::size_t needed) -> InputError {
    return {file, fmt::format("ends after {} bytes where {} are announced", bytes.size(), needed),
            "the file was cut short: copy or export it again"};
  };
  if (!bytes.starts_with("glTF")) {
    throw InputError(file, fmt::format("begins with {} instead of glTF", shown(bytes.substr(0, 4))),
                     "give a binary glTF, or use the ending of its true format");
  }
  if (bytes.size() < 20) throw cut_short(20);
  if (word(4) != 2) {
    throw InputError(file, fmt::format("is glTF of version {}", word(4)), "convert it to version 2");
  }
  if (word(8) > bytes.size()) throw cut_short(word(8));
  bytes = bytes.substr(0, word(8));
  if (bytes.size() < 20) throw cut_short(20);
  const std::size_t json_end = 20 + word(12);
  if (json_end > bytes.size()) throw cut_short(json_end);
  if (json_end < bytes.size()) {
    if (json_end + 8 > bytes.size()) throw cut_short(json_end + 8);
    const std::size_t binary_end = json_end + 8 + word(json_end);
    if (binary_end > bytes.size()) throw cut_short(binary_end);
  }
  check_depth(file, bytes.substr(20, word(12)));
  return bytes;
}

void check_extensions(const std::string& file, const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired) {
    if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" ||
        name == "EXT_mesh_gpu_instancing") {
      throw InputError(file, fmt::format("needs the extension {}, which is not supported", name),
                       "export it without compression or instancing");
    }
  }
}

// Buffers are taken from beside the file only; tinygltf would look in the working directory too.
bool is_beside(const std::string& path, void* folder) {
  return path.starts_with(*static_cast<const std::string*>(folder)) && std::filesystem::is_regular_file(path);
}

bool read_buffer(std::vector<unsigned char>* out, std::string*, const std::string& path, void*) {
  const std::string bytes = read_bytes(path);
  out->assign(bytes.begin(), bytes.end());
  return true;
}

bool pass_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

// A message of tinygltf, which may have several lines and whole buffers in it, as part of a line.
std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message.substr(0, 160)) line += c >= ' ' && c <= '~' ? c : ' ';
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

tinygltf::Model load_model(const std::string& file, std::string_view bytes, const std::filesystem::path& folder,
                           bool binary) {
  std::string base = folder.empty() ? "." : folder.string();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(pass_image, nullptr);
  loader.SetFsCallbacks({.FileExists = is_beside,
                         .ExpandFilePath = [](const std::string& path, void*) { return path; },
                         .ReadWholeFile = read_buffer,
                         .WriteWholeFile = nullptr,
                         .user_data = &base});
  tinygltf::Model model;
  std::string problem, warning;
  bool loaded = false;
  const auto size = static_cast<unsigned>(bytes.size());
  try {
    loaded = binary ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), size, base)
                    : loader.LoadASCIIFromString(&model, &problem, &warning, bytes.data(), size, base);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // of the JSON library, or of a container's at()
    problem += error.what();
  }
  check_extensions(file, model);  // Of a model that needs one, the rest of the message makes little sense.
  if (!loaded) {
    throw InputError(file, "is not a glTF that can be read: " + one_line(problem),
                     "correct or export it, with the files that it names beside it");
  }
  return model;
}

// The triangles of all primitives as corners of their own; primitives of points and lines have none.
Mesh triangles(const std::string& file, const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  std::vector<Point> corners;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    const bool list = mode == TINYGLTF_MODE_TRIANGLES, strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP,
               fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const auto attribute = primitive.attributes.find("POSITION");
    if ((!list && !strip && !fan) || attribute == primitive.attributes.end()) continue;
    const GltfAccessor positions(file, model, attribute->second, GltfAccessor::Kind::position);
    std::optional<GltfAccessor> indices;
    if (primitive.indices >= 0) indices.emplace(file, model, primitive.indices, GltfAccessor::Kind::index);
    const std::size_t count = indices ? indices->size() : positions.size();
    if (list && count % 3 != 0) {
      throw InputError(file, fmt::format("a primitive has {} corners, no multiple of three", count), kExportAgain);
    }
    const auto add = [&](std::size_t i) {
      const std::size_t vertex = indices ? indices->index(i) : i;
      if (vertex >= positions.size()) {
        throw InputError(file,
                         fmt::format("a face names vertex {}, its primitive has {} (from 0)", vertex, positions.size()),
                         kExportAgain);
      }
      corners.push_back(positions.position(vertex));
      if (!corners.back().allFinite()) {
        throw InputError(file, fmt::format("vertex {} of a primitive is not finite", vertex), "correct or remove it");
      }
    };
    for (std::size_t i = 0; i + 2 < count; i += list ? 3 : 1) {
      // Every second triangle of a strip is turned (section 3.7.2.1 of the specification).
      const std::size_t odd = strip ? i % 2 : 0;
      add(fan ? 0 : i);
      add(i + 1 + odd);
      add(i + 2 - odd);
    }
  }
  if (corners.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InputError(file, "has more corners than an int counts", "split it into several files");
  }
  Mesh soup{Vertices(static_cast<Eigen::Index>(corners.size()), 3),
            Faces(static_cast<Eigen::Index>(corners.size() / 3), 3)};
  for (std::size_t i = 0; i < corners.size(); ++i) soup.vertices.row(static_cast<Eigen::Index>(i)) = corners[i];
  for (Eigen::Index i = 0; i < soup.faces.size(); ++i) soup.faces.data()[i] = static_cast<int>(i);
  return soup;
}

Eigen::Affine3d local_transform(const tinygltf::Node& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return transform;
  }
  if (node.translation.size() == 3) transform.translate(Eigen::Vector3d(node.translation.data()));
  if (node.rotation.size() == 4) {
    transform.rotate(
        Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]).normalized());
  }
  if (node.scale.size() == 3) transform.scale(Eigen::Vector3d(node.scale.data()));
  return transform;
}

struct Instance {
  int mesh = 0;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
};

// The roots of the scene that is shown first; of all nodes when there is no scene.
std::vector<int> roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const int shown_first = model.defaultScene;
    const bool named = shown_first >= 0 && static_cast<std::size_t>(shown_first) < model.scenes.size();
    return model.scenes[named ? static_cast<std::size_t>(shown_first) : 0].nodes;
  }
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) is_child[child] = 1;
  std::vector<int> result;
  for (std::size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) result.push_back(static_cast<int>(i));
  return result;
}

// The meshes that nodes show, depth first.
std::vector<Instance> instances(const std::string& file, const tinygltf::Model& model) {
  std::vector<Instance> result;
  if (model.nodes.empty()) {
    for (std::size_t i = 0; i < model.meshes.size(); ++i) result.push_back({static_cast<int>(i)});
    return result;
  }
  std::vector<std::pair<int, Eigen::Affine3d>> stack;
  const auto push = [&](const std::vector<int>& nodes, const Eigen::Affine3d& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.emplace_back(*node, parent);
  };
  push(roots(model), Eigen::Affine3d::Identity());
  std::vector<char> visited(model.nodes.size(), 0);
  while (!stack.empty()) {
    const auto [index, parent] = stack.back();
    stack.pop_back();
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size()) {
      throw InputError(file, fmt::format("names node {}, there are {}", index, model.nodes.size()), kExportAgain);
    }
    if (std::exchange(visited[index], 1)) {
      throw InputError(file, fmt::format("node {} has two parents or is its own ancestor", index), kExportAgain);
    }
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    const Eigen::Affine3d transform = parent * local_transform(node);
    if (node.mesh >= 0) result.push_back({node.mesh, transform});
    push(node.children, transform);
  }
  return result;
}

// The vertices and faces of `all` from the given rows on.
void put(Mesh& all, Eigen::Index vertex, Eigen::Index face, const Mesh& mesh, const Eigen::Affine3d& transform) {
  all.vertices.middleRows(vertex, mesh.vertices.rows()) =
      (mesh.vertices * transform.linear().transpose()).rowwise() + transform.translation().transpose();
  auto faces = all.faces.middleRows(face, mesh.faces.rows());
  faces = mesh.faces.array() + static_cast<int>(vertex);
  if (transform.linear().determinant() < 0) faces.col(1).swap(faces.col(2));  // A mirror turns faces inside out.
}

Mesh to_mesh(const std::string& file, const tinygltf::Model& model) {
  const std::vector<Instance> shown_meshes = instances(file, model);
  std::vector<std::optional<Mesh>> welded(model.meshes.size());
  Eigen::Index vertices = 0, faces = 0;
  for (const Instance& each : shown_meshes) {
    if (static_cast<std::size_t>(each.mesh) >= model.meshes.size()) {
      throw InputError(file, fmt::format("names mesh {}, there are {}", each.mesh, model.meshes.size()), kExportAgain);
    }
    const auto index = static_cast<std::size_t>(each.mesh);
    if (!welded[index]) welded[index] = weld(triangles(file, model, model.meshes[index]));
    vertices += welded[index]->vertices.rows();
    faces += welded[index]->faces.rows();
  }
  if (faces == 0) throw InputError(file, "holds no triangles", "give a scene with a surface mesh");
  if (vertices > std::numeric_limits<int>::max() / 3 || faces > std::numeric_limits<int>::max() / 3) {
    throw InputError(file, "has more vertices or corners than an int counts", "split it into several files");
  }
  Mesh all{Vertices(vertices, 3), Faces(faces, 3)};
  vertices = faces = 0;
  for (const Instance& each : shown_meshes) {
    const Mesh& mesh = *welded[static_cast<std::size_t>(each.mesh)];
    put(all, vertices, faces, mesh, each.transform);
    vertices += mesh.vertices.rows();
    faces += mesh.faces.rows();
  }
  if (!all.vertices.allFinite()) throw InputError(file, "a node's transform is not finite", "correct the transform");
  return all;
}

}  // namespace

Mesh read_gltf(const std::string& file, std::string_view bytes, const std::filesystem::path& folder) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // the byte order mark of UTF-8
  if (bytes.size() > std::numeric_limits<unsigned>::max()) throw InputError(file, "is longer than 4 GB", "split it");
  check_depth(file, bytes);
  return to_mesh(file, load_model(file, bytes, folder, false));
}

Mesh read_glb(const std::string& file, std::string_view bytes, const std::filesystem::path& folder) {
  return to_mesh(file, load_model(file, check_chunks(file, bytes), folder, true));
}

}  // namespace partwise
