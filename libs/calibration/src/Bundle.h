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

/// What of a camera is estimated together, or held where the log has it.
enum class Group { focal, centre, lens, depth_focal, depth_centre, place, turn, scale, timing };

/// What bundle adjustment changes.
struct Estimate {
  DepthCamera camera;
  std::vector<geometry::Se3> picture_from_world;  ///< by view
  std::vector<Eigen::Vector3d> points;            ///< by track, in the world [m]
  std::array<double, 3>
      timing{};  ///< [s] picture's first row to its last, the depths', picture's middle to the depths'
};

/// A corner of a view, with the surface that the depth image has there, if it has one.
struct Measurement {
  std::size_t track, view;
  Eigen::Vector2d pixel;
  double sigma;  ///< [px]
  std::optional<LocalPlane> plane;
  double row_share = 0;        ///< when it was taken: -0.5 for the first row of the picture, 0.5 for the last
  double depth_row_share = 0;  ///< the same in the depth image
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< the view's
};

/// How far the base moved from one view to another, measured in metres by something else than the camera.
struct MetricSpan {
  std::size_t first, second;  ///< views
  double distance, sigma;     ///< [m]
  double common_sigma;        ///< [-] relative, of all alike: what measured them has a scale of its own
};

struct BundleInput {
  const std::vector<CalibrationView>& views;
  std::vector<Measurement> measurements;
  std::vector<MetricSpan> spans;
  DepthCamera log;             ///< about which the weak priors are
  std::vector<bool> are_held;  ///< views whose pose stays: the first of each stretch
  std::function<bool()> stop;  ///< asked between two iterations
};

/// One number of a camera that was estimated.
struct Parameter {
  Group group;
  int index;  ///< within the group: x before y
  double value, prior_sigma;
  double sigma = 0;  ///< standard deviation, of residuals as large as they are
};

struct Adjusted {
  Estimate estimate;
  std::vector<Parameter> parameters;
  Eigen::MatrixXd covariance;  ///< of these
  double cost = 0;             ///< half of the sum of squares, with losses
  std::size_t residuals = 0;
};

/// The surfaces that the measurements see as the estimate has them.
void associateSurfaces(BundleInput& input, const Estimate& estimate);
/// Leaves out measurements that the estimate contradicts by more than so many pixels times their scale, and the depths
/// that it contradicts by more than so many standard deviations.
void leaveOutContradictions(BundleInput& input, const Estimate& estimate, double pixels, double sigmas);

/// Bundle adjustment of poses, points and what of the camera is `free`. Throws Error(interrupted) if it is stopped.
Adjusted adjust(const BundleInput& input, const Estimate& start, const std::set<Group>& free);

/// What a view whose points are known says of an estimate: its pose alone is fitted.
struct ViewMisses {
  std::vector<Eigen::Vector2d> pixels;  ///< where
  std::vector<Eigen::Vector2d> misses;  ///< [px] by how much, of each corner
  std::vector<double> depth_misses;     ///< [1/m]
  double cost = 0;                      ///< with losses
};
ViewMisses fitView(const std::vector<Measurement>& of_view, const CalibrationView& view, const Estimate& estimate,
                   const geometry::Se3& picture_from_world);

}  // namespace omnimapper::calibration
