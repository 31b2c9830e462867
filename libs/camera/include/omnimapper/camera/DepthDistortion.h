#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace omnimapper::camera {

/// The systematic error of a camera that triangulates (structured light, stereo), as a smooth function of the pixel:
/// 1/z = 1/z_measured + s(x, y), where x runs from -1 to 1 from the left to the right edge of the image, and y from the
/// upper to the lower edge. Each pixel's disparity is wrong by a constant. The correction of its depth is about -s z^2,
/// so it grows with the squared depth.
///
/// s is a sum of products of Legendre polynomials, P_i(x) P_j(y), of the degrees 2 <= i + j <= degree. Degrees 0 and 1
/// are missing because they cannot be determined: a plane's inverse depth is linear over the image, so that planes stay
/// flat whatever constant and linear part s has. Sources: Herrera, Kannala, Heikkila: Joint depth and color camera
/// calibration with distortion correction, PAMI 34(10), 2012 (error of the disparity by pixel); Teichman, Miller,
/// Thrun: Unsupervised intrinsic calibration of depth sensors via SLAM, RSS 2013; Di Cicco, Iocchi, Grisetti:
/// Non-parametric calibration for depth sensors, Robotics and Autonomous Systems 74, 2015.
class DepthDistortion {
 public:
  static constexpr int kLeastDegree = 2, kMostDegree = 8;

  /// Number of coefficients of a distortion of this degree: (degree + 1) (degree + 2) / 2 - 3.
  static std::size_t termsOf(int degree);
  /// Computes the products P_i(x) P_j(y) in the order of the coefficients, which are sorted by i + j and then by j:
  /// P2(x), P1(x) P1(y), P2(y), P3(x), ... `values` must have room for termsOf(degree) numbers.
  static void evaluate(int degree, double x, double y, double* values);

  /// A distortion that changes nothing.
  DepthDistortion() = default;
  /// Coefficients are in 1/m; an empty list changes nothing. Throws Error(out_of_range) if no degree has this number of
  /// coefficients, or if a coefficient is not finite.
  explicit DepthDistortion(std::vector<double> coefficients);

  bool isNone() const { return coefficients_.empty(); }
  const std::vector<double>& coefficients() const { return coefficients_; }
  int degree() const { return degree_; }  ///< 0 without coefficients
  /// The value of s at (x, y) [1/m].
  double at(double x, double y) const;

  /// Corrects the range image; the results are rounded to its units. Pixels that were not measured stay unmeasured, and
  /// pixels whose corrected depth is infinite or too large for 16 bits become unmeasured. 3D points that were made of
  /// the uncorrected image are removed. A table for the size of the image is computed once and kept. Thread-safe.
  void applyTo(mrpt::obs::CObservation3DRangeScan& scan) const;

 private:
  struct ImageKey;
  struct Table;
  std::shared_ptr<const Table> tableOf(const mrpt::obs::CObservation3DRangeScan& scan) const;

  std::vector<double> coefficients_;
  int degree_ = 0;
  mutable std::shared_ptr<const Table> table_;  // read and replaced atomically
};

}  // namespace omnimapper::camera
