#include "partwise/motion/margin_classifier.h"

#include <libsvm/svm.h>

#include <cmath>
#include <memory>

#include "partwise/base/error.h"

namespace partwise {
namespace {

struct FreeModel {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};

// libsvm's view of the points: a row each of (number, coordinate), ended by number -1.
class Problem {
 public:
  Problem(const MotionPoints& points, Eigen::Index positive) {
    const Eigen::Index columns = points.cols();
    nodes_.reserve(static_cast<std::size_t>(points.rows() * (columns + 1)));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      signs_.push_back(i < positive ? 1 : -1);
      for (Eigen::Index k = 0; k < columns; ++k) nodes_.push_back({static_cast<int>(k) + 1, points(i, k)});
      nodes_.push_back({-1, 0});
    }
    for (std::size_t i = 0; i < signs_.size(); ++i) rows_.push_back(&nodes_[i * static_cast<std::size_t>(columns + 1)]);
  }

  svm_problem view() { return {static_cast<int>(signs_.size()), signs_.data(), rows_.data()}; }

 private:
  std::vector<svm_node> nodes_;
  std::vector<svm_node*> rows_;
  std::vector<double> signs_;
};

svm_parameter parameters(const MarginSettings& settings) {
  svm_parameter result{};
  result.svm_type = C_SVC;
  result.kernel_type = RBF;
  result.gamma = 1 / (2 * settings.width * settings.width);
  result.C = settings.cost;
  result.eps = 1e-3;
  result.cache_size = 40;  // MB
  result.shrinking = 1;
  return result;
}

}  // namespace

MarginClassifier::MarginClassifier(const MotionPoints& points, Eigen::Index positive, const MarginSettings& settings)
    : width_(settings.width) {
  PARTWISE_CHECK(positive, >, 0);
  PARTWISE_CHECK(positive, <, points.rows());
  svm_set_print_string_function([](const char*) {});
  Problem problem(points, positive);
  const svm_problem view = problem.view();
  const svm_parameter parameter = parameters(settings);
  const std::unique_ptr<svm_model, FreeModel> model(svm_train(&view, &parameter));

  supports_ = model->l;
  const double sign = model->label[0] > 0 ? 1 : -1;
  offset_ = -sign * model->rho[0];
  const Eigen::Index filled = (supports_ + lane - 1) / lane * lane;
  points_ = Eigen::ArrayXXd::Zero(filled, points.cols());
  weights_ = Eigen::ArrayXd::Zero(filled);
  for (int i = 0; i < supports_; ++i) {
    points_.row(i) = points.row(model->sv_indices[i] - 1).array();
    weights_[i] = sign * model->sv_coef[0][i];
  }
}

double MarginClassifier::value(const MotionVector& x) const {
  using Lane = Eigen::Array<double, lane, 1>;
  const double gamma = 1 / (2 * width_ * width_);
  Lane sum = Lane::Zero();
  for (Eigen::Index i = 0; i < weights_.size(); i += lane) {
    Lane distance = Lane::Zero();
    for (Eigen::Index k = 0; k < points_.cols(); ++k) distance += (points_.col(k).segment<lane>(i) - x[k]).square();
    sum += weights_.segment<lane>(i) * (-gamma * distance).exp();
  }
  return sum.sum() + offset_;
}

FieldValue MarginClassifier::at(const MotionVector& x) const {
  using Lane = Eigen::Array<double, lane, 1>;
  const double gamma = 1 / (2 * width_ * width_);
  FieldValue result{offset_, MotionVector::Zero(x.size())};
  for (Eigen::Index i = 0; i < weights_.size(); i += lane) {
    Lane distance = Lane::Zero();
    for (Eigen::Index k = 0; k < points_.cols(); ++k) distance += (points_.col(k).segment<lane>(i) - x[k]).square();
    const Lane share = weights_.segment<lane>(i) * (-gamma * distance).exp();
    result.value += share.sum();
    for (Eigen::Index k = 0; k < points_.cols(); ++k)
      result.gradient[k] += (share * (points_.col(k).segment<lane>(i) - x[k])).sum();
  }
  result.gradient *= 2 * gamma;
  return result;
}

}  // namespace partwise
