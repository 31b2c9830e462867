#include "DistortionFit.h"

#include <ceres/ceres.h>
#include <omnimapper/base/Error.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace omnimapper::calibration {

namespace {

using camera::DepthDistortion;

constexpr double kPrior = 0.02;  // [1/m] of each coefficient; the largest known ones are a third of it
constexpr double kLoss = 2;      // standard deviations beyond which a sample counts less and less

/// Inverse depth of a sample minus that of its plane, in standard deviations. Linear in the plane and in the
/// coefficients.
class Flatness : public ceres::CostFunction {
 public:
  Flatness(const FlatSample& sample, int degree, double sigma) : sample_(sample), sigma_(sigma) {
    products_.resize(DepthDistortion::termsOf(degree));
    DepthDistortion::evaluate(degree, sample.x, sample.y, products_.data());
    *mutable_parameter_block_sizes() = {3, static_cast<int>(products_.size())};
    set_num_residuals(1);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const double* plane = blocks[0];
    double miss = sample_.inverse_depth - plane[0] - plane[1] * sample_.x - plane[2] * sample_.y;
    for (std::size_t i = 0; i < products_.size(); ++i) miss += blocks[1][i] * products_[i];
    residuals[0] = miss / sigma_;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      jacobians[0][0] = -1 / sigma_;
      jacobians[0][1] = -sample_.x / sigma_;
      jacobians[0][2] = -sample_.y / sigma_;
    }
    if (jacobians[1] != nullptr)
      for (std::size_t i = 0; i < products_.size(); ++i) jacobians[1][i] = products_[i] / sigma_;
    return true;
  }

 private:
  FlatSample sample_;
  double sigma_;
  std::vector<double> products_;
};

/// Weak prior of each coefficient at 0.
class WeakPrior : public ceres::CostFunction {
 public:
  explicit WeakPrior(int terms) {
    *mutable_parameter_block_sizes() = {terms};
    set_num_residuals(terms);
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int terms = num_residuals();
    for (int i = 0; i < terms; ++i) residuals[i] = blocks[0][i] / kPrior;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill(jacobians[0], jacobians[0] + terms * terms, 0.0);
    for (int i = 0; i < terms; ++i) jacobians[0][i * terms + i] = 1 / kPrior;
    return true;
  }
};

class StopWhenAsked : public ceres::IterationCallback {
 public:
  explicit StopWhenAsked(const std::function<bool()>& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& stop_;
};

// Robust standard deviation, from the median of the absolute residuals. It is never less than the error that the
// sensor's quantization leaves in the mean of a cell.
double scaleOf(const std::vector<FlatPatch>& patches, const DepthDistortion& known, double before) {
  constexpr double kLeast = 1e-4, kOfMedian = 1.4826;  // [1/m] [-]
  std::vector<double> sizes;
  for (const auto& patch : patches)
    for (const double miss : missesOf(patch, known, before)) sizes.push_back(std::abs(miss));
  if (sizes.empty()) return kLeast;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeast, kOfMedian * *middle);
}

std::vector<double> solve(const std::vector<FlatPatch>& patches, int degree, double scale,
                          const std::function<bool()>& stop) {
  std::vector<double> coefficients(DepthDistortion::termsOf(degree), 0.0);
  std::vector<std::array<double, 3>> planes(patches.size());
  ceres::Problem problem;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    Eigen::Map<Eigen::Vector3d>(planes[p].data()) = fitPlane(patches[p], {}, scale);
    for (const auto& sample : patches[p].samples)
      problem.AddResidualBlock(new Flatness(sample, degree, scale), new ceres::CauchyLoss(kLoss), planes[p].data(),
                               coefficients.data());
    ordering->AddElementToGroup(planes[p].data(), 0);
  }
  problem.AddResidualBlock(new WeakPrior(static_cast<int>(coefficients.size())), nullptr, coefficients.data());
  ordering->AddElementToGroup(coefficients.data(), 1);
  StopWhenAsked callback(stop);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.linear_solver_ordering = ordering;
  options.num_threads = 1;  // sums have a fixed order, so the same input gives the same bits
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
  if (!summary.IsSolutionUsable())
    throw base::Error(base::ExitCode::internal, "the fit of the distortion failed: " + summary.message);
  return coefficients;
}

/// Normal equations of the coefficients, with the parameters of the planes eliminated.
struct NormalEquations {
  Eigen::MatrixXd information;  // [m^2]
  Eigen::VectorXd gradient;     // [m]
};

NormalEquations& operator+=(NormalEquations& sum, const NormalEquations& other) {
  sum.information += other.information;
  sum.gradient += other.gradient;
  return sum;
}

NormalEquations normalEquationsOf(const FlatPatch& patch, const DepthDistortion& distortion, double scale) {
  const auto terms = static_cast<Eigen::Index>(distortion.coefficients().size());
  const auto misses = missesOf(patch, distortion, kLoss * scale);
  const auto count = static_cast<Eigen::Index>(misses.size());
  Eigen::MatrixXd products(count, terms);
  Eigen::MatrixX3d plane(count, 3);
  Eigen::VectorXd weights(count), residuals(count), row(terms);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& s = patch.samples[static_cast<std::size_t>(i)];
    DepthDistortion::evaluate(distortion.degree(), s.x, s.y, row.data());
    products.row(i) = row.transpose();
    plane.row(i) << 1, s.x, s.y;
    residuals[i] = misses[static_cast<std::size_t>(i)];
    weights[i] = 1 / (std::pow(residuals[i] / (kLoss * scale), 2) + 1);
  }
  weights /= scale * scale;
  const Eigen::MatrixX3d weighted_plane = weights.asDiagonal() * plane;
  const Eigen::LDLT<Eigen::Matrix3d> normal(weighted_plane.transpose() * plane);
  products -= plane * normal.solve(weighted_plane.transpose() * products);
  const Eigen::MatrixXd weighted = weights.asDiagonal() * products;
  return {weighted.transpose() * products, weighted.transpose() * residuals};
}

// Jackknife over blocks, from the change of the coefficients when a block is left out, in one Newton step.
Eigen::MatrixXd covarianceOf(const std::vector<FlatPatch>& patches, const DepthDistortion& distortion, double scale) {
  constexpr std::size_t kBlocks = 10;
  const auto terms = static_cast<Eigen::Index>(distortion.coefficients().size());
  const Eigen::MatrixXd prior = Eigen::MatrixXd::Identity(terms, terms) / (kPrior * kPrior);
  std::size_t images = 1;
  for (const auto& patch : patches) images = std::max(images, patch.image + 1);
  std::map<std::size_t, NormalEquations> blocks;
  const NormalEquations nothing{Eigen::MatrixXd::Zero(terms, terms), Eigen::VectorXd::Zero(terms)};
  NormalEquations all = nothing;
  for (const auto& patch : patches) {
    const auto of_patch = normalEquationsOf(patch, distortion, scale);
    blocks.emplace(patch.image * kBlocks / images, nothing).first->second += of_patch;
    all += of_patch;
  }
  const auto known = (prior + all.information).ldlt();
  Eigen::MatrixXd covariance = known.solve(known.solve(prior).transpose());
  const auto count = static_cast<double>(blocks.size());
  for (const auto& [block, of_block] : blocks) {
    const Eigen::VectorXd change = (prior + all.information - of_block.information).ldlt().solve(of_block.gradient);
    covariance += (count - 1) / count * change * change.transpose();
  }
  return covariance;
}

}  // namespace

double DistortionFit::sigmaAt(double x, double y) const {
  Eigen::VectorXd products(covariance.rows());
  DepthDistortion::evaluate(distortion.degree(), x, y, products.data());
  return std::sqrt(std::max(0.0, products.dot(covariance * products)));
}

DistortionFit fitDistortion(const std::vector<FlatPatch>& patches, int degree, const std::function<bool()>& stop) {
  constexpr int kRounds = 2;
  constexpr double kRough = 0.002;  // [1/m]
  DistortionFit fit;
  fit.scale = scaleOf(patches, {}, kRough);
  for (int round = 0; round < kRounds; ++round) {
    fit.distortion = DepthDistortion(solve(patches, degree, fit.scale, stop));
    fit.scale = scaleOf(patches, fit.distortion, kLoss * fit.scale);
  }
  fit.covariance = covarianceOf(patches, fit.distortion, fit.scale);
  return fit;
}

}  // namespace omnimapper::calibration
