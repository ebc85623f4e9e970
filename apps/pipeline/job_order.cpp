#include "pipeline/job_order.h"

#include <algorithm>
#include <map>
#include <string>

#include "partwise/base/error.h"

namespace partwise::pipeline {

std::vector<std::vector<std::size_t>> jobs_before(const std::vector<Job>& jobs, const std::filesystem::path& output) {
  std::map<std::string, std::size_t> by_folder;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    PARTWISE_CHECK(by_folder.emplace((output / jobs[i].name).string(), i).second, ==, true);
  }
  std::vector<std::vector<std::size_t>> before(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    for (std::filesystem::path at : jobs[i].inputs) {
      for (; at.has_relative_path(); at = at.parent_path()) {
        const auto found = by_folder.find(at.string());
        if (found == by_folder.end()) continue;
        PARTWISE_CHECK(found->second, <, i);
        before[i].push_back(found->second);
        break;
      }
    }
    std::ranges::sort(before[i]);
    before[i].erase(std::unique(before[i].begin(), before[i].end()), before[i].end());
  }
  return before;
}

}  // namespace partwise::pipeline
