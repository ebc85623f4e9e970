#include "pipeline/job_order.h"

#include <gmock/gmock.h>

#include "partwise/base/error.h"

namespace partwise::pipeline {
namespace {

using testing::ElementsAre;

Job job(const std::string& name, const std::vector<std::filesystem::path>& inputs) {
  Job result{.stage = "stage", .name = name};
  result.inputs = inputs;
  return result;
}

TEST(JobOrder, IsThatOfTheFoldersThatJobsReadFrom) {
  const auto before =
      jobs_before({job("parts/a", {"/data/a.off"}), job("parts/ab", {"/data/out/a.off"}),
                   job("images", {"/out/parts/ab/labels.seg", "/out/parts/a/labels.seg", "/out/parts/a/x"}),
                   job("net", {"/out/images", "/out/parts"})},
                  "/out");
  EXPECT_THAT(before, ElementsAre(ElementsAre(), ElementsAre(), ElementsAre(0, 1), ElementsAre(2)));
}

TEST(JobOrder, KnowsItsOwnMistakes) {
  EXPECT_THROW(jobs_before({job("a", {}), job("a", {})}, "/out"), CheckFailed);
  EXPECT_THROW(jobs_before({job("a", {"/out/b/x"}), job("b", {})}, "/out"), CheckFailed);
}

}  // namespace
}  // namespace partwise::pipeline
