#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "partwise/base/atomic_file.h"
#include "partwise/parts/surface/part_database.h"

namespace partwise {
namespace {

// Higher whenever an index would come out differently: segmentation, hierarchy, histograms, or this file.
constexpr int version = 4;

std::string hexadecimal(std::uint64_t content) { return fmt::format("{:016x}", content); }

// What root_path and the histograms rely on, so that a damaged file does no harm.
bool is_sound(const PartIndex& index) {
  const PartHierarchy& h = index.hierarchy;
  if (h.parts < 1 || h.nodes() < h.parts || h.histograms.rows() != h.nodes() || h.histograms.cols() < 1) return false;
  for (int node = 0; node < h.nodes(); ++node) {
    const bool last = node + 1 == h.nodes();
    if (last ? h.parents[node] != -1 : h.parents[node] <= node || h.parents[node] >= h.nodes()) return false;
  }
  return h.histograms.allFinite() && (h.histograms.array() >= 0).all() &&
         std::ranges::all_of(index.labels, [&](int label) { return label >= 0 && label < h.parts; });
}

}  // namespace

void write_part_index(const std::filesystem::path& file, std::uint64_t content, const PartIndex& index) {
  const Eigen::MatrixXd& histograms = index.hierarchy.histograms;
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : histograms.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  const nlohmann::ordered_json json = {{"version", version},
                                       {"content", hexadecimal(content)},
                                       {"parts", index.hierarchy.parts},
                                       {"parents", index.hierarchy.parents},
                                       {"histograms", rows},
                                       {"labels", index.labels}};
  write_file(file, json.dump() + "\n");
}

bool read_part_index(const std::filesystem::path& file, std::uint64_t content, PartIndex& index) {
  std::ifstream stream(file, std::ios::binary);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
  try {
    if (json.at("version") != version || json.at("content") != hexadecimal(content)) return false;
    const auto rows = json.at("histograms").get<std::vector<std::vector<double>>>();
    PartIndex found;
    found.hierarchy.parts = json.at("parts");
    found.hierarchy.parents = json.at("parents").get<std::vector<int>>();
    found.labels = json.at("labels").get<std::vector<int>>();
    found.hierarchy.histograms.resize(static_cast<Eigen::Index>(rows.size()),
                                      static_cast<Eigen::Index>(rows.empty() ? 0 : rows.front().size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].size() != rows.front().size()) return false;
      found.hierarchy.histograms.row(static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), static_cast<Eigen::Index>(rows[i].size()));
    }
    if (!is_sound(found)) return false;
    index = std::move(found);
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace partwise
