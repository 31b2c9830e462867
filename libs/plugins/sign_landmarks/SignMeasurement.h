#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/obs/CObservationDoorSigns.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "SignBearingFactor.h"
#include "SignLandmarksOptions.h"
#include "SignPayload.h"
#include "SignText.h"

namespace omnimapper::plugins {

/// [m] Typical distance from which signs are read.
inline constexpr double kReadingDistance = 2.5;

/// The measurement of a sign in an image, from which its factors are made.
struct SignMeasurement {
  SignText text;
  MeasuredDirection seen;
  Eigen::Vector3d tilt_axis;      ///< level unit vector to the left of the camera, in the base
  double sigma_left, sigma_down;  ///< [rad] of the direction
  std::optional<double> range;    ///< [m] if it was measured
  double range_sigma;             ///< [m]
  double area_px;                 ///< [px^2] of its region in the image
  mrpt::img::CImage patch;        ///< image of the region; may be empty

  SignLook look(base::KeyFrameId frame) const;

  /// The factor of the direction. `offsets`: variable of the pan-tilt offsets, if they are estimated.
  graph::FactorRecord directionRecord(base::VariableId pose, base::VariableId point,
                                      std::optional<base::VariableId> offsets,
                                      const SignLandmarksOptions& options) const;
  /// The factor of the measured range; none if no range was measured.
  std::optional<graph::FactorRecord> rangeRecord(base::VariableId pose, base::VariableId point) const;
  /// A weak factor on the distance: a sign that was read is neither very close to the camera nor far away. It keeps the
  /// point from going to infinity if the directions determine its distance poorly.
  graph::FactorRecord legibilityRecord(base::VariableId pose, base::VariableId point) const;
};

/// The signs of an observation that have a text and are neither straight above nor straight below the camera.
std::vector<SignMeasurement> signMeasurements(const obs::CObservationDoorSigns& observation,
                                              const SignLandmarksOptions& options);

}  // namespace omnimapper::plugins
