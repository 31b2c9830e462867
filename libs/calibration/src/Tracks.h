#pragma once

#include <omnimapper/calibration/DepthCamera.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "CalibrationView.h"

namespace omnimapper::calibration {

/// Where a view shows a point.
struct CornerMeasurement {
  std::size_t view;
  Eigen::Vector2d pixel;  ///< of the picture, as the lens shows it
  double sigma;           ///< [px]
};

/// One point of the place, in the views that show it.
struct Track {
  Eigen::Vector3d point;  ///< in the world [m]; the start
  std::vector<CornerMeasurement> measurements;
};

/// Corners (ORB) that look alike in views which by their poses see the same, linked to tracks of at least `fewest`
/// views. The same input gives the same tracks.
std::vector<Track> findTracks(const std::vector<CalibrationView>& views, const DepthCamera& camera, std::size_t fewest,
                              std::size_t most);

/// Where the depth image shows what is in that pixel of the picture; none where there is no depth.
std::optional<Eigen::Vector2d> depthPixelOf(const CalibrationView& view, const DepthCamera& camera,
                                            const Eigen::Vector2d& pixel);
/// The point that a pixel of the picture shows, in the picture's optical frame; none where there is no depth.
std::optional<Eigen::Vector3d> pointAt(const CalibrationView& view, const DepthCamera& camera,
                                       const Eigen::Vector2d& pixel);

}  // namespace omnimapper::calibration
