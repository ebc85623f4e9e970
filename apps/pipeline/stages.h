// The sections of a configuration and the jobs that they ask for, one function a section. Jobs of a section read from
// those of sections before it, by the names of their folders.
//
// Errors: InputError with the configuration's file and the field's place.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "partwise/base/json_fields.h"
#include "pipeline/job.h"
#include "pipeline/named_files.h"

namespace partwise::pipeline {

inline constexpr const char* page = "docs/pipeline.md";

// Where a pipeline is told and where it works.
struct Places {
  std::filesystem::path file;    // the configuration, as it was named
  std::filesystem::path folder;  // its folder, canonical
  std::filesystem::path output;  // canonical
  int seed = 0;

  JsonFields object(const std::string& place, const nlohmann::json& value) const {
    return {file.string(), place, value, page};
  }

  // How a configuration in the folder of a job names a file.
  std::string from(const std::string& job, const std::filesystem::path& named) const {
    return named.lexically_relative(output / job).string();
  }
};

struct Shapes {
  std::vector<NamedFile> solids;    // meshes
  std::vector<NamedFile> outlines;  // in the plane
};

// "parts": nearly convex and meaningful parts of each mesh, nearly convex ones of each outline.
enum class MeshParts { convex, meaningful };
struct PartsSection {
  std::vector<Job> jobs{};
  bool has_convex = false, has_meaningful = false;
};
PartsSection parts_section(const Places& places, const Shapes& shapes, const nlohmann::json& section);

// The folder of the job that takes a mesh apart.
std::string parts_folder(const NamedFile& mesh, MeshParts which);

// "motion": parts of obstacles, roadmaps and paths.
std::vector<Job> motion_section(const Places& places, const nlohmann::json& section);

// "images": one data set of all meshes in the parts that were made.
Job images_section(const Places& places, const Shapes& shapes, const PartsSection& parts, bool leave_out_bad,
                   const nlohmann::json& section);

// "training" and "weights": where the networks are. Empty: those that ship.
struct Networks {
  std::vector<Job> jobs;
  std::filesystem::path editing, normals;  // weights
};
Networks networks_sections(const Places& places, bool has_images, const nlohmann::json* training,
                           const nlohmann::json* weights);

// "photos": edits and normals.
std::vector<Job> photos_section(const Places& places, const Networks& networks, const nlohmann::json& section);

}  // namespace partwise::pipeline
