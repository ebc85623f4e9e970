// Learns which borders between pieces of a surface people draw, for partwise/parts/surface/fitted_borders.cpp.
//
// border_fit MESHES_DIR SEG_DIR: takes every DIR/N.off that has SEG_DIR/N/*.seg, in Princeton's numbering. How likely a
// border is, is a logistic function of its terms (piece_graph.h); what it should be for two pieces is the share of the
// pairs of faces across that people put into different segments, mean over people. Borders to learn from are all
// that are met while pieces are merged, first by what people say, then by what was learnt before (Ross et al. 2011,
// DAgger), so that those of large pieces are among them. Printed: Rand errors over the odd numbers, which fit, and the
// even ones; over categories that were left out (three folds); and the weights.
#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/piece_merging.h"
#include "partwise/parts/surface/segmentation.h"

namespace {

using namespace partwise;

constexpr int kRounds = 3;
constexpr double kMergingThreshold = 0.6;  // while borders are collected
constexpr double kPenalty = 1;             // of squared weights, in units of the terms' deviation
constexpr std::array kThresholds = {0.4, 0.45, 0.5, 0.55, 0.6, 0.65};

struct Subject {
  int number = 0;
  PieceGraph graph;
  std::vector<Eigen::MatrixXd> people;  // of each, pieces x segments: faces in both
};

Subject read_subject(const std::filesystem::path& file, const std::filesystem::path& people) {
  const Mesh mesh = read_mesh(file);
  const Eigen::VectorXd visibility = feature_values(mesh, SurfaceFeature::visibility_average).col(0);
  const Eigen::VectorXd thickness = feature_values(mesh, SurfaceFeature::shape_diameter).col(0);
  const Components pieces = segmentation_pieces(mesh, visibility, thickness);
  Subject subject{std::stoi(file.stem().string()), PieceGraph(mesh, visibility, thickness, pieces), {}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(people))
    if (entry.path().extension() == ".seg") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& each : files) {
    const std::vector<int> labels = read_labels(each);
    std::map<int, Eigen::Index> column;
    for (const int label : labels) column.emplace(label, static_cast<Eigen::Index>(column.size()));
    Eigen::MatrixXd faces = Eigen::MatrixXd::Zero(pieces.count, static_cast<Eigen::Index>(column.size()));
    for (std::size_t f = 0; f < labels.size(); ++f) faces(pieces.label[f], column[labels[f]]) += 1;
    subject.people.push_back(std::move(faces));
  }
  return subject;
}

double pairs(double count) { return count * (count - 1) / 2; }

double rand_error(const Eigen::MatrixXd& faces) {
  const auto sum = [](const auto& counts) { return counts.unaryExpr(&pairs).sum(); };
  return (sum(faces.rowwise().sum()) + sum(faces.colwise().sum()) - 2 * sum(faces)) / pairs(faces.sum());
}

double parted(const Subject& subject, int a, int b) {
  double share = 0;
  for (const Eigen::MatrixXd& faces : subject.people)
    share += 1 - faces.row(a).dot(faces.row(b)) / (faces.row(a).sum() * faces.row(b).sum());
  return share / static_cast<double>(subject.people.size());
}

// The Rand error once all borders below the threshold are gone; `meet` is called for every border that is scored.
double merged_error(Subject subject, const std::function<double(const Subject&, int, int)>& score, double threshold,
                    const std::function<void(const Subject&, int, int)>& meet = {}) {
  merge_pieces(
      subject.graph,
      [&](const PieceGraph&, int a, int b) {
        if (meet) meet(subject, a, b);
        return score(subject, a, b);
      },
      threshold,
      [&](int a, int b) {
        for (Eigen::MatrixXd& faces : subject.people) faces.row(a) += faces.row(b).eval(), faces.row(b).setZero();
      });
  double error = 0;
  for (const Eigen::MatrixXd& faces : subject.people) error += rand_error(faces);
  return error / static_cast<double>(subject.people.size());
}

struct Borders {
  std::vector<BorderTerms> terms;
  std::vector<double> likelihoods, weights;
};

// Logistic regression by Newton's method, with a ridge.
BorderTerms fitted_weights(const Borders& borders) {
  const auto count = static_cast<Eigen::Index>(borders.terms.size());
  Eigen::Matrix<double, Eigen::Dynamic, border_terms> x(count, static_cast<int>(border_terms));
  for (Eigen::Index i = 0; i < count; ++i) x.row(i) = borders.terms[i].transpose();
  const Eigen::Map<const Eigen::VectorXd> y(borders.likelihoods.data(), count), weight(borders.weights.data(), count);
  Eigen::RowVector<double, border_terms> mean = x.colwise().mean(), deviation;
  mean[one] = 0;
  x.rowwise() -= mean;
  deviation = (x.colwise().squaredNorm() / static_cast<double>(count)).cwiseSqrt();
  x.array().rowwise() /= deviation.array();
  BorderTerms b = BorderTerms::Zero();
  for (int step = 0; step < 30; ++step) {
    const Eigen::ArrayXd p = 1 / (1 + (-(x * b)).array().exp());
    const BorderTerms gradient = x.transpose() * (weight.array() * (p - y.array())).matrix() + kPenalty * b;
    const Eigen::ArrayXd curvature = weight.array() * p * (1 - p);
    Eigen::Matrix<double, border_terms, border_terms> hessian = x.transpose() * curvature.matrix().asDiagonal() * x;
    hessian.diagonal().array() += kPenalty;
    b -= hessian.ldlt().solve(gradient);
  }
  BorderTerms weights = b.array() / deviation.transpose().array();
  weights[one] -= weights.dot(mean);
  return weights;
}

double model_score(const BorderModel& model, const Subject& subject, int a, int b) {
  return model.likelihood(subject.graph.terms(a, b));
}

using Chosen = std::function<bool(const Subject&)>;

double mean_error(const std::vector<Subject>& subjects, const Chosen& chosen, const BorderModel& model) {
  double sum = 0;
  int count = 0;
  for (const Subject& each : subjects) {
    if (!chosen(each)) continue;
    sum += merged_error(each, std::bind_front(model_score, model), model.threshold);
    ++count;
  }
  return sum / count;
}

BorderModel learn(const std::vector<Subject>& subjects, const Chosen& chosen) {
  Borders borders;
  BorderModel model;
  const auto meet = [&](const Subject& subject, int a, int b) {
    borders.terms.push_back(subject.graph.terms(a, b));
    borders.likelihoods.push_back(parted(subject, a, b));
    borders.weights.push_back(20 * std::sqrt(subject.graph.share(a) * subject.graph.share(b)) / subject.graph.pieces());
  };
  for (int round = 0; round < kRounds; ++round) {
    for (const Subject& each : subjects) {
      if (!chosen(each)) continue;
      if (round == 0) {
        merged_error(each, parted, 0.5, meet);
      } else {
        merged_error(each, std::bind_front(model_score, model), kMergingThreshold, meet);
      }
    }
    model.weights = fitted_weights(borders);
  }
  std::map<double, double> errors;
  for (const double threshold : kThresholds) {
    model.threshold = threshold;
    errors[mean_error(subjects, chosen, model)] = threshold;
  }
  model.threshold = errors.begin()->second;
  return model;
}

int category(const Subject& subject) { return (subject.number - 1) / 20; }

void report(const std::vector<Subject>& subjects) {
  const auto odd = [](const Subject& each) { return each.number % 2 == 1; };
  const BorderModel model = learn(subjects, odd);
  fmt::print("odd numbers, which fitted: {:.4f}\neven numbers: {:.4f}\nall: {:.4f}\n", mean_error(subjects, odd, model),
             mean_error(subjects, std::not_fn(odd), model),
             mean_error(
                 subjects, [](const Subject&) { return true; }, model));
  double sum = 0;
  for (int fold = 0; fold < 3; ++fold) {
    const auto out = [fold](const Subject& each) { return category(each) % 3 == fold; };
    const BorderModel other = learn(subjects, std::not_fn(out));
    for (const Subject& each : subjects)
      if (out(each)) sum += merged_error(each, std::bind_front(model_score, other), other.threshold);
  }
  fmt::print("categories that did not fit (three folds): {:.4f}\n", sum / static_cast<double>(subjects.size()));
  fmt::print("weights");
  for (const double weight : model.weights) fmt::print(" {:.4f}", weight);
  fmt::print("\nthreshold {}\n", model.threshold);
}

}  // namespace

int main(int count, char** words) {
  std::filesystem::path meshes, people;
  CLI::App app("Learns which borders people draw");
  app.add_option("MESHES_DIR", meshes)->required()->check(CLI::ExistingDirectory);
  app.add_option("SEG_DIR", people)->required()->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, count, words);
  try {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(meshes))
      if (entry.path().extension() == ".off" && std::filesystem::is_directory(people / entry.path().stem()))
        files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<Subject> subjects;
    for (const auto& file : files) {
      subjects.push_back(read_subject(file, people / file.stem()));
      std::cerr << '\r' << subjects.size() << " of " << files.size() << std::flush;
    }
    std::cerr << '\n';
    report(subjects);
  } catch (const std::exception& error) {
    std::cerr << "border_fit: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
