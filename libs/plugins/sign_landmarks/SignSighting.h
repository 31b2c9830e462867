#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/obs/CObservationDoorSigns.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "SignBearingFactor.h"
#include "SignLandmarksPlugin.h"
#include "SignPayload.h"
#include "SignText.h"

namespace omnimapper::plugins {

/// [m] Signs are read from about so far.
inline constexpr double kReadingDistance = 2.5;

/// A sign in an image, as it binds a sign of the map.
struct SignSighting {
  SignText text;
  SeenDirection seen;
  Eigen::Vector3d tilt_axis;      ///< unit, level, to the left of the camera, in the base
  double sigma_left, sigma_down;  ///< [rad] of the direction
  std::optional<double> range;    ///< [m] where something measured it
  double range_sigma;             ///< [m]
  double area_px;                 ///< [px^2] of its region in the image
  mrpt::img::CImage patch;        ///< what the region shows; may be empty

  SignLook look(base::KeyFrameId frame) const;

  /// What binds the direction; `offsets`: the pan-tilt unit's, if they are estimated.
  graph::FactorRecord directionRecord(base::VariableId pose, base::VariableId point,
                                      std::optional<base::VariableId> offsets,
                                      const SignLandmarksOptions& options) const;
  /// What binds the measured range, or none.
  std::optional<graph::FactorRecord> rangeRecord(base::VariableId pose, base::VariableId point) const;
  /// What everybody knows: a sign that was read is neither next to the camera nor far away. It keeps a sign of which
  /// the directions tell little from going to infinity.
  graph::FactorRecord legibilityRecord(base::VariableId pose, base::VariableId point) const;
};

/// Those of an observation that have a text, and are neither straight above nor below the camera.
std::vector<SignSighting> signSightings(const obs::CObservationDoorSigns& observation,
                                        const SignLandmarksOptions& options);

/// A sighting and where the base was then.
struct SignView {
  base::KeyFrameId frame;
  base::VariableId pose;
  std::string label;  ///< of the camera
  SignSighting sighting;
  double travelled = 0;  ///< [m] when it was seen
};

struct Triangulation {
  Eigen::Vector3d point;           ///< [m] in the map
  double sigma;                    ///< [m] along the direction that is known worst, the poses taken as exact
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
