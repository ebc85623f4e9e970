#include "partwise/appearance/material/merl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Merl, EveryBinHoldsItsCentre) {
  int wrong = 0, wrong_directions = 0;
  for (int bin = 0; bin < merl_bins; ++bin) {
    const HalfAngles centre = merl_centre(bin);
    const DirectionPair pair = directions_of(centre);
    wrong += merl_bin(centre) != bin;
    wrong_directions += merl_bin(half_angles(pair.to_light, pair.to_viewer)) != bin;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(wrong_directions, 0);
}

TEST(Merl, BinsAreThoseOfTheFormat) {
  EXPECT_EQ(merl_bin({0, 0, 0}), 0);
  EXPECT_EQ(merl_bin({0, 0, 1.5 * kDegree}), 1);
  EXPECT_EQ(merl_bin({0, 1.5 * kDegree, 0}), 180);
  EXPECT_EQ(merl_bin({1 * kDegree, 0, 0}), 9 * 90 * 180);  // floor(90 sqrt(1 / 90))
  EXPECT_EQ(merl_bin({50 * kDegree, 0, 0}), 67 * 90 * 180);
  EXPECT_EQ(merl_bin({0, 0, -178.5 * kDegree}), 1);  // half a turn further
  EXPECT_EQ(merl_bin({90 * kDegree, 90 * kDegree, 180 * kDegree}), merl_bins - 1);
  EXPECT_EQ(merl_bin({95 * kDegree, -1, 0}), 89 * 90 * 180);
}

TEST(Merl, WritesWhatItReadsByteForByte) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 3);
  MerlTable table;
  for (int bin = 0; bin < merl_bins; bin += 7) table.set(bin, {uniform(random), uniform(random), uniform(random)});
  const TestFolder folder;
  write_merl(folder.path() / "a.binary", table);
  const MerlTable read = read_merl(folder.path() / "a.binary");
  write_merl(folder.path() / "b.binary", read);
  const std::string bytes = read_bytes(folder.path() / "a.binary");
  EXPECT_EQ(bytes.size(), 34992012u);
  EXPECT_TRUE(bytes == read_bytes(folder.path() / "b.binary"));
  EXPECT_EQ(read.stored(), table.stored());
}

TEST(Merl, ScalesChannelsAndSkipsWhatWasNotMeasured) {
  MerlTable table;
  EXPECT_FALSE(table.measured(0));
  table.set(0, {1, 1, 1});
  EXPECT_TRUE(table.measured(0));
  EXPECT_DOUBLE_EQ(table.stored()[0], 1500);
  EXPECT_DOUBLE_EQ(table.stored()[merl_bins], 1500 / 1.15);
  EXPECT_DOUBLE_EQ(table.stored()[2 * merl_bins], 1500 / 1.66);
  const Eigen::Vector3f up(0, 0, 1), slanted = Eigen::Vector3f(1, 0, 1).normalized();
  EXPECT_EQ(table(up, up), Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ(table(slanted, up), Eigen::Vector3f::Zero());
  EXPECT_EQ(table(-up, up), Eigen::Vector3f::Zero());
  table.set(0, {1, -1, 1});
  EXPECT_EQ(table(up, up), Eigen::Vector3f::Zero());
}

TEST(Merl, TabulatesAboveTheHorizonAlone) {
  const MerlTable table = tabulate(MicrofacetBrdf({0.5, 0.25, 0.1}));
  int wrong = 0;
  for (int bin = 0; bin < merl_bins; ++bin) {
    const DirectionPair pair = directions_of(merl_centre(bin));
    const bool above = pair.to_light.z() > 0 && pair.to_viewer.z() > 0;
    const Eigen::Vector3d expected = Eigen::Vector3d(0.5, 0.25, 0.1) / std::numbers::pi;
    wrong += table.measured(bin) != above || (above && (table.value(bin) - expected).norm() > 1e-6);
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Merl, RefusesWholeFilesWithANumberThatIsNotFinite) {
  const TestFolder folder;
  write_merl(folder.path() / "a.binary", MerlTable());
  std::string bytes = read_bytes(folder.path() / "a.binary");
  const double bad = std::numeric_limits<double>::infinity();
  bytes.replace(12 + 8 * 1000, 8, reinterpret_cast<const char*>(&bad), 8);
  try {
    decode_merl("a.binary", bytes);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("value 1001 of 4374000"));
  }
  EXPECT_THROW(decode_merl("a.binary", bytes + " "), InputError);
}

}  // namespace
}  // namespace partwise
