#pragma once

#include <omnimapper/graph/Graph.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "SignMeasurement.h"

namespace omnimapper::plugins {

/// A measurement of a sign, with the pose variable of the base at that time.
struct SignView {
  base::KeyFrameId frame;
  base::Stamp stamp;
  base::VariableId pose;
  std::string label;  ///< of the camera
  SignMeasurement measurement;
  double travelled = 0;  ///< [m] distance travelled when it was seen
};

struct Triangulation {
  Eigen::Vector3d point;           ///< [m] in the map
  double sigma;                    ///< [m] along the least certain axis, with the poses taken as exact
  std::vector<std::size_t> views;  ///< indices of the views that pass the point within three standard deviations
};
/// Estimate of the offsets of the pan-tilt unit that turned the camera.
struct KnownOffsets {
  Eigen::Vector2d pan_tilt = Eigen::Vector2d::Zero();  ///< [rad]
  double sigma = 0;                                    ///< [rad] of the less certain angle
};
/// The point at which the last view meets the largest number of other views, given the current poses; the remaining
/// views may be of another sign. None if fewer than `min_views` meet, or if the point's sigma is above `max_sigma` [m].
std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         const KnownOffsets& offsets, double max_sigma, std::size_t min_views);

}  // namespace omnimapper::plugins
