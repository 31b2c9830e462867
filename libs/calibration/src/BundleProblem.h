#pragma once

#include <ceres/ceres.h>

#include "Bundle.h"
#include "Residuals.h"

namespace omnimapper::calibration {

/// An estimate as blocks of numbers that the solver changes in place.
class BundleProblem {
 public:
  explicit BundleProblem(const Estimate& start);
  BundleProblem(const BundleProblem&) = delete;
  BundleProblem& operator=(const BundleProblem&) = delete;

  void add(const Measurement& measurement);
  void add(const MetricSpan& span, const std::vector<CalibrationView>& views);
  /// Frees these parameters, with weak priors at the values of `log`; all others of the camera are held.
  void setFree(const std::set<Group>& free, const DepthCamera& log);
  void holdCamera() { setFree({}, start_.camera); }
  void holdPoint(std::size_t track) { problem_.SetParameterBlockConstant(points_[track].data()); }
  void holdView(std::size_t view);
  /// Adds weak priors at the initial poses of the views, so that views that nothing else constrains stay there.
  void keepViewsNearStart();
  /// Throws Error(interrupted) if it is stopped.
  void solve(const std::function<bool()>& stop);

  Estimate estimate() const;
  /// The estimate, and the free parameters in the order of setFree() with the covariance that follows from all
  /// residuals.
  Adjusted adjusted();

 private:
  struct Number {
    Group group;
    int index;
    double* block;
    int at;  // index in the block
    double prior_sigma;
  };
  std::vector<Number> numbersOf(const std::set<Group>& free);
  /// Covariance of the numbers in `free_` from the Jacobian; points and poses are marginalized out.
  Eigen::MatrixXd covariance(const ceres::CRSMatrix& jacobian, std::size_t points, std::size_t pose_columns) const;

  Estimate start_;
  Intrinsics picture_, depth_;
  MotionBlock depth_from_picture_;
  double scale_;
  std::array<double, 3> timing_;
  std::vector<MotionBlock> views_;
  std::vector<std::array<double, 3>> points_;
  ceres::Problem problem_;
  std::vector<Number> free_;
};

}  // namespace omnimapper::calibration
