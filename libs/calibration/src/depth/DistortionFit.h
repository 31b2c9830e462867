#pragma once

#include <omnimapper/perception/DepthDistortion.h>

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "FlatPatches.h"

namespace omnimapper::calibration {

struct DistortionFit {
  perception::DepthDistortion distortion;
  Eigen::MatrixXd covariance;  ///< of its coefficients [1/m^2]
  double scale = 0;            ///< [1/m] robust standard deviation of a sample about its plane

  /// Standard deviation of the distortion there [1/m].
  double sigmaAt(double x, double y) const;
};

/// The distortion that makes the patches flat, each with a plane of its own. The covariance takes each image as one
/// witness, for its samples share what is not flat in the scene (the sandwich estimator of Huber and White), and a weak
/// prior of 0.02/m holds what the patches do not show. Throws Error(interrupted) if it is stopped.
DistortionFit fitDistortion(const std::vector<FlatPatch>& patches, int degree, const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
