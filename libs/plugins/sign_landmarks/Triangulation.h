#pragma once

#include <omnimapper/graph/Graph.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "SignMeasurement.h"

namespace omnimapper::plugins {

/// A sighting and where the base was then.
struct SignView {
  base::KeyFrameId frame;
  base::Stamp stamp;
  base::VariableId pose;
  std::string label;  ///< of the camera
  SignMeasurement sighting;
  double travelled = 0;  ///< [m] when it was seen
};

struct Triangulation {
  Eigen::Vector3d point;           ///< [m] in the map
  double sigma;                    ///< [m] along the axis that is known worst, the poses taken as exact
  std::vector<std::size_t> views;  ///< that pass within three standard deviations
};
/// What is known of the offsets of the pan-tilt unit that turned the camera.
struct KnownOffsets {
  Eigen::Vector2d pan_tilt = Eigen::Vector2d::Zero();  ///< [rad]
  double sigma = 0;                                    ///< [rad] of the angle that is known worse
};
/// Where the last view and most others meet, the poses as they are now; others may be of another sign. None if fewer
/// than `min_views` do, or the place is known worse than `max_sigma` [m].
std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         const KnownOffsets& offsets, double max_sigma, std::size_t min_views);

}  // namespace omnimapper::plugins
