#include "partwise/base/ranks.h"

#include <gtest/gtest.h>

#include <map>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Rank rank_in(const std::map<std::string, std::string>& environment) {
  return rank_of([&](const char* name) -> std::optional<std::string> {
    const auto found = environment.find(name);
    return found == environment.end() ? std::nullopt : std::optional(found->second);
  });
}

void expect_rank(const std::map<std::string, std::string>& environment, int rank, int size) {
  const Rank found = rank_in(environment);
  EXPECT_EQ(found.rank, rank);
  EXPECT_EQ(found.size, size);
}

TEST(Ranks, AreWhatWhoeverStartedTheProcessSays) {
  expect_rank({}, 0, 1);
  expect_rank({{"RANK", "3"}, {"WORLD_SIZE", "8"}}, 3, 8);
  expect_rank({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}}, 1, 2);
  expect_rank({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}, 1, 2);
  expect_rank({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "5"}}, 0, 5);
  expect_rank({{"JOB_COMPLETION_INDEX", "4"}, {"WORLD_SIZE", "5"}}, 4, 5);
}

TEST(Ranks, TheFirstPairCounts) {
  expect_rank({{"RANK", "3"}, {"WORLD_SIZE", "8"}, {"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "5"}}, 3, 8);
  expect_rank({{"RANK", "3"}, {"WORLD_SIZE", "8"}, {"JOB_COMPLETION_INDEX", "1"}}, 3, 8);
  expect_rank({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}, {"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "1"}}, 1, 2);
}

TEST(Ranks, RefuseWhatMakesNoSense) {
  EXPECT_THROW(rank_in({{"RANK", "0"}}), InputError);
  EXPECT_THROW(rank_in({{"WORLD_SIZE", "2"}}), InputError);
  EXPECT_THROW(rank_in({{"RANK", "2"}, {"WORLD_SIZE", "2"}}), InputError);
  EXPECT_THROW(rank_in({{"RANK", "-1"}, {"WORLD_SIZE", "2"}}), InputError);
  EXPECT_THROW(rank_in({{"RANK", "0"}, {"WORLD_SIZE", "0"}}), InputError);
  EXPECT_THROW(rank_in({{"RANK", "one"}, {"WORLD_SIZE", "2"}}), InputError);
  EXPECT_THROW(rank_in({{"RANK", ""}, {"WORLD_SIZE", "2"}}), InputError);
}

}  // namespace
}  // namespace partwise
