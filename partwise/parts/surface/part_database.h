// A folder of meshes that is searched for parts (part_retrieval.h): each mesh is indexed once, and its index is kept.
//
// Meshes are the files with an ending that read_mesh knows, in the folder or below it, hidden folders left out. The
// index of DATABASE/some/cow.off is the file CACHE/some/cow.off.parts.json, where CACHE is DATABASE/.partwise unless
// named. An index is used when it was made by this version of the method from the same content; a file that changed, or
// an index that cannot be understood, leads to a new one. Files are written beside and renamed, one mesh at a time, so
// that several programs may work on one folder (the worst is that two do the same work) and that a stopped run goes on
// where it was.
//
// A mesh that cannot be read or segmented is left out, with the reason. Errors: InputError for a folder that is missing
// or has no mesh that can be used, and for an index that cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/parts/surface/part_retrieval.h"

namespace partwise {

// What two files or meshes have in common only if they are the same, for all that chance can do: 64-bit FNV-1a of the
// bytes of the file (.gltf: of the mesh, for its buffers may lie elsewhere).
std::uint64_t mesh_content(const std::filesystem::path& file);

struct DatabaseMesh {
  std::filesystem::path file;  // below the folder
  std::uint64_t content = 0;
  PartIndex index;
};

struct PartDatabase {
  struct Skipped {
    std::filesystem::path file;
    std::string reason;
  };

  std::vector<DatabaseMesh> meshes;  // by name
  std::vector<Skipped> skipped;
  int indexed = 0;  // how many had no index that could be used

  // The mesh with this content, or null.
  const DatabaseMesh* find(std::uint64_t content) const;
};

// cache: empty for the folder .partwise in `folder`.
PartDatabase open_part_database(const std::filesystem::path& folder, const std::filesystem::path& cache = {},
                                const Progress& progress = {});

// The file of an index. Reading gives nothing when the file is missing, of another version or content, or damaged.
void write_part_index(const std::filesystem::path& file, std::uint64_t content, const PartIndex& index);
bool read_part_index(const std::filesystem::path& file, std::uint64_t content, PartIndex& index);

}  // namespace partwise
