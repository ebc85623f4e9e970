#include "partwise/appearance/material/material_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "partwise/base/error.h"
#include "partwise/base/test_corpus.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

const std::filesystem::path kCorpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "material_corpus";

std::vector<Dsbrdf> training_fits() {
  const std::vector<std::string> test = test_materials();
  std::vector<Dsbrdf> fits;
  for (const std::string& name : shipped_materials()) {
    if (std::ranges::count(test, name) == 0) fits.push_back(shipped_material(name).brdf);
  }
  return fits;
}

TEST(MaterialFiles, AHundredShipAndTwentyOfThemAreForTests) {
  const std::vector<std::string> names = shipped_materials(), test = test_materials();
  EXPECT_EQ(names.size(), 100u);
  EXPECT_EQ(test.size(), 20u);
  for (const std::string& name : test) EXPECT_TRUE(std::ranges::binary_search(names, name)) << name;
  const DsbrdfChannel least = least_coefficients().array() - 1e-4, largest = largest_coefficients().array() + 1e-4;
  for (const std::string& name : names) {
    const MaterialFile material = shipped_material(name);
    EXPECT_EQ(material.name, name);
    EXPECT_LE(material.log_rmse.value(), 0.4);
    for (int channel = 0; channel < 3; ++channel) {
      const DsbrdfChannel own =
          material.brdf.coefficients().segment<dsbrdf_channel_size>(channel * dsbrdf_channel_size);
      EXPECT_TRUE((own.array() >= least.array()).all() && (own.array() <= largest.array()).all()) << name;
    }
  }
  EXPECT_THROW(shipped_material("no-such-material"), InputError);
  EXPECT_THROW(shipped_material("../material_basis"), InputError);
}

TEST(MaterialFiles, KeepSixDigitsAndAreStable) {
  const MaterialFile chrome = shipped_material("chrome");
  const std::string text = encode_material(chrome);
  const MaterialFile again = decode_material("chrome.json", text);
  EXPECT_EQ(again.brdf.coefficients(), chrome.brdf.coefficients());
  EXPECT_EQ(again.log_rmse, chrome.log_rmse);
  EXPECT_EQ(encode_material(again), text);
  EXPECT_EQ(decode_material("x", encode_material({"x", {}, chrome.brdf})).log_rmse, std::nullopt);
}

TEST(MaterialFiles, CorpusGivesTheMessagesThatAreExpected) {
  test::replay_corpus(kCorpus, [](const std::filesystem::path& path, const nlohmann::json&) {
    if (path.extension() == ".json") {
      read_material(path);
    } else {
      read_measured(path);
    }
  });
  test::expect_all_listed(kCorpus, {"README.md"});
}

TEST(DsbrdfBasis, ShippedOneIsThatOfTheTrainingMaterials) {
  const DsbrdfBasis shipped = shipped_basis(), made = principal_components(training_fits(), 32);
  ASSERT_GE(shipped.size(), default_components);
  EXPECT_LT((shipped.mean - made.mean).norm(), 1e-4 * made.mean.norm());
  for (int j = 0; j < 8; ++j) {  // later ones may be near in variance, and so turn into each other by rounding
    const double cosine = std::abs(shipped.components.col(j).normalized().dot(made.components.col(j).normalized()));
    EXPECT_GT(cosine, 0.999) << j;
  }
}

TEST(DsbrdfBasis, ProjectionUndoesTheMaterial) {
  const DsbrdfBasis basis = shipped_basis();
  EXPECT_LT((basis.projection * basis.components - Eigen::MatrixXd::Identity(basis.size(), basis.size())).norm(), 1e-2);
  const DsbrdfBasis few = basis.first(5);
  const Eigen::VectorXd psi = (Eigen::VectorXd(5) << 0.3, -0.2, 0.1, 0.2, -0.1).finished();
  const DsbrdfCoefficients coefficients = few.mean + few.components * psi;
  EXPECT_LT((few.project(Dsbrdf(coefficients)) - psi).norm(), 1e-3);
  EXPECT_LT((few.material(Eigen::VectorXd::Zero(5)).coefficients() - few.mean).norm(), 1e-9);
}

TEST(DsbrdfBasis, ComponentsAreWhiteOverTheMaterialsTheyCameFrom) {
  const std::vector<Dsbrdf> fits = training_fits();
  const DsbrdfBasis basis = principal_components(fits, 20);
  Eigen::MatrixXd psi(20, static_cast<Eigen::Index>(fits.size()));
  for (std::size_t i = 0; i < fits.size(); ++i) psi.col(static_cast<Eigen::Index>(i)) = basis.project(fits[i]);
  const Eigen::MatrixXd covariance = psi * psi.transpose() / (static_cast<double>(fits.size()) - 1);
  EXPECT_LT((covariance - Eigen::MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-6);
  // As many as there can be give every material back.
  const DsbrdfBasis whole = principal_components(fits, 79);
  for (const std::size_t i : {0u, 17u, 79u}) {
    const DsbrdfCoefficients back = whole.material(whole.project(fits[i])).coefficients();
    EXPECT_LT((back - fits[i].coefficients()).norm(), 1e-5 * fits[i].coefficients().norm());
  }
}

TEST(DsbrdfBasis, MoreComponentsComeNearer) {
  const MaterialFile unseen = shipped_material("red-specular-plastic");
  const HalfAngleTable measured = mean_over_phi(tabulate(unseen.brdf));
  const DsbrdfBasis basis = shipped_basis();
  double before = 1e9;
  for (const int components : {4, 16, 64}) {
    const DsbrdfBasis few = basis.first(components);
    const double now = log_rmse(measured, few.material(fit_in_basis(few, measured, unseen.brdf)));
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_LT(before, 0.1);
}

}  // namespace
}  // namespace partwise
