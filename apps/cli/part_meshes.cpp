#include "part_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "partwise/appearance/palette.h"

namespace partwise::cli {

std::vector<NamedMesh> part_meshes(const Mesh& mesh, std::span<const int> labels, int parts) {
  std::vector<std::vector<Eigen::Index>> faces(static_cast<std::size_t>(parts));
  for (std::size_t f = 0; f < labels.size(); ++f) {
    faces[static_cast<std::size_t>(labels[f])].push_back(static_cast<Eigen::Index>(f));
  }
  std::vector<NamedMesh> result;
  for (int part = 0; part < parts; ++part) {
    const std::vector<Eigen::Index>& own = faces[static_cast<std::size_t>(part)];
    NamedMesh& member = result.emplace_back();
    member.name = fmt::format("part_{}", part);
    member.colour = part_colour(part);
    member.mesh.faces.resize(static_cast<Eigen::Index>(own.size()), 3);
    std::unordered_map<int, int> renumbered;
    std::vector<int> used;
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        const int vertex = mesh.faces(own[i], corner);
        const auto [place, is_new] = renumbered.try_emplace(vertex, static_cast<int>(used.size()));
        if (is_new) used.push_back(vertex);
        member.mesh.faces(static_cast<Eigen::Index>(i), corner) = place->second;
      }
    }
    member.mesh.vertices = mesh.vertices(used, Eigen::all);
  }
  return result;
}

std::vector<NamedMesh> hull_meshes(std::span<const Mesh> hulls) {
  std::vector<NamedMesh> result;
  for (const Mesh& hull : hulls) {
    const int part = static_cast<int>(result.size());
    result.push_back({fmt::format("part_{}", part), hull, part_colour(part)});
  }
  return result;
}

std::vector<NamedMesh> value_meshes(const Mesh& mesh, const Eigen::VectorXd& values) {
  constexpr int kLevels = 32;
  const double least = values.minCoeff(), range = values.maxCoeff() - least;
  std::vector<int> level;
  for (const double value : values)
    level.push_back(range > 0 ? std::min(kLevels - 1, static_cast<int>(kLevels * (value - least) / range)) : 0);
  std::vector<NamedMesh> members = part_meshes(mesh, level, kLevels);
  for (int i = 0; i < kLevels; ++i) {
    NamedMesh& member = members[static_cast<std::size_t>(i)];
    member.name = fmt::format("{:.4g}_to_{:.4g}", least + range * i / kLevels, least + range * (i + 1) / kLevels);
    member.colour = value_colour(static_cast<float>(i) / (kLevels - 1));
  }
  std::erase_if(members, [](const NamedMesh& member) { return member.mesh.faces.rows() == 0; });
  return members;
}

}  // namespace partwise::cli
