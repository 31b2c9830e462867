#pragma once

#include <omnimapper/interaction/PointingError.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::interaction {

/// Direction of a target from the pointing hand, as the person and the sensor stand: what the errors of pointing depend
/// on (thesis, Tables 12 and 13).
struct TargetDirection {
  /// [rad] from the level direction hand to sensor, positive to the side of the pointing arm: to the right of the
  /// person for a right arm if it faces the sensor, to the left for a left arm.
  double azimuth = 0;
  double altitude = 0;  ///< [rad] above the level
};

/// The angle [rad] between two such directions.
double angleBetween(const TargetDirection& a, const TargetDirection& b);

/// Mean and standard deviation of one angle of PointingError [rad].
struct AngleError {
  double mean = 0, sigma = 0;
};

/// The errors of one kind of rays. Theta is that of a right arm; for a left arm it has the other sign.
struct RayErrors {
  AngleError theta, psi;
};

/// What was measured with one target: the rays elbow to hand and head to hand.
struct PointingRow {
  std::string target;                        ///< its name
  std::optional<TargetDirection> direction;  ///< if it is known
  RayErrors elbow_hand, head_hand;
};

/// How people miss what they point at, as one tracker sees them. At least one row.
struct PointingModel {
  std::vector<PointingRow> rows;
  /// Correlation of the errors of both rays, of theta and of psi: -1 to 1. The thesis does not state any.
  double theta_correlation = 0, psi_correlation = 0;
  /// [rad] by how much a target's direction may differ from that of a row until the row counts little.
  double direction_sigma = 0.35;
};

/// The errors for a target in this direction: mean and variance of the mixture of all rows, each with the weight
/// exp(-(a / direction_sigma)^2 / 2), where a is the angle between its direction and the target's. If no row has a
/// direction, or that of the target is not known, or is more than four direction_sigma from all rows, all have the same
/// weight.
PointingRow errorsTowards(const PointingModel& model, const std::optional<TargetDirection>& direction);

/// The model as a table of comma-separated fields, with angles in degrees and 4 decimals: target, azimuth_deg,
/// altitude_deg (both empty if they are not known), then mean and sigma of theta and of psi for elbow-hand and for
/// head-hand, and both correlations, which are the same in each row.
std::string tableOf(const PointingModel& model);

/// Reads such a table. Throws Error(unreadable_input) with line and reason if it has no row, a number is not finite, a
/// standard deviation is not positive, or a correlation is not within -1 and 1.
PointingModel readPointingModel(const std::string& path);

}  // namespace omnimapper::interaction
