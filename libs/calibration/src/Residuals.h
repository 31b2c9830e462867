#pragma once

#include <ceres/rotation.h>
#include <omnimapper/calibration/DepthCamera.h>

#include <array>

#include "CalibrationView.h"

namespace omnimapper::calibration {

/// A motion as a parameter block of the solver: rotation vector [rad], then translation [m].
using MotionBlock = std::array<double, 6>;

template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> moved(const Scalar* motion, const Eigen::Matrix<Scalar, 3, 1>& point) {
  Eigen::Matrix<Scalar, 3, 1> p;
  ceres::AngleAxisRotatePoint(motion, point.data(), p.data());
  return {p.x() + motion[3], p.y() + motion[4], p.z() + motion[5]};
}

/// Times within an image [s]: readout of the picture from its first row to its last, the same of the depths, and delay
/// of the depths' middle after the picture's.
using Timing = std::array<double, 3>;

/// The coordinates of a fixed point in the frame of a moving camera after `seconds`. `velocity` is in that frame: v
/// [m/s], w [rad/s].
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> later(const Eigen::Matrix<Scalar, 3, 1>& p, const geometry::Vector6d& velocity,
                                  const Scalar& seconds) {
  const Eigen::Vector3d v = velocity.head<3>(), w = velocity.tail<3>();
  return {p.x() - seconds * (v[0] + w[1] * p.z() - w[2] * p.y()),
          p.y() - seconds * (v[1] + w[2] * p.x() - w[0] * p.z()),
          p.z() - seconds * (v[2] + w[0] * p.y() - w[1] * p.x())};
}

/// Predicted minus measured pixel of a point in the picture, in standard deviations.
struct PixelResidual {
  Eigen::Vector2d pixel;
  double sigma;                                              ///< [px]
  double row_share = 0;                                      ///< of its row: -0.5 for the first, 0.5 for the last
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< of the picture's camera, in its frame

  template <class Scalar>
  bool operator()(const Scalar* picture_from_world, const Scalar* point, const Scalar* camera, const Scalar* timing,
                  Scalar* residual) const {
    const Eigen::Matrix<Scalar, 3, 1> in_world(point[0], point[1], point[2]);
    const auto p = later(moved(picture_from_world, in_world), velocity, Scalar(timing[0] * row_share));
    if (!(p.z() > 0.01)) return false;
    const auto place = project(camera, p);
    residual[0] = (place.x() - pixel.x()) / sigma;
    residual[1] = (place.y() - pixel.y()) / sigma;
    return true;
  }
};

/// Measured minus predicted inverse depth of a point, in standard deviations. The measured one is read from the plane
/// that the depth image shows there, as inverse depth is linear in the image of a plane. Through the slope of the plane
/// the residual also measures the depth camera's intrinsics.
struct DepthResidual {
  LocalPlane plane;
  double row_share = 0;                                      ///< of its row in the depth image
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< of the picture's camera, in its frame

  template <class Scalar>
  bool operator()(const Scalar* picture_from_world, const Scalar* point, const Scalar* depth_from_picture,
                  const Scalar* camera, const Scalar* scale, const Scalar* timing, Scalar* residual) const {
    const Eigen::Matrix<Scalar, 3, 1> in_world(point[0], point[1], point[2]);
    const Scalar seconds = timing[2] + timing[1] * row_share;
    const auto p = moved(depth_from_picture, later(moved(picture_from_world, in_world), velocity, seconds));
    if (!(p.z() > 0.01)) return false;
    const auto place = project(camera, p);
    const Scalar measured = plane.inverse_depth + plane.slope.x() * (place.x() - plane.pixel.x()) +
                            plane.slope.y() * (place.y() - plane.pixel.y());
    residual[0] = (measured - *scale / p.z()) / plane.sigma;
    return true;
  }
};

/// Distance between the bases of two views minus the distance that wheels or given poses measured, in standard
/// deviations.
struct DistanceResidual {
  Eigen::Vector3d base_in_first, base_in_second;  ///< [m] in the pictures' optical frames
  double distance, sigma;                         ///< [m]

  template <class Scalar>
  bool operator()(const Scalar* first_from_world, const Scalar* second_from_world, Scalar* residual) const {
    const Scalar none = Scalar(0.0);
    Scalar sum = none;
    Eigen::Matrix<Scalar, 3, 1> places[2];
    const Scalar* motions[2] = {first_from_world, second_from_world};
    const Eigen::Vector3d* bases[2] = {&base_in_first, &base_in_second};
    for (int i = 0; i < 2; ++i) {
      const Scalar back[3] = {-motions[i][0], -motions[i][1], -motions[i][2]};
      const Scalar moved_back[3] = {(*bases[i])[0] - motions[i][3], (*bases[i])[1] - motions[i][4],
                                    (*bases[i])[2] - motions[i][5]};
      ceres::AngleAxisRotatePoint(back, moved_back, places[i].data());
    }
    sum = (places[0] - places[1]).squaredNorm();
    residual[0] = (ceres::sqrt(sum + 1e-12) - distance) / sigma;
    return true;
  }
};

/// Weak prior of the numbers of a block, each with its standard deviation.
struct BlockPrior {
  MotionBlock value, sigmas;

  template <class Scalar>
  bool operator()(const Scalar* block, Scalar* residual) const {
    for (std::size_t i = 0; i < value.size(); ++i) residual[i] = (block[i] - value[i]) / sigmas[i];
    return true;
  }
};

/// Weak prior of a number at the log's value, in standard deviations.
struct NumberPrior {
  int index;
  double value, sigma;

  template <class Scalar>
  bool operator()(Scalar const* const* blocks, Scalar* residual) const {
    residual[0] = (blocks[0][index] - value) / sigma;
    return true;
  }
};

}  // namespace omnimapper::calibration
