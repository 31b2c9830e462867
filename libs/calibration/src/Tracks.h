#pragma once

#include <omnimapper/calibration/DepthCamera.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "CalibrationView.h"

namespace omnimapper::calibration {

/// The position of a point in a view.
struct CornerMeasurement {
  std::size_t view;
  Eigen::Vector2d pixel;  ///< in the picture, with lens distortion
  double sigma;           ///< [px]
};

/// A point of the scene, with its positions in the views that show it.
struct Track {
  Eigen::Vector3d point;  ///< [m] in the world; initial value
  std::vector<CornerMeasurement> measurements;
};

/// Links ORB corners that look alike, in views whose poses are close enough to show the same, to tracks of at least
/// `fewest` views. Returns at most `most` tracks, those of most views first. The same input gives the same tracks.
std::vector<Track> findTracks(const std::vector<CalibrationView>& views, const DepthCamera& camera, std::size_t fewest,
                              std::size_t most);

/// The pixel of the depth image that shows the same point as this pixel of the picture; none if it has no depth.
std::optional<Eigen::Vector2d> depthPixelOf(const CalibrationView& view, const DepthCamera& camera,
                                            const Eigen::Vector2d& pixel);
/// The point that a pixel of the picture shows, in the picture's optical frame; none if it has no depth.
std::optional<Eigen::Vector3d> pointAt(const CalibrationView& view, const DepthCamera& camera,
                                       const Eigen::Vector2d& pixel);

}  // namespace omnimapper::calibration
