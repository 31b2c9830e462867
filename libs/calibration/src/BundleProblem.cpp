#include "BundleProblem.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace omnimapper::calibration {

namespace {

// Standard deviations beyond which residuals count less and less.
constexpr double kPixelLoss = 2, kDepthLoss = 2;

MotionBlock blockOf(const geometry::Se3& motion) {
  const Eigen::Vector3d turn = geometry::logSo3(motion.rotation);
  const Eigen::Vector3d& translation = motion.translation;
  return {turn.x(), turn.y(), turn.z(), translation.x(), translation.y(), translation.z()};
}

geometry::Se3 motionOf(const MotionBlock& block) {
  return {geometry::expSo3(Eigen::Vector3d(block[0], block[1], block[2])), {block[3], block[4], block[5]}};
}

class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_ && stop_() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& stop_;
};

}  // namespace

BundleProblem::BundleProblem(const Estimate& start)
    : start_(start),
      picture_(start.camera.picture),
      depth_(start.camera.depth),
      depth_from_picture_(blockOf(start.camera.depth_from_picture)),
      scale_(start.camera.depth_scale),
      timing_(start.timing) {
  for (const auto& view : start.picture_from_world) views_.push_back(blockOf(view));
  for (const auto& point : start.points) points_.push_back({point.x(), point.y(), point.z()});
}

void BundleProblem::add(const Measurement& one) {
  auto* view = views_[one.view].data();
  auto* point = points_[one.track].data();
  problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<PixelResidual, 2, 6, 3, 9, 3>(
                                new PixelResidual{one.pixel, one.sigma, one.row_share, one.velocity}),
                            new ceres::CauchyLoss(kPixelLoss), view, point, picture_.data(), timing_.data());
  if (!one.plane) return;
  auto* camera = start_.camera.is_registered ? picture_.data() : depth_.data();
  problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<DepthResidual, 1, 6, 3, 6, 9, 1, 3>(
                                new DepthResidual{*one.plane, one.depth_row_share, one.velocity}),
                            new ceres::CauchyLoss(kDepthLoss), view, point, depth_from_picture_.data(), camera, &scale_,
                            timing_.data());
}

void BundleProblem::add(const MetricSpan& span, const std::vector<CalibrationView>& views) {
  const auto base_in = [&](std::size_t view) { return inverse(views[view].base_from_picture).translation; };
  problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<DistanceResidual, 1, 6, 6>(new DistanceResidual{
                                base_in(span.first), base_in(span.second), span.distance, span.sigma}),
                            new ceres::CauchyLoss(kDepthLoss), views_[span.first].data(), views_[span.second].data());
}

void BundleProblem::holdView(std::size_t view) {
  if (problem_.HasParameterBlock(views_[view].data())) problem_.SetParameterBlockConstant(views_[view].data());
}

void BundleProblem::keepViewsNearStart() {
  constexpr double kTravel = 0.3, kTurn = 0.3;  // [m] [rad]
  const MotionBlock sigmas{kTurn, kTurn, kTurn, kTravel, kTravel, kTravel};
  for (auto& view : views_) {
    if (!problem_.HasParameterBlock(view.data())) continue;
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<BlockPrior, 6, 6>(new BlockPrior{view, sigmas}), nullptr,
                              view.data());
  }
}

// The prior standard deviations are roughly the errors of a camera that was never calibrated, with nominal values.
std::vector<BundleProblem::Number> BundleProblem::numbersOf(const std::set<Group>& free) {
  constexpr double kFocal = 0.05, kCentre = 20, kRadial = 1, kTangential = 0.01, kScale = 0.1, kReadout = 0.03,
                   kDelay = 0.01;  // [-] [px] [-] ... [s]
  constexpr double kDegree = base::option_text::kRadiansPerDegree;
  const bool one_camera = start_.camera.is_registered;
  const double turn = (one_camera ? 0.5 : 2) * kDegree, place = one_camera ? 0.005 : 0.02;  // [rad] [m]
  std::vector<Number> all;
  const auto put = [&](Group group, double* block, const std::vector<int>& at, const std::vector<double>& sigmas) {
    if (free.count(group) == 0) return;
    for (std::size_t i = 0; i < at.size(); ++i) all.push_back({group, static_cast<int>(i), block, at[i], sigmas[i]});
  };
  put(Group::focal, picture_.data(), {0, 1}, {kFocal * picture_[0], kFocal * picture_[1]});
  put(Group::centre, picture_.data(), {2, 3}, {kCentre, kCentre});
  put(Group::lens, picture_.data(), {4, 5, 6, 7, 8}, {kRadial, kRadial, kTangential, kTangential, kRadial});
  if (!one_camera) {
    put(Group::depth_focal, depth_.data(), {0, 1}, {kFocal * depth_[0], kFocal * depth_[1]});
    put(Group::depth_centre, depth_.data(), {2, 3}, {kCentre, kCentre});
  }
  put(Group::turn, depth_from_picture_.data(), {0, 1, 2}, {turn, turn, turn});
  put(Group::place, depth_from_picture_.data(), {3, 4, 5}, {place, place, place});
  put(Group::scale, &scale_, {0}, {kScale});
  put(Group::timing, timing_.data(), {0, 1, 2}, {kReadout, kReadout, kDelay});
  return all;
}

void BundleProblem::setFree(const std::set<Group>& free, const DepthCamera& log) {
  free_ = numbersOf(free);
  const BundleProblem of_log(Estimate{log, {}, {}, {}});
  const std::vector<std::pair<double*, const double*>> blocks = {
      {picture_.data(), of_log.picture_.data()},
      {depth_.data(), of_log.depth_.data()},
      {depth_from_picture_.data(), of_log.depth_from_picture_.data()},
      {&scale_, &of_log.scale_},
      {timing_.data(), of_log.timing_.data()}};
  const std::vector<int> sizes{9, 9, 6, 1, 3};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto [block, log_block] = blocks[b];
    if (!problem_.HasParameterBlock(block)) continue;
    std::vector<int> held;
    for (int i = 0; i < sizes[b]; ++i) {
      const auto number = std::find_if(free_.begin(), free_.end(),
                                       [&, block = block](const Number& n) { return n.block == block && n.at == i; });
      if (number == free_.end()) {
        held.push_back(i);
        continue;
      }
      auto* cost =
          new ceres::DynamicAutoDiffCostFunction<NumberPrior>(new NumberPrior{i, log_block[i], number->prior_sigma});
      cost->AddParameterBlock(sizes[b]);
      cost->SetNumResiduals(1);
      problem_.AddResidualBlock(cost, nullptr, block);
    }
    if (static_cast<int>(held.size()) == sizes[b]) {
      problem_.SetParameterBlockConstant(block);
    } else if (!held.empty()) {
      problem_.SetManifold(block, new ceres::SubsetManifold(sizes[b], held));
    }
  }
}

void BundleProblem::solve(const std::function<bool()>& stop) {
  StopCallback callback(stop);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.num_threads = 1;  // sums have a fixed order, so the same input gives the same bits
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-6;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&callback);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<double*> blocks;
  problem_.GetParameterBlocks(&blocks);
  std::set<const double*> points;
  for (const auto& point : points_) points.insert(point.data());
  for (double* block : blocks) ordering->AddElementToGroup(block, points.count(block) > 0 ? 0 : 1);
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  if (stop && stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
  if (!summary.IsSolutionUsable())
    throw base::Error(base::ExitCode::internal, "the bundle adjustment failed: " + summary.message);
}

Estimate BundleProblem::estimate() const {
  Estimate now = start_;
  now.camera.picture = picture_;
  now.camera.depth = depth_;
  now.camera.depth_from_picture = motionOf(depth_from_picture_);
  now.camera.depth_scale = scale_;
  now.timing = timing_;
  for (std::size_t i = 0; i < views_.size(); ++i) now.picture_from_world[i] = motionOf(views_[i]);
  for (std::size_t i = 0; i < points_.size(); ++i) now.points[i] = Eigen::Vector3d(points_[i].data());
  return now;
}

Adjusted BundleProblem::adjusted() {
  Adjusted result;
  result.estimate = estimate();
  ceres::Problem::EvaluateOptions options;
  std::size_t points = 0, pose_columns = 0;
  for (auto& point : points_) {
    if (!problem_.HasParameterBlock(point.data()) || problem_.IsParameterBlockConstant(point.data())) continue;
    options.parameter_blocks.push_back(point.data());
    ++points;
  }
  for (auto& view : views_) {
    if (!problem_.HasParameterBlock(view.data()) || problem_.IsParameterBlockConstant(view.data())) continue;
    options.parameter_blocks.push_back(view.data());
    pose_columns += 6;
  }
  for (double* block : {picture_.data(), depth_.data(), depth_from_picture_.data(), &scale_, timing_.data()}) {
    if (problem_.HasParameterBlock(block) && !problem_.IsParameterBlockConstant(block))
      options.parameter_blocks.push_back(block);
  }
  ceres::CRSMatrix jacobian;
  problem_.Evaluate(options, &result.cost, nullptr, nullptr, free_.empty() ? nullptr : &jacobian);
  result.residuals = static_cast<std::size_t>(problem_.NumResiduals());
  if (free_.empty()) return result;
  // Sorts the numbers like the columns: by block, then by their index in it.
  const std::vector<const double*> order{picture_.data(), depth_.data(), depth_from_picture_.data(), &scale_,
                                         timing_.data()};
  const auto rank = [&](const Number& n) {
    return std::make_pair(std::find(order.begin(), order.end(), n.block) - order.begin(), n.at);
  };
  std::sort(free_.begin(), free_.end(), [&](const Number& a, const Number& b) { return rank(a) < rank(b); });
  const double unknowns = 3.0 * static_cast<double>(points) + static_cast<double>(pose_columns + free_.size());
  const double left = std::max(1.0, static_cast<double>(result.residuals) - unknowns);
  result.covariance = std::max(1.0, 2 * result.cost / left) * covariance(jacobian, points, pose_columns);
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double variance = result.covariance(at, at);
    result.parameters.push_back({free_[i].group, free_[i].index, free_[i].block[free_[i].at], free_[i].prior_sigma,
                                 std::sqrt(std::max(0.0, variance))});
  }
  return result;
}

Eigen::MatrixXd BundleProblem::covariance(const ceres::CRSMatrix& jacobian, std::size_t points,
                                          std::size_t pose_columns) const {
  const auto numbers = static_cast<Eigen::Index>(free_.size());
  const Eigen::Index rest = static_cast<Eigen::Index>(pose_columns) + numbers;
  const int first_other = 3 * static_cast<int>(points);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(rest, rest);
  std::vector<Eigen::Matrix3d> of_point(points, Eigen::Matrix3d::Zero());
  std::vector<std::map<Eigen::Index, Eigen::Vector3d>> cross(points);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto begin = static_cast<std::size_t>(jacobian.rows[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(jacobian.rows[static_cast<std::size_t>(row) + 1]);
    Eigen::Vector3d point_part = Eigen::Vector3d::Zero();
    std::size_t point = points;
    std::vector<std::pair<Eigen::Index, double>> others;
    for (std::size_t k = begin; k < end; ++k) {
      const int column = jacobian.cols[k];
      if (column < first_other) {
        point = static_cast<std::size_t>(column / 3);
        point_part[column % 3] = jacobian.values[k];
      } else {
        others.emplace_back(column - first_other, jacobian.values[k]);
      }
    }
    for (const auto& [i, a] : others)
      for (const auto& [j, b] : others) information(i, j) += a * b;
    if (point == points) continue;
    of_point[point] += point_part * point_part.transpose();
    for (const auto& [i, a] : others) cross[point].emplace(i, Eigen::Vector3d::Zero()).first->second += a * point_part;
  }
  for (std::size_t p = 0; p < points; ++p) {
    const Eigen::LLT<Eigen::Matrix3d> inverse(of_point[p]);
    if (inverse.info() != Eigen::Success) continue;
    for (const auto& [i, a] : cross[p]) {
      const Eigen::Vector3d weighted = inverse.solve(a);
      for (const auto& [j, b] : cross[p]) information(i, j) -= weighted.dot(b);
    }
  }
  const Eigen::LDLT<Eigen::MatrixXd> factored(information);
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(rest, numbers);
  unit.bottomRows(numbers).setIdentity();
  if (factored.info() != Eigen::Success || !factored.isPositive())
    return Eigen::MatrixXd::Identity(numbers, numbers) * std::numeric_limits<double>::max();
  return factored.solve(unit).bottomRows(numbers);
}

}  // namespace omnimapper::calibration
