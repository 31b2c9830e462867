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
struct SignMeasurement {
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
std::vector<SignMeasurement> signMeasurements(const obs::CObservationDoorSigns& observation,
                                              const SignLandmarksOptions& options);

}  // namespace omnimapper::plugins
