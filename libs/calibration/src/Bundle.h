#pragma once

#include <omnimapper/calibration/DepthCamera.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "CalibrationView.h"
#include "Tracks.h"

namespace omnimapper::calibration {

/// Parameters of a camera that are either estimated together or held at the log's values.
enum class Group { focal, centre, lens, depth_focal, depth_centre, place, turn, scale, timing };

/// The unknowns of the bundle adjustment.
struct Estimate {
  DepthCamera camera;
  std::vector<geometry::Se3> picture_from_world;  ///< by view
  std::vector<Eigen::Vector3d> points;            ///< [m] by track, in the world
  /// [s] Readout of the picture from its first row to its last, the same of the depths, and delay of the depths' middle
  /// after the picture's.
  std::array<double, 3> timing{};
};

/// A corner in a view, with the surface that the depth image shows there, if it shows one.
struct Measurement {
  std::size_t track, view;
  Eigen::Vector2d pixel;
  double sigma;  ///< [px]
  std::optional<LocalPlane> plane;
  double row_share = 0;        ///< of its row, for its time: -0.5 for the first row of the picture, 0.5 for the last
  double depth_row_share = 0;  ///< the same in the depth image
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< of the view
};

/// Distance that the base moved between two views, measured in metres by another sensor than the camera.
struct MetricSpan {
  std::size_t first, second;  ///< views
  double distance, sigma;     ///< [m]
  double common_sigma;        ///< [-] relative error that all spans share: the scale of the sensor
};

struct BundleInput {
  const std::vector<CalibrationView>& views;
  std::vector<Measurement> measurements;
  std::vector<MetricSpan> spans;
  DepthCamera log;             ///< mean of the weak priors
  std::vector<bool> are_held;  ///< views whose pose is fixed: the first of each stretch
  std::function<bool()> stop;  ///< called between two iterations
};

/// A number of a camera that was estimated.
struct Parameter {
  Group group;
  int index;  ///< within the group: x before y
  double value, prior_sigma;
  double sigma = 0;  ///< standard deviation, larger if the residuals are larger than expected
};

struct Adjusted {
  Estimate estimate;
  std::vector<Parameter> parameters;
  Eigen::MatrixXd covariance;  ///< of the parameters
  double cost = 0;             ///< half of the sum of squares, with losses
  std::size_t residuals = 0;
};

/// Sets the surface of each measurement: the one at the pixel of the depth image where the estimate predicts its point.
void associateSurfaces(BundleInput& input, const Estimate& estimate);
/// Leaves out measurements that differ from the estimate by more than `pixels` times their standard deviation, surfaces
/// that differ by more than `sigmas` standard deviations, and then points that fewer than two views measure.
void leaveOutContradictions(BundleInput& input, const Estimate& estimate, double pixels, double sigmas);

/// Bundle adjustment of poses, points and the `free` parameters of the camera. Throws Error(interrupted) if it is
/// stopped.
Adjusted adjust(const BundleInput& input, const Estimate& start, const std::set<Group>& free);

/// The residuals of a held-back view, of which only the pose is fitted; its points are known.
struct ViewMisses {
  std::vector<Eigen::Vector2d> pixels;  ///< of each corner
  std::vector<Eigen::Vector2d> misses;  ///< [px] residual of each corner
  std::vector<double> depth_misses;     ///< [1/m] residual of each surface
  double cost = 0;                      ///< half of the sum of squares, with losses
};
ViewMisses fitView(const std::vector<Measurement>& of_view, const CalibrationView& view, const Estimate& estimate,
                   const geometry::Se3& picture_from_world);

}  // namespace omnimapper::calibration
