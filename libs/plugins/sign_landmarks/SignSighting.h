#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/obs/CObservationDoorSigns.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "SignLandmarksPlugin.h"
#include "SignText.h"

namespace omnimapper::plugins {

/// A sign in an image, as it binds a sign of the map.
struct SignSighting {
  SignText text;
  Eigen::Vector3d camera;         ///< in the base [m]
  Eigen::Vector3d direction;      ///< unit, in the base
  double sigma_left, sigma_down;  ///< [rad] of the direction

  graph::FactorRecord record(base::VariableId pose, base::VariableId point, const SignLandmarksOptions& options) const;
};

/// Those of an observation that have a text, and are neither straight above nor below the camera.
std::vector<SignSighting> signSightings(const obs::CObservationDoorSigns& observation,
                                        const SignLandmarksOptions& options);

/// A sighting and where the base was then.
struct SignView {
  base::VariableId pose;
  SignSighting sighting;
  double travelled = 0;  ///< [m] when it was seen
};

struct Triangulation {
  Eigen::Vector3d point;           ///< [m] in the map
  double sigma;                    ///< [m] along the direction that is known worst, the poses taken as exact
  std::vector<std::size_t> views;  ///< that pass within three standard deviations
};
/// Where the last view and most others meet, the poses as they are now; others may be of another sign. None if fewer
/// than `min_views` do, or the place is known worse than `max_sigma` [m].
std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         double max_sigma, std::size_t min_views);

}  // namespace omnimapper::plugins
