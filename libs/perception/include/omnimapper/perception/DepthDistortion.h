#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace omnimapper::perception {

/// The systematic error of a camera that triangulates (structured light, stereo), as a smooth function of the pixel:
/// 1/z = 1/z_measured + s(x, y), where x and y run from -1 to 1 over the image, from the left and upper rim to the
/// right and lower one. Since the error is one of disparity, that of the depth grows with its square: -s z^2.
///
/// s is a sum of products of Legendre polynomials, P_i(x) P_j(y), of the degrees 2 <= i + j <= degree. Degree 0 and 1
/// are missing: a plane's inverse depth is linear over the image, so that s with another constant or slope makes planes
/// as flat as before, and nobody can tell them from planes.
/// Sources: Herrera, Kannala, Heikkila: Joint depth and color camera calibration with distortion correction, PAMI
/// 34(10), 2012 (error of the disparity by pixel); Teichman, Miller, Thrun: Unsupervised intrinsic calibration of depth
/// sensors via SLAM, RSS 2013; Di Cicco, Iocchi, Grisetti: Non-parametric calibration for depth sensors, Robotics and
/// Autonomous Systems 74, 2015.
class DepthDistortion {
 public:
  static constexpr int kLeastDegree = 2, kMostDegree = 8;

  /// How many coefficients a degree has: (degree + 1) (degree + 2) / 2 - 3.
  static std::size_t termsOf(int degree);
  /// The products in the order of the coefficients, by i + j and then by j: P2(x), P1(x) P1(y), P2(y), P3(x), ...
  /// `values` has room for termsOf(degree).
  static void evaluate(int degree, double x, double y, double* values);

  /// Changes nothing.
  DepthDistortion() = default;
  /// [1/m]. None changes nothing. Throws Error(out_of_range) if they are not as many as a degree has, or one is not
  /// finite.
  explicit DepthDistortion(std::vector<double> coefficients);

  bool isNone() const { return coefficients_.empty(); }
  const std::vector<double>& coefficients() const { return coefficients_; }
  int degree() const { return degree_; }  ///< 0 of none
  /// s [1/m].
  double at(double x, double y) const;

  /// Corrects the range image in its own units, rounded. What was not measured stays so, and what would be at infinity
  /// or farther than 16 bits reach is not measured any more. Points that were made of the image are left out. A table
  /// for the size of the image is made once and kept; thread-safe.
  void applyTo(mrpt::obs::CObservation3DRangeScan& scan) const;

 private:
  struct ImageKey;
  struct Table;
  std::shared_ptr<const Table> tableOf(const mrpt::obs::CObservation3DRangeScan& scan) const;

  std::vector<double> coefficients_;
  int degree_ = 0;
  mutable std::shared_ptr<const Table> table_;  // read and replaced atomically
};

}  // namespace omnimapper::perception
