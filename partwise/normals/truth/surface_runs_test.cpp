#include "partwise/normals/truth/surface_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace partwise {
namespace {

// A letter a pixel: which run it is in; a dot where it is missing.
std::string runs_of(const std::vector<double>& line, const RunLimits& limits) {
  std::vector<Run> runs(line.size());
  surface_runs(line, limits, runs);
  std::string text(line.size(), '.');
  char letter = 'a';
  for (int i = 0; i < static_cast<int>(line.size()); ++i) {
    const Run run = runs[static_cast<std::size_t>(i)];
    EXPECT_EQ(run.last < run.first, line[static_cast<std::size_t>(i)] == 0);
    if (run.first != i || run.last < i) continue;
    for (int k = i; k <= run.last; ++k) {
      if (line[static_cast<std::size_t>(k)] == 0) continue;
      text[static_cast<std::size_t>(k)] = letter;
      EXPECT_EQ(runs[static_cast<std::size_t>(k)].first, i);
      EXPECT_EQ(runs[static_cast<std::size_t>(k)].last, run.last);
    }
    ++letter;
  }
  return text;
}

constexpr RunLimits limits{0, 0.001, 0.2, 2};

TEST(SurfaceRuns, PlanesAndCreasesAreOneRun) {
  EXPECT_EQ(runs_of({1.0, 1.1, 1.2, 1.3, 1.4}, limits), "aaaaa");
  EXPECT_EQ(runs_of({1.0, 1.1, 1.2, 1.15, 1.1, 1.05}, limits), "aaaaaa");
  EXPECT_EQ(runs_of({1.0, 1.1, 1.2, 1.2, 1.2}, limits), "aaaaa");
}

TEST(SurfaceRuns, StepsPartThemHoweverSlanted) {
  EXPECT_EQ(runs_of({1.0, 1.0, 1.0, 1.1, 1.1, 1.1}, limits), "aaabbb");
  EXPECT_EQ(runs_of({1.0, 1.1, 1.2, 1.2, 1.3, 1.4}, limits), "aaabbb");  // as if the second came a pixel too late
  EXPECT_EQ(runs_of({1.0, 1.1, 1.2, 1.35, 1.45, 1.55}, limits), "aaabbb");
  EXPECT_EQ(runs_of({1.0, 1.0, 1.1, 1.1, 1.1}, {0, 0.2, 0.3, 2}), "aaaaa");  // within what is tolerated
}

TEST(SurfaceRuns, RowsThatAreRepeatedAreNoSteps) {
  EXPECT_EQ(runs_of({1.0, 1.0, 1.1, 1.1, 1.2, 1.2, 1.3, 1.3}, limits), "aaaaaaaa");
  EXPECT_EQ(runs_of({1.0, 1.0, 1.1, 1.1, 1.2, 1.2, 1.6, 1.6, 1.7, 1.7, 1.8, 1.8}, limits), "aaaaaabbbbbb");
}

TEST(SurfaceRuns, BesideAnEndTheSmallerStepIsBelieved) {
  EXPECT_EQ(runs_of({1.0, 1.1, 1.1, 1.1}, limits), "abbb");
  EXPECT_EQ(runs_of({1.0, 1.0, 1.1, 1.1}, limits), "aabb");
  EXPECT_EQ(runs_of({1.0, 1.1}, limits), "aa");
}

TEST(SurfaceRuns, NoStepIsTooSteep) {
  EXPECT_EQ(runs_of({1.0, 1.5, 2.0, 2.5}, limits), "abcd");
  EXPECT_EQ(runs_of({1.0, 2.0, 1.0, 1.0}, limits), "abcc");
  EXPECT_EQ(runs_of({1.0, 1.3}, {0.2, 0, 0.1, 2}), "aa");  // 0.115 of it is slant
}

TEST(SurfaceRuns, NoiseOfOneValueIsNoStep) {
  EXPECT_EQ(runs_of({1.0, 1.0, 1.01, 1.01, 1.0, 1.0, 1.01}, {0.011, 0, 0.2, 2}), "aaaaaaa");
  EXPECT_EQ(runs_of({1.0, 1.0, 1.02, 1.02, 1.0, 1.0}, {0.011, 0, 0.2, 2}), "aabbcc");
}

TEST(SurfaceRuns, ShortGapsArePassedOver) {
  EXPECT_EQ(runs_of({0, 1.0, 1.1, 0, 0, 1.4, 1.5, 0}, limits), ".aa..aa.");
  EXPECT_EQ(runs_of({1.0, 1.1, 0, 0, 0, 1.5, 1.6}, limits), "aa...bb");
  EXPECT_EQ(runs_of({1.0, 1.1, 0, 0, 1.6, 1.7}, limits), "aa..bb");  // a step behind the gap
  EXPECT_EQ(runs_of({0, 0, 0}, limits), "...");
  EXPECT_EQ(runs_of({0, 2.0, 0}, limits), ".a.");
}

}  // namespace
}  // namespace partwise
