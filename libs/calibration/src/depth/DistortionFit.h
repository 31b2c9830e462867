#pragma once

#include <omnimapper/camera/DepthDistortion.h>

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "FlatPatches.h"

namespace omnimapper::calibration {

struct DistortionFit {
  camera::DepthDistortion distortion;
  Eigen::MatrixXd covariance;  ///< of its coefficients [1/m^2]
  double scale = 0;            ///< [1/m] robust standard deviation of a sample about its plane

  /// Standard deviation of the distortion there [1/m].
  double sigmaAt(double x, double y) const;
};

/// Fits the distortion that makes the patches flat, with a separate plane for each. A weak prior of 0.02/m on each
/// coefficient constrains what the patches do not show. The covariance is from a jackknife over ten blocks of
/// consecutive images, because such images show the same scene, and its parts that are not quite flat bias all of them
/// alike. Source: Kuensch: The jackknife and the bootstrap for general stationary observations, Annals of Statistics
/// 17(3), 1989. Throws Error(interrupted) if it is stopped.
DistortionFit fitDistortion(const std::vector<FlatPatch>& patches, int degree, const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
