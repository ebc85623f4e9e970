#include "partwise/parts/surface/part_database.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

namespace fs = std::filesystem;

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_mesh(const fs::directory_entry& entry) {
  constexpr std::array endings = {".off", ".obj", ".ply", ".stl", ".gltf", ".glb"};
  std::error_code ignored;
  return entry.is_regular_file(ignored) && std::ranges::count(endings, lower_ending(entry.path())) > 0;
}

std::vector<fs::path> meshes_below(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const bool hidden = entry->path().filename().native().starts_with('.');
    if (hidden && entry->is_directory()) entry.disable_recursion_pending();
    if (!hidden && is_mesh(*entry)) files.push_back(entry->path().lexically_relative(folder));
  }
  if (error) throw InputError(folder.string(), fmt::format("cannot be listed ({})", error.message()), "name a folder");
  std::ranges::sort(files);
  return files;
}

constexpr std::uint64_t hash_start = 14695981039346656037u;

std::uint64_t hashed(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

template <typename Matrix>
std::string_view bytes_of(const Matrix& matrix) {
  return {reinterpret_cast<const char*>(matrix.data()),
          static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar)};
}

// Makes the folder that the index goes to, if need be.
void keep(const fs::path& index_path, const DatabaseMesh& mesh) {
  std::error_code error;
  fs::create_directories(index_path.parent_path(), error);
  if (error) {
    throw InputError(index_path.parent_path().string(), fmt::format("cannot be made ({})", error.message()),
                     "keep the index in another folder");
  }
  write_part_index(index_path, mesh.content, mesh.index);
}

}  // namespace

std::uint64_t mesh_content(const fs::path& file) {
  if (lower_ending(file) == ".gltf") {
    const Mesh mesh = read_mesh(file);
    return hashed(hashed(hash_start, bytes_of(mesh.vertices)), bytes_of(mesh.faces));
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw InputError(file.string(), "cannot be read", "name a file that you may read");
  return hashed(hash_start, bytes);
}

const DatabaseMesh* PartDatabase::find(std::uint64_t content) const {
  const auto found = std::ranges::find(meshes, content, &DatabaseMesh::content);
  return found == meshes.end() ? nullptr : &*found;
}

PartDatabase open_part_database(const fs::path& folder, const fs::path& cache, const Progress& progress) {
  const fs::path cache_folder = cache.empty() ? folder / ".partwise" : cache;
  const std::vector<fs::path> files = meshes_below(folder);
  PartDatabase result;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(files.size());
    const Progress within{[&](std::string_view, double) { progress("indexing", done); }, progress.cancelled};
    within("", 0);
    DatabaseMesh mesh{.file = files[i], .content = 0, .index = {}};
    const fs::path index_path = cache_folder / (files[i].string() + ".parts.json");
    bool is_new = false;
    try {
      mesh.content = mesh_content(folder / files[i]);
      is_new = !read_part_index(index_path, mesh.content, mesh.index);
      if (is_new) mesh.index = index_parts(read_mesh(folder / files[i]), within);
    } catch (const InputError& error) {
      result.skipped.push_back({files[i], error.what()});
      continue;
    }
    if (is_new) keep(index_path, mesh);
    result.indexed += is_new;
    result.meshes.push_back(std::move(mesh));
  }
  if (result.meshes.empty()) {
    const std::string why = result.skipped.empty() ? "" : fmt::format(" ({})", result.skipped.front().reason);
    throw InputError(folder.string(), "holds no mesh that can be used" + why, "name a folder with meshes");
  }
  return result;
}

}  // namespace partwise
